"""Our solve against OpenCV's, on the same corners, in alternation, both on one thread.

Ours is the whole of what a run needs: two starts, covariance, proof of the optimum, leave-one-out. OpenCV's
is `calibrateCameraExtended` as it comes, which gives one start, deviations and rms per view.
`max_difference_px` compares the optima: the largest difference of fx, fy, cx, cy and of the mapping over the
image, OpenCV's criteria tightened.
"""

import os
import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import cv2
import numpy as np

from bench.simulated_units import HFOV80, HFOV120, SIGMA_PX, Design, Unit, draw_units
from service.core.vision.calibration import CalibrationResult, calibrate_intrinsics
from service.core.vision.camera import Intrinsics
from service.core.vision.leave_one_out import leave_one_out
from service.core.vision.uncertainty import Region, mapping_difference

SEED = 7
VIEWS = 20
DEFAULT = (cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 30, float(np.finfo(np.float64).eps))
TIGHT = (cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 500, 1e-15)


def run(quick: bool) -> dict[str, Any]:
    """Return median times in ms, the median of their ratios, and the largest difference of the optima."""
    units, repeats = (3, 5) if quick else (10, 20)
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)
    try:
        designs = {design.name: _compare(design, units, repeats) for design in (HFOV80, HFOV120)}
    finally:
        cv2.setNumThreads(threads)
    ours = float(np.median([part["ours_ms"] for part in designs.values()]))
    opencv = float(np.median([part["opencv_ms"] for part in designs.values()]))
    return {
        "ours_ms": ours,
        "opencv_ms": opencv,
        "time_ratio": float(np.median([part["time_ratio"] for part in designs.values()])),
        "max_difference_px": max(part["max_difference_px"] for part in designs.values()),
        **designs,
        "seeds": [SEED],
        "conditions": {
            "views": VIEWS,
            "corners": 54,
            "sigma_px": SIGMA_PX,
            "threads": "OpenCV 1; the matrices of ours are below what BLAS shares between threads",
            "openblas_num_threads": os.environ.get("OPENBLAS_NUM_THREADS", "default"),
        },
    }


def table(result: Mapping[str, Any]) -> str:
    """Return the comparison as text."""
    lines = [f"{'design':<9}{'ours ms':>9}{'OpenCV ms':>11}{'ratio':>7}{'largest difference px':>23}"]
    for name in ("hfov80", "hfov120"):
        part = result[name]
        lines.append(
            f"{name:<9}{part['ours_ms']:>9.1f}{part['opencv_ms']:>11.1f}{part['time_ratio']:>7.2f}"
            f"{part['max_difference_px']:>23.2e}"
        )
    return "\n".join(lines)


def _compare(design: Design, units: int, repeats: int) -> dict[str, float]:
    """Return the medians of one design."""
    ours, opencv, differences = [], [], []
    for unit in map(_rounded, draw_units(design, units, (VIEWS, VIEWS), SEED)):
        differences.append(_difference(unit, _solve(unit), _solve_with_opencv(unit, TIGHT)))
        for _ in range(repeats):
            ours.append(_milliseconds(_solve, unit))
            opencv.append(_milliseconds(_solve_with_opencv, unit))
    return {
        "ours_ms": float(np.median(ours)),
        "opencv_ms": float(np.median(opencv)),
        "time_ratio": float(np.median(np.array(ours) / np.array(opencv))),
        "max_difference_px": max(differences),
    }


def _milliseconds(solve: Callable[[Unit], object], unit: Unit) -> float:
    start = time.perf_counter()
    solve(unit)
    return 1000.0 * (time.perf_counter() - start)


def _solve(unit: Unit) -> CalibrationResult:
    """Return our result, leave-one-out done."""
    result = calibrate_intrinsics(unit.views, unit.true.image_size, nominal=unit.nominal)
    leave_one_out(result, unit.views)
    return result


def _solve_with_opencv(unit: Unit, criteria: tuple[int, int, float] = DEFAULT) -> Intrinsics:
    """Return OpenCV's result."""
    boards = [view.object_points.astype(np.float32) for view in unit.views]
    corners = [view.image_points.astype(np.float32) for view in unit.views]
    size, K, k = unit.true.image_size, np.zeros((3, 3)), np.zeros(5)
    cv2.calibrateCameraExtended(boards, corners, size, K, k, criteria=criteria)
    return Intrinsics("pinhole5", K, k, size)


def _rounded(unit: Unit) -> Unit:
    """Return a unit with corners of single precision, which is all that OpenCV's interface takes."""
    views = [
        replace(view, image_points=view.image_points.astype(np.float32).astype(np.float64))
        for view in unit.views
    ]
    return replace(unit, views=views)


def _difference(unit: Unit, ours: CalibrationResult, opencv: Intrinsics) -> float:
    """Return the largest difference, px, of focal lengths, centre and mapping where corners were seen."""
    pinhole = np.abs(ours.intrinsics.vector[:4] - opencv.vector[:4]).max()
    corners = np.concatenate([view.image_points for view in unit.views])
    seen = Region(*corners.min(axis=0), *corners.max(axis=0))
    mapping = mapping_difference(ours.intrinsics, opencv, seen)
    return float(max(pinhole, np.nanmax(mapping)))
