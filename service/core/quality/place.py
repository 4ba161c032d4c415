"""Pictures of a fixed target and a known camera in, the camera's judged place in the vehicle out.

Within a run the camera is the one just solved; later it is one whose stored result was accepted, and its
covariance counts the same. Not here: the estimate (`core.vision.extrinsics`), the gate (`gates_extrinsics`).
"""

from dataclasses import dataclass

from service.core.quality.evidence import FixedTargetViews
from service.core.quality.gates import Measurement, Verdict, worst_verdict
from service.core.quality.gates_extrinsics import measure_extrinsics
from service.core.quality.limits import Limits
from service.core.vision.camera import Intrinsics
from service.core.vision.extrinsics import Extrinsics, estimate_extrinsics
from service.core.vision.transforms import Array, Pose
from service.core.vision.view_stack import View


@dataclass(frozen=True)
class JudgedPlace:
    """Where the camera is in the vehicle, with what was measured on it."""

    extrinsics: Extrinsics
    measurements: tuple[Measurement, ...]
    verdict: Verdict


def find_place(fixed: FixedTargetViews, intrinsics: Intrinsics, covariance: Array) -> Extrinsics:
    """Return where a camera is; covariance: (p, p) of its intrinsics. Raises PoseUndetermined."""
    points = fixed.target.object_points
    views = [View(points[v.detection.corner_ids], v.detection.image_points, v.name) for v in fixed.views]
    return estimate_extrinsics(views, intrinsics, covariance, fixed.place)


def judge_place(
    fixed: FixedTargetViews, intrinsics: Intrinsics, covariance: Array, limits: Limits, mounting: Pose | None
) -> JudgedPlace:
    """Find and judge where a camera is; mounting: the nominal T_vehicle_cam, if the SKU has one.

    Raises PoseUndetermined.
    """
    extrinsics = find_place(fixed, intrinsics, covariance)
    measurements = measure_extrinsics(extrinsics, limits, mounting)
    return JudgedPlace(extrinsics, measurements, worst_verdict(one.verdict for one in measurements))
