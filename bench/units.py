"""Many simulated cameras, nominals five per cent off: does a result that is wrong ever look right?

A result is wrong when fx, fy, cx or cy is off by more than 5 px, or the rotation-compensated mapping within
the middle 80 % of the image. It is failed when it did not converge or exceeds a default limit of the
certainty gate, the mapping error being taken over that same middle. OpenCV's solver runs on the first of the
same units as it comes: no nominal, default criteria, no gate.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np

from bench.simulated_units import HFOV80, HFOV120, SIGMA_PX, Design, Unit, draw_units
from service.core.quality.limits import default_limits
from service.core.vision.calibration import CalibrationResult, calibrate_intrinsics
from service.core.vision.camera import Intrinsics
from service.core.vision.uncertainty import Region, mapping_difference, mapping_error

SEED = 20
WRONG_PX = 5.0
VIEWS = (12, 15)
GRID = (7, 5)


@dataclass(frozen=True)
class _Outcome:
    wrong: bool
    converged: bool
    failed: bool
    focal_off_px: float
    within_sd: float


def run(quick: bool) -> dict[str, Any]:
    """Return the counts of both designs; `off_not_failed` first, which must be zero."""
    count, peers = (60, 12) if quick else (1000, 200)
    designs = {design.name: _judge_design(design, count, peers) for design in (HFOV120, HFOV80)}
    totals = {
        name: sum(int(part[name]) for part in designs.values())
        for name in ("off_not_failed", "off_converged")
    }
    return {**totals, **designs, "sigma_px": SIGMA_PX, "views": list(VIEWS), "seeds": [SEED]}


def table(result: Mapping[str, Any]) -> str:
    """Return the counts as text."""
    head = (
        f"{'design':<9}{'units':>7}{'not converged':>15}{'failed':>8}{'off':>5}{'off, converged':>16}"
        f"{'off, not failed':>17}{'sd of fx':>10}   OpenCV off / units"
    )
    lines = [head]
    for name in ("hfov120", "hfov80"):
        part = result[name]
        lines.append(
            f"{name:<9}{part['units']:>7}{part['not_converged']:>15}{part['failed']:>8}{part['off']:>5}"
            f"{part['off_converged']:>16}{part['off_not_failed']:>17}{part['focal_sd_px']:>10.2f}"
            f"   {part['opencv']['off']} / {part['opencv']['units']}"
        )
    return "\n".join(lines)


def _judge_design(design: Design, count: int, peers: int) -> dict[str, Any]:
    """Return the counts of one design."""
    outcomes, opencv_wrong = [], 0
    for i, unit in enumerate(draw_units(design, count, VIEWS, SEED)):
        outcomes.append(_judge_unit(unit))
        if i < peers:
            opencv_wrong += int(_is_wrong(_calibrate_with_opencv(unit), unit.true))
    return {
        "units": count,
        "not_converged": sum(not outcome.converged for outcome in outcomes),
        "failed": sum(outcome.failed for outcome in outcomes),
        "off": sum(outcome.wrong for outcome in outcomes),
        "off_converged": sum(outcome.wrong and outcome.converged for outcome in outcomes),
        "off_not_failed": sum(outcome.wrong and not outcome.failed for outcome in outcomes),
        "focal_sd_px": float(np.std([outcome.focal_off_px for outcome in outcomes])),
        "focal_z_rms": float(np.sqrt(np.mean([outcome.within_sd**2 for outcome in outcomes]))),
        "opencv": {"units": min(peers, count), "off": opencv_wrong},
    }


def _judge_unit(unit: Unit) -> _Outcome:
    result = calibrate_intrinsics(unit.views, unit.true.image_size, nominal=unit.nominal)
    off = float(result.intrinsics.vector[0] - unit.true.vector[0])
    return _Outcome(
        wrong=_is_wrong(result.intrinsics, unit.true),
        converged=result.converged,
        failed=_is_failed(result),
        focal_off_px=off,
        within_sd=off / result.sd["fx"],
    )


def _is_wrong(found: Intrinsics, true: Intrinsics) -> bool:
    """Whether a focal length, the centre or the mapping is off by more than 5 px."""
    if float(np.abs(found.vector[:4] - true.vector[:4]).max()) > WRONG_PX:
        return True
    difference = mapping_difference(true, found, _middle(true).grid(*GRID))
    return not bool(np.all(difference <= WRONG_PX))


def _is_failed(result: CalibrationResult) -> bool:
    """Whether convergence or certainty fails the result."""
    limits, sd = default_limits(result.intrinsics.image_size), result.sd
    focal = max(sd["fx"] / result.intrinsics.vector[0], sd["fy"] / result.intrinsics.vector[1])
    centre = max(sd["cx"], sd["cy"])
    mapping = mapping_error(result.intrinsics, result.covariance, _middle(result.intrinsics))
    return bool(
        not result.converged
        or focal > limits.focal_sd_share
        or centre > limits.centre_sd_px
        or mapping.mean_px > limits.zone_mapping_px
        or mapping.worst_px > limits.valid_mapping_px
    )


def _middle(camera: Intrinsics) -> Region:
    """Return the middle 80 % of a camera's image."""
    width, height = camera.image_size
    return Region(0.1 * width, 0.1 * height, 0.9 * width, 0.9 * height)


def _calibrate_with_opencv(unit: Unit) -> Intrinsics:
    """Return OpenCV's result with its defaults."""
    boards = [view.object_points.astype(np.float32) for view in unit.views]
    corners = [view.image_points.astype(np.float32) for view in unit.views]
    _, K, k, _, _ = cv2.calibrateCamera(boards, corners, unit.true.image_size, None, None)
    vector = np.r_[K[0, 0], K[1, 1], K[0, 2], K[1, 2], k.ravel()[:5]].astype(np.float64)
    return Intrinsics.from_vector("pinhole5", vector, unit.true.image_size)
