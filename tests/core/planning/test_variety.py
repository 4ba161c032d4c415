import numpy as np

from service.core.planning.pose_space import PoseSpace, sample_poses
from service.core.planning.variety import Requirement, next_place, requirements
from service.core.vision.camera import project
from tests.core.planning.cameras import BOARD, LENS1

POSES = sample_poses(PoseSpace(), LENS1, BOARD, 500, seed=2)
PIXELS = project(LENS1, POSES.rotations, POSES.translations, BOARD.object_points)
NEEDED = requirements(POSES, PIXELS, LENS1.image_size, 12)


def test_a_set_must_visit_every_image_corner_and_tilt_every_way() -> None:
    assert len(NEEDED) == 8
    flattest = np.argsort(np.linalg.norm(POSES.rotations[:, :2, 2], axis=1))[:12]
    assert all(one.missing([int(i) for i in flattest]) > 0 for one in NEEDED[4:])


def test_few_poses_cannot_be_asked_for_everything() -> None:
    assert requirements(POSES, PIXELS, LENS1.image_size, 3) == []


def test_the_next_place_is_for_what_is_missing() -> None:
    first, second = np.arange(10) < 3, np.arange(10) > 7
    needed = [Requirement(first), Requirement(second)]
    np.testing.assert_array_equal(next_place(needed, [0, 4]), second)
    assert next_place(needed, [0, 9]) is None
