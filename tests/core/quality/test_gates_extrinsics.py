"""The extrinsics gate: a camera in its place passes, and each fault fails for its own reason."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from service.core.quality.evidence import Expectation, FixedTargetViews, NamedDetection
from service.core.quality.gates import Verdict
from service.core.quality.gates_extrinsics import GATE
from service.core.quality.verdict import Judged, calibrate_and_judge
from service.core.vision.camera import project
from service.core.vision.extrinsics import FixedTarget
from service.core.vision.transforms import Pose, compose, invert, rotation_matrix, rotation_vector
from tests.core.quality.seen_views import BOARD, CAMERA, NOMINAL, see, see_poses

TILT = rotation_matrix(np.array([0.3, -0.3, 0.05]))
T_CAM_BOARD = Pose(rotation_vector(TILT), np.array([0.02, 0.0, 0.45]) - TILT @ BOARD.centre)
PLACE = FixedTarget(Pose(np.array([0.1, 1.5, 0.3]), np.array([1.5, 0.2, 1.0])), 2e-4, np.radians(0.02))
MOUNTING = compose(PLACE.T_vehicle_board, invert(T_CAM_BOARD))


def pictures(count: int = 2, pose: Pose = T_CAM_BOARD, noise_px: float = 0.05) -> list[NamedDetection]:
    rng = np.random.default_rng(3)
    pixels = project(CAMERA, pose.rotation, pose.tvec, BOARD.object_points)
    return [see(pixels + rng.normal(0, noise_px, pixels.shape), f"fixed{i}") for i in range(count)]


def judged(
    views: Sequence[NamedDetection], mounting: Pose | None = MOUNTING, place: FixedTarget = PLACE
) -> Judged:
    fixed = FixedTargetViews(BOARD, place, tuple(views))
    expectation = Expectation(NOMINAL, mounting=mounting)
    return calibrate_and_judge(see_poses(), BOARD, expectation=expectation, fixed_target=fixed)


def failed(found: Judged) -> set[str]:
    return {m.name for m in found.measurements if m.gate == GATE and m.verdict is Verdict.FAIL}


def moved(pose: Pose, **by: tuple[float, float, float]) -> Pose:
    turn = rotation_matrix(np.array(by.get("rad", (0.0, 0.0, 0.0))))
    return Pose(rotation_vector(turn @ pose.rotation), pose.tvec + np.array(by.get("m", (0.0, 0.0, 0.0))))


def test_a_camera_in_its_place_passes() -> None:
    found = judged(pictures())
    measured = [m for m in found.measurements if m.gate == GATE]
    assert {m.verdict for m in measured} == {Verdict.PASS}
    assert {m.unit for m in measured} == {"mm", "mdeg", "px", ""}
    assert found.extrinsics is not None
    assert found.extrinsics.T_vehicle_cam.tvec == pytest.approx(MOUNTING.tvec, abs=2e-3)
    assert found.fixed_views == ("fixed0", "fixed1")


def test_without_pictures_of_the_fixed_target_nothing_is_said() -> None:
    found = calibrate_and_judge(see_poses(), BOARD, expectation=Expectation(NOMINAL))
    assert found.extrinsics is None
    assert GATE not in {m.gate for m in found.measurements}


def test_one_picture_and_no_nominal_mounting_leave_out_what_they_cannot_say() -> None:
    names = {m.name for m in judged(pictures(1), mounting=None).measurements if m.gate == GATE}
    assert names == {"translation_sd_mm", "rotation_sd_mdeg", "extrinsics_rms_px", "tilt_ambiguity"}


def test_each_fault_fails_for_its_own_reason() -> None:
    loose = replace(PLACE, translation_sd_m=0.005, rotation_sd_rad=np.radians(0.5))
    shaken = [*pictures(1), *pictures(1, moved(T_CAM_BOARD, m=(0.0005, 0.0, 0.0)))]
    assert failed(judged(pictures(), place=loose)) == {"translation_sd_mm", "rotation_sd_mdeg"}
    assert failed(judged(pictures(), moved(MOUNTING, m=(0.02, 0.0, 0.0)))) == {"mounting_off_mm"}
    assert failed(judged(pictures(), moved(MOUNTING, rad=(0.0, 0.06, 0.0)))) == {"mounting_off_mdeg"}
    assert "extrinsics_rms_px" in failed(judged(pictures(noise_px=0.5)))
    assert failed(judged(shaken)) >= {"image_agreement_px"}
