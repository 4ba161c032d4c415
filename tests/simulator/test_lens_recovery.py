"""Rendered pictures of wide cameras, through the real detector and the solver, give the true camera."""

import numpy as np
import pytest

from service.core.planning.plan import plan_pose_set
from service.core.planning.pose_space import PoseSpace
from service.core.quality.evidence import NamedDetection
from service.core.quality.gates import Verdict
from service.core.quality.verdict import Expectation, calibrate_and_judge
from service.core.vision.camera import Intrinsics
from service.core.vision.detection import detect_target
from service.core.vision.tolerance import Tolerance, draw_camera
from service.core.vision.uncertainty import mapping_difference
from service.simulator.renderer import prepare
from service.simulator.scene import production_scene
from service.simulator.vehicle import Mismatch, take_captures
from tests.simulator.cameras import BOARD, FISHEYE

RATIONAL = Intrinsics.from_vector(
    "rational8",
    np.array([917.3, 916.4, 955.0, 610.0, 0.74, 0.093, 0.0, 0.0, 0.001, 1.067, 0.25, 0.0098]),
    (1920, 1208),
)
SPACE = PoseSpace(distance_m=(0.15, 0.45), largest_incidence_deg=55.0)


@pytest.mark.parametrize(
    ("nominal", "fixed"), [(FISHEYE, ()), (RATIONAL, ("k6",))], ids=["fisheye", "rational"]
)
def test_a_wide_camera_is_recovered_from_its_pictures(nominal: Intrinsics, fixed: tuple[str, ...]) -> None:
    rng = np.random.default_rng(3)
    true = draw_camera(nominal, Tolerance(coefficients={"k1": 0.005, "k2": 0.002}), rng)
    poses = plan_pose_set(nominal, BOARD, SPACE, 10, seed=4, candidates=400, fixed=fixed).poses
    captures = take_captures(prepare(production_scene(true, BOARD, seed=2)), poses, Mismatch(), rng)
    views = [
        NamedDetection(f"{i}.png", detect_target(capture.image, BOARD), sha256=str(i))
        for i, capture in enumerate(captures)
    ]
    judged = calibrate_and_judge(views, BOARD, nominal.lens, Expectation(nominal), fixed=fixed)
    result = judged.result
    assert judged.verdict is not Verdict.FAIL, [m for m in judged.measurements if m.verdict is Verdict.FAIL]
    for name in ("fx", "fy", "cx", "cy"):
        assert abs(result.intrinsics.parameters[name] - true.parameters[name]) < 3.5 * result.sd[name], name
    corners = np.concatenate([view.detection.image_points for view in views])
    assert mapping_difference(true, result.intrinsics, corners).max() < 0.3
