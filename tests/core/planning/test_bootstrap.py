from collections.abc import Sequence

import numpy as np
import pytest

from service.core.errors import IntrinsicsInvalid
from service.core.planning.bootstrap import bootstrap, compare_plans, nominal_of_data_sheet
from service.core.planning.plan import PoseSet, plan_pose_set
from service.core.planning.pose_space import PoseSpace
from service.core.vision.calibration import View
from service.core.vision.camera import Intrinsics, project
from tests.core.planning.cameras import BOARD, LENS1

SPACE = PoseSpace()


def plan(camera: Intrinsics) -> PoseSet:
    return plan_pose_set(camera, BOARD, SPACE, 8, seed=1, candidates=500)


def photograph(pose_set: PoseSet) -> list[View]:
    """What a virtual camera sees where the planned poses are held; boards that leave the picture are lost."""
    rng = np.random.default_rng(5)
    views = []
    for pose in pose_set.poses:
        pixels = project(LENS1, pose.rotation, pose.tvec, BOARD.object_points)
        if np.all((pixels > 0) & (pixels < np.array(LENS1.image_size) - 1)):
            views.append(View(BOARD.object_points, pixels + rng.normal(0.0, 0.1, pixels.shape)))
    return views


def rough(share: float) -> Intrinsics:
    fx, fy = LENS1.camera_matrix[0, 0], LENS1.camera_matrix[1, 1]
    nominal = {"fx": share * fx, "fy": share * fy, "cx": 639.5, "cy": 399.5}
    return Intrinsics.from_parameters("pinhole5", nominal, LENS1.image_size)


@pytest.mark.parametrize("share", [0.9, 1.1])
def test_from_ten_percent_off_the_plan_settles_at_the_true_camera(share: float) -> None:
    rounds = bootstrap(rough(share), plan, photograph, BOARD, SPACE)
    assert 1 < len(rounds) <= 3
    assert rounds[-1].shift.is_settled
    assert abs(rounds[-1].estimate.camera_matrix[0, 0] - LENS1.camera_matrix[0, 0]) < 1.5
    # The last plan is as good for the true camera as one that was made for it.
    shift = compare_plans(LENS1, BOARD, SPACE, old=rounds[-1].pose_set.poses, new=plan(LENS1).poses)
    assert shift.is_settled


def test_a_plan_whose_boards_leave_the_true_picture_is_not_settled() -> None:
    wide = plan(rough(0.8))
    shift = compare_plans(LENS1, BOARD, SPACE, old=wide.poses, new=plan(LENS1).poses)
    assert shift.hidden
    assert not shift.is_settled


def test_a_plan_that_holds_is_left_alone() -> None:
    taken: list[int] = []

    def take(pose_set: PoseSet) -> Sequence[View]:
        taken.append(len(pose_set.poses))
        return photograph(pose_set)

    assert len(bootstrap(LENS1, plan, take, BOARD, SPACE)) == 1
    assert taken == [8]


def test_a_data_sheet_gives_square_pixels_unless_it_says_otherwise() -> None:
    camera = nominal_of_data_sheet("pinhole5", (1280, 800), 90.0)
    assert camera.parameters["fx"] == pytest.approx(640.0)
    assert camera.parameters["fy"] == pytest.approx(640.0)
    assert camera.parameters["cx"] == pytest.approx(639.5)
    assert nominal_of_data_sheet("pinhole5", (1280, 800), 90.0, 60.0).parameters["fy"] == pytest.approx(
        692.8, abs=0.1
    )


def test_a_view_that_no_pinhole_has_is_refused() -> None:
    with pytest.raises(IntrinsicsInvalid, match="190 degrees"):
        nominal_of_data_sheet("pinhole5", (1280, 800), 190.0)
