import numpy as np

from service.core.vision.detection import detect_target
from service.core.vision.transforms import Pose
from service.simulator.renderer import prepare
from service.simulator.scene import clean_scene, production_scene, true_corners
from service.simulator.shutter import between, take_picture
from tests.simulator.cameras import BOARD, LENS_1, centred_pose

START = centred_pose(BOARD, (10.0, -20.0, 5.0), (0.02, -0.01, 0.5))
END = centred_pose(BOARD, (12.0, -18.0, 8.0), (0.022, -0.01, 0.5))


def test_the_way_begins_ends_and_is_halved_where_it_should() -> None:
    for share, wanted in ((0.0, START), (1.0, END)):
        pose = between(START, END, share, BOARD)
        np.testing.assert_allclose(pose.rotation, wanted.rotation, atol=1e-12)
        np.testing.assert_allclose(pose.tvec, wanted.tvec, atol=1e-12)
    half = between(START, END, 0.5, BOARD)
    np.testing.assert_allclose(half.rotation @ BOARD.centre + half.tvec, (0.021, -0.01, 0.5), atol=1e-12)


def test_a_board_at_rest_looks_as_at_one_moment() -> None:
    prepared = prepare(production_scene(LENS_1, BOARD))
    rested = take_picture(prepared, START, START, np.random.default_rng(3))
    np.testing.assert_array_equal(rested, prepared.render(START, np.random.default_rng(3)))


def test_motion_smears_edges_and_leaves_corners_at_the_middle_of_the_way() -> None:
    prepared = prepare(clean_scene(LENS_1, BOARD))
    closed = Pose(START.rvec, START.tvec + np.array([0.002, 0.0, 0.0]))
    sharp = detect_target(prepared.render(START, np.random.default_rng(0)), BOARD)
    smeared = detect_target(take_picture(prepared, START, closed, np.random.default_rng(0)), BOARD)
    assert smeared.sharpness.edge_width_px > 1.5 * sharp.sharpness.edge_width_px
    middle = 0.5 * (true_corners(prepared.scene, START) + true_corners(prepared.scene, closed))
    assert np.abs(smeared.image_points - middle).max() < 0.1
