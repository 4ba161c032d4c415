"""The cross-check gate: do parts of the views, solved by themselves, lead to the same camera?

Two cameras in one run, a lens that was touched half-way or a view with a wrong corner agree on an average
that fits nobody; their halves do not. Not seen here: what all views share, such as a bent board
(`gates_bias`).
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from service.core.errors import ServiceError
from service.core.quality.evidence import Evidence
from service.core.quality.gates import Measurement, Verdict, check_limit
from service.core.vision.calibration import CalibrationResult, View, calibrate_intrinsics
from service.core.vision.leave_one_out import leave_one_out
from service.core.vision.uncertainty import mapping_difference, mapping_error

GATE = "cross_check"
FEWEST_VIEWS = 8  # four in each half determine a camera


def measure_cross_check(evidence: Evidence) -> tuple[Measurement, ...]:
    """Return the measurements of the cross-check gate; none for fewer than eight views."""
    if len(evidence.views) < FEWEST_VIEWS or not evidence.result.converged:
        return ()
    points = evidence.board
    views = [View(points[v.detection.corner_ids], v.detection.image_points, v.name) for v in evidence.views]
    return (_halves(evidence, views), _held_out(evidence))


def _worst(evidence: Evidence) -> Verdict:
    """Without a SKU the board is somebody's paper, and what it is bent by differs from half to half."""
    return Verdict.MARGINAL if evidence.expectation is None else Verdict.FAIL


def _halves(evidence: Evidence, views: Sequence[View]) -> Measurement:
    order = np.arange(len(views))
    # Cameras may have been changed at every picture, or once.
    sides = (order % 2, order // 2 % 2, 2 * order // len(views))
    return check_limit(
        GATE,
        "half_difference",
        max(_difference(evidence, views, side) for side in sides),
        "<=",
        evidence.limits,
        good="Halves of the views lead to the same camera, as far as noise lets them.",
        bad="Halves of the views lead to different cameras.",
        remedy="Check that all images are of this one camera, that its lens is fixed and focused, and that "
        "the serial is that of the camera; then take the views again.",
        worst=_worst(evidence),
    )


def _difference(evidence: Evidence, views: Sequence[View], half: NDArray[np.int64]) -> float:
    """Return how far apart the halves' cameras are over what noise would make it; inf without two cameras.

    As a map over the working zone and in standard deviations of the parameters, whichever is less: the map
    has so few degrees of freedom that noise alone doubles it now and then, and parameters can differ where
    the map does not.
    """
    parts = [[view for view, side in zip(views, half, strict=True) if side == wanted] for wanted in (0, 1)]
    solved = [_solve(evidence, part) for part in parts]
    first, second = solved
    if first is None or second is None:
        return float("inf")
    distances = mapping_difference(first.intrinsics, second.intrinsics, evidence.working_grid)
    covariance = first.covariance * _noise(evidence, first) + second.covariance * _noise(evidence, second)
    expected = mapping_error(evidence.result.intrinsics, covariance, evidence.working_grid).mean_px
    free = np.flatnonzero(np.diagonal(covariance) > 0)
    apart = (first.intrinsics.vector - second.intrinsics.vector)[free]
    squared = float(apart @ np.linalg.solve(covariance[np.ix_(free, free)], apart))
    return min(float(np.sqrt(np.mean(distances**2))) / expected, float(np.sqrt(squared / len(free))))


def _solve(evidence: Evidence, views: Sequence[View]) -> CalibrationResult | None:
    whole = evidence.result
    try:
        return calibrate_intrinsics(
            views,
            whole.intrinsics.image_size,
            whole.intrinsics.lens,
            nominal=whole.intrinsics,
            fixed=whole.fixed,
        )
    except ServiceError:
        return None


def _noise(evidence: Evidence, half: CalibrationResult) -> float:
    """Return the factor that gives a half's covariance the noise of the whole solve, known better."""
    return (evidence.result.sigma_px / half.sigma_px) ** 2 if half.sigma_px > 0 else 1.0


def _held_out(evidence: Evidence) -> Measurement:
    left_out = leave_one_out(evidence.result)
    ratio = left_out.held_out_rms_px / np.maximum(np.median(left_out.fit_rms_px), 1e-9)
    worst = evidence.names[int(np.nanargmax(np.where(np.isfinite(ratio), ratio, -1.0)))]
    return check_limit(
        GATE,
        "held_out_ratio",
        left_out.ratio,
        "<=",
        evidence.limits,
        good="Every view fits the camera that the others find.",
        bad=f"Views do not fit the camera that the others find, {worst} least of all.",
        remedy=f"Take {worst} again, or add views of that kind: alone it decides too much.",
        worst=_worst(evidence),
        facts={"views": [worst]},
    )
