from dataclasses import replace

import numpy as np
import pytest

from service.core.errors import PoseSpaceEmpty
from service.core.planning.pose_space import Poses, PoseSpace, infeasibilities, sample_poses
from service.core.vision.camera import Intrinsics, project
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Array
from tests.core.planning.cameras import BOARD, LENS1, LENS2

SPACE = PoseSpace()
FOLDING = Intrinsics.from_parameters(
    "pinhole5", {"fx": 600.0, "fy": 600.0, "cx": 639.5, "cy": 399.5, "k1": -0.4}, (1280, 800)
)


def corners_of(intrinsics: Intrinsics, poses: Poses, board: Chessboard = BOARD) -> Array:
    return project(intrinsics, poses.rotations, poses.translations, board.object_points)


@pytest.mark.parametrize("intrinsics", [LENS1, LENS2], ids=["lens1", "lens2"])
def test_every_sampled_pose_keeps_every_bound(intrinsics: Intrinsics) -> None:
    poses = sample_poses(SPACE, intrinsics, BOARD, 400, seed=1)
    pixels = corners_of(intrinsics, poses)
    assert len(poses) == 400
    assert pixels.min() >= SPACE.image_margin_px
    assert np.all(pixels <= np.array(intrinsics.image_size) - 1 - SPACE.image_margin_px)
    distances = np.linalg.norm(poses.centres(BOARD), axis=1)
    assert distances.min() >= SPACE.distance_m[0] - 1e-12
    assert distances.max() <= SPACE.distance_m[1] + 1e-12
    # A board that faces the camera shows its back as +z, away from the camera.
    assert np.all(poses.rotations[:, 2, 2] > 0.49)
    sides = np.linalg.norm(np.diff(pixels.reshape(-1, 6, 9, 2), axis=2), axis=-1)
    assert sides.min() >= SPACE.smallest_square_px


def test_the_same_seed_gives_the_same_poses_and_another_seed_others() -> None:
    first, again, other = (sample_poses(SPACE, LENS1, BOARD, 50, seed) for seed in (7, 7, 8))
    np.testing.assert_array_equal(first.translations, again.translations)
    np.testing.assert_array_equal(first.rotations, again.rotations)
    assert np.abs(first.translations - other.translations).max() > 0.01


def test_image_corners_are_not_starved() -> None:
    pixels = corners_of(LENS1, sample_poses(SPACE, LENS1, BOARD, 1500, seed=3))
    for corner in [(0, 0), (1279, 0), (0, 799), (1279, 799)]:
        # A square of 160 px is 2.5 % of the image; random boards have a corner in it less often than twice
        # that.
        reached = np.abs(pixels - np.array(corner)).max(axis=-1).min(axis=1) < 160.0
        assert reached.mean() > 0.05, corner


def test_many_boards_touch_the_margin_and_many_do_not() -> None:
    pixels = corners_of(LENS1, sample_poses(SPACE, LENS1, BOARD, 1000, seed=3))
    clearance = np.minimum(pixels, np.array(LENS1.image_size) - 1 - pixels).min(axis=(1, 2))
    touching = np.mean(clearance < SPACE.image_margin_px + 3.0)
    assert 0.25 < touching < 0.75


def test_distances_and_angles_spread_over_their_bounds() -> None:
    poses = sample_poses(SPACE, LENS2, BOARD, 1000, seed=3)
    counts, _ = np.histogram(np.linalg.norm(poses.centres(BOARD), axis=1), 5, SPACE.distance_m)
    assert counts.min() > 100
    tilts = np.rad2deg(np.arcsin(poses.rotations[:, :2, 2]))
    assert np.all(tilts.min(axis=0) < -35.0)
    assert np.all(tilts.max(axis=0) > 35.0)


@pytest.mark.parametrize(
    ("change", "bound"),
    [
        ({"distance_m": (0.05, 0.1)}, "image_margin_px"),
        ({"image_margin_px": 380.0}, "image_margin_px"),
        ({"distance_m": (5.0, 6.0)}, "smallest_square_px"),
        (
            {"yaw_deg": (70.0, 80.0), "smallest_square_px": 1.0, "largest_incidence_deg": 30.0},
            "largest_incidence_deg",
        ),
    ],
)
def test_an_empty_space_names_the_bound_that_empties_it(change: dict[str, object], bound: str) -> None:
    with pytest.raises(PoseSpaceEmpty) as caught:
        sample_poses(replace(SPACE, **change), LENS1, BOARD, 100, seed=1)  # type: ignore[arg-type]
    assert caught.value.facts["bound"] == bound
    assert bound in caught.value.detail


@pytest.mark.parametrize(
    ("change", "bound"),
    [
        ({"distance_m": (1.0, 0.25)}, "distance_m"),
        ({"roll_deg": (10.0, -10.0)}, "roll_deg"),
        ({"distance_m": (0.0, 1.0)}, "distance_m"),
        ({"largest_incidence_deg": 120.0}, "largest_incidence_deg"),
    ],
)
def test_impossible_bounds_are_refused_by_name(change: dict[str, object], bound: str) -> None:
    with pytest.raises(PoseSpaceEmpty, match=bound):
        sample_poses(replace(SPACE, **change), LENS1, BOARD, 10, seed=1)  # type: ignore[arg-type]


def test_no_board_reaches_beyond_where_the_lens_folds() -> None:
    poses = sample_poses(SPACE, FOLDING, BOARD, 300, seed=1)
    points = BOARD.object_points @ np.swapaxes(poses.rotations, 1, 2) + poses.translations[:, None]
    radius = np.linalg.norm(points[..., :2] / points[..., 2:], axis=-1)
    assert radius.max() < np.sqrt(1.0 / (3.0 * 0.4))


def test_of_an_all_round_fisheye_boards_stay_where_a_hand_can_be_led() -> None:
    fisheye = Intrinsics.from_parameters(
        "kannala_brandt4", {"fx": 431.0, "fy": 431.0, "cx": 639.5, "cy": 399.5, "k1": 0.01}, (1280, 800)
    )
    poses = sample_poses(replace(SPACE, distance_m=(0.15, 0.6)), fisheye, BOARD, 200, seed=3)
    centres = poses.centres(BOARD)
    aside = np.degrees(np.arctan2(np.linalg.norm(centres[:, :2], axis=1), centres[:, 2]))
    assert 55.0 < aside.max() <= 62.0
    corners = BOARD.object_points @ np.swapaxes(poses.rotations, 1, 2) + poses.translations[:, None]
    farthest = np.arctan2(np.linalg.norm(corners[..., :2], axis=-1), corners[..., 2]).max()
    assert np.degrees(farthest) > 75.0


def test_a_board_behind_the_camera_breaks_the_margin() -> None:
    behind = Poses(np.eye(3)[None], np.array([[0.0, 0.0, -0.5]]))
    assert infeasibilities(SPACE, LENS1, BOARD, behind)["image_margin_px"].all()
