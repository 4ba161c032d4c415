import numpy as np
import pytest

from bench.freehand_run import take_freehand
from bench.guided_run import make_vehicle
from bench.opencv_flow import calibrate_with_opencv, find_with_opencv
from bench.paper.lenses import paper_lens
from service.core.planning.pose_space import sample_poses
from service.core.vision.camera import project
from service.simulator.novice import draw_novice
from service.simulator.scene import production_scene

LENS = paper_lens("lens1")


def test_opencvs_flow_finds_the_camera_of_exact_corners() -> None:
    poses = sample_poses(LENS.pose_space, LENS.intrinsics, LENS.target, 12, 1)
    corners = project(LENS.intrinsics, poses.rotations, poses.translations, LENS.target.object_points)
    solved = calibrate_with_opencv(list(corners), LENS.target, LENS.intrinsics.image_size)
    assert solved is not None
    assert solved.intrinsics.parameters["fx"] == pytest.approx(LENS.intrinsics.parameters["fx"], abs=0.05)
    assert max(np.abs(view).max() for view in solved.residuals) < 1e-2


def test_opencv_gives_up_without_a_view() -> None:
    assert calibrate_with_opencv([], LENS.target, LENS.intrinsics.image_size) is None


def test_no_board_is_found_where_there_is_none() -> None:
    assert find_with_opencv(np.full((200, 320), 90, np.uint8), LENS.target) is None


def test_a_novice_takes_as_many_pictures_as_wanted_and_the_same_again_with_the_same_seed() -> None:
    vehicle = make_vehicle(production_scene(LENS.intrinsics, LENS.target), exposure_s=0.01)
    novice = draw_novice(np.random.default_rng(3))
    runs = [take_freehand(vehicle, LENS.target, novice, 3, rng=np.random.default_rng(4)) for _ in range(2)]
    assert len(runs[0].images) == len(runs[0].corners) == 3
    assert runs[0].elapsed_s > 0
    np.testing.assert_array_equal(runs[0].images[2], runs[1].images[2])
