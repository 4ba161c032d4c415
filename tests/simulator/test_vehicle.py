import numpy as np
import pytest

from service.core.vision.camera import Intrinsics
from service.core.vision.transforms import angle_between
from service.simulator.renderer import prepare
from service.simulator.scene import clean_scene, true_corners
from service.simulator.vehicle import Mismatch, hold_board, take_captures
from tests.simulator.cameras import BOARD, LENS_1, LENS_2, centred_pose, varied_poses


def test_a_hand_is_off_by_no_more_than_its_mismatch_about_the_targets_centre() -> None:
    scene, mismatch = clean_scene(LENS_1, BOARD), Mismatch()
    rng = np.random.default_rng(2)
    for pose in varied_poses(LENS_1):
        held = hold_board(scene, pose, mismatch, rng)
        centre = pose.rotation @ BOARD.centre + pose.tvec
        shift = held.rotation @ BOARD.centre + held.tvec - centre
        assert 0.0 < np.abs(shift).max() <= mismatch.position_m
        assert 0.0 < angle_between(pose.rotation, held.rotation) <= np.sqrt(3.0) * mismatch.angle_rad + 1e-12


def test_a_hand_keeps_every_corner_in_the_picture() -> None:
    scene, rng = clean_scene(LENS_1, BOARD), np.random.default_rng(3)
    clumsy = Mismatch(position_m=0.08, angle_rad=0.2, margin_px=6.0)
    for pose in varied_poses(LENS_1) * 5:
        corners = true_corners(scene, hold_board(scene, pose, clumsy, rng))
        assert np.all((corners >= 6.0) & (corners <= np.array([1273.0, 793.0])))


@pytest.mark.parametrize(
    ("lens", "centre"),
    [(LENS_1, (0.0, 0.0, 0.212)), (LENS_2, (-0.97, -0.64, 0.9))],
    ids=["close", "in the corner"],
)
def test_a_hand_moves_the_board_in_where_this_camera_does_not_show_the_prescribed_pose_whole(
    lens: Intrinsics, centre: tuple[float, ...]
) -> None:
    scene, wanted = clean_scene(lens, BOARD), centred_pose(BOARD, (0, 0, 0), centre)
    assert true_corners(scene, wanted).min() < 8.0
    held = hold_board(scene, wanted, Mismatch(), np.random.default_rng(5))
    assert true_corners(scene, held).min() >= 10.0
    assert held.tvec[2] < 1.13 * wanted.tvec[2]


def test_captures_come_one_per_pose_and_the_same_for_the_same_seed() -> None:
    small = Intrinsics.from_parameters(
        "pinhole5",
        {name: value / 5 for name, value in zip(("fx", "fy", "cx", "cy"), LENS_2.vector[:4], strict=True)},
        (384, 242),
    )
    prepared, poses = prepare(clean_scene(small, BOARD)), varied_poses(small)[:3]
    first, again = (take_captures(prepared, poses, Mismatch(), np.random.default_rng(4)) for _ in range(2))
    assert len(first) == 3
    for a, b in zip(first, again, strict=True):
        assert a.image.shape == (242, 384)
        np.testing.assert_array_equal(a.image, b.image)
        np.testing.assert_array_equal(a.pose.tvec, b.pose.tvec)
