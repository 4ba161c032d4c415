"""Our solve against OpenCV's, on the same corners, in alternation, both on one thread.

Ours is the whole of what a run needs: two starts, covariance, proof of the optimum, leave-one-out. OpenCV's
is `calibrateCameraExtended` as it comes, which gives one start, deviations and rms per view; for the fisheye
it is `fisheye.calibrate`, which gives neither. `max_difference_px` compares the optima: the largest
difference of fx, fy, cx, cy and of the mapping, OpenCV's criteria tightened: over the rectangle that corners
were seen in, for the wide models at the corners themselves. The first keys are of the paper's lens model;
`rational8` (k6 held by both) and `kannala_brandt4` stand side by side with them.
"""

import os
import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import cv2
import numpy as np

from bench.simulated_units import (
    FISHEYE120,
    HFOV80,
    HFOV120,
    RATIONAL120,
    SIGMA_PX,
    Design,
    Unit,
    draw_units,
)
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
        wide = {design.name: _compare(design, units, repeats) for design in (RATIONAL120, FISHEYE120)}
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
        **wide,
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
    head = f"{'design':<16}{'ours ms':>9}{'OpenCV ms':>11}{'ratio':>7}"
    lines = [f"{head}{'largest difference px':>23}"]
    for name in ("hfov80", "hfov120", "rational8", "kannala_brandt4"):
        part = result[name]
        lines.append(
            f"{name:<16}{part['ours_ms']:>9.1f}{part['opencv_ms']:>11.1f}{part['time_ratio']:>7.2f}"
            f"{part['max_difference_px']:>23.2e}"
        )
    return "\n".join(lines)


def _compare(design: Design, units: int, repeats: int) -> dict[str, float]:
    """Return the medians of one design."""
    ours, opencv, differences = [], [], []
    for unit in map(_rounded, draw_units(design, units, (VIEWS, VIEWS), SEED)):
        differences.append(_difference(unit, _solve(unit, design), _solve_with_opencv(unit, design, TIGHT)))
        for _ in range(repeats):
            ours.append(_milliseconds(_solve, unit, design))
            opencv.append(_milliseconds(_solve_with_opencv, unit, design))
    return {
        "ours_ms": float(np.median(ours)),
        "opencv_ms": float(np.median(opencv)),
        "time_ratio": float(np.median(np.array(ours) / np.array(opencv))),
        "max_difference_px": max(differences),
    }


def _milliseconds(solve: Callable[[Unit, Design], object], unit: Unit, design: Design) -> float:
    start = time.perf_counter()
    solve(unit, design)
    return 1000.0 * (time.perf_counter() - start)


def _solve(unit: Unit, design: Design) -> CalibrationResult:
    """Return our result, leave-one-out done."""
    true = unit.true
    result = calibrate_intrinsics(
        unit.views, true.image_size, true.lens, nominal=unit.nominal, fixed=design.fixed
    )
    leave_one_out(result)
    return result


def _solve_with_opencv(unit: Unit, design: Design, criteria: tuple[int, int, float] = DEFAULT) -> Intrinsics:
    """Return OpenCV's result."""
    if unit.true.lens == "kannala_brandt4":
        return _solve_fisheye_with_opencv(unit, criteria)
    boards = [view.object_points.astype(np.float32) for view in unit.views]
    corners = [view.image_points.astype(np.float32) for view in unit.views]
    size, count = unit.true.image_size, len(unit.true.dist_coeffs)
    flags = cv2.CALIB_RATIONAL_MODEL if unit.true.lens == "rational8" else 0
    flags += cv2.CALIB_FIX_K6 if "k6" in design.fixed else 0
    # OpenCV returns the rational model's coefficients in a vector with places for further models.
    _, found_K, found_k, *_ = cv2.calibrateCameraExtended(
        boards, corners, size, np.zeros((3, 3)), np.zeros(count), flags=flags, criteria=criteria
    )
    K, k = np.asarray(found_K, dtype=np.float64), np.asarray(found_k, dtype=np.float64)
    return Intrinsics(unit.true.lens, K, k.ravel()[:count], size)


def _solve_fisheye_with_opencv(unit: Unit, criteria: tuple[int, int, float]) -> Intrinsics:
    """Return the result of OpenCV's fisheye module; it wants a dimension more and its own flags."""
    boards = [view.object_points[None] for view in unit.views]
    corners = [view.image_points[None] for view in unit.views]
    size, K, k = unit.true.image_size, np.zeros((3, 3)), np.zeros((4, 1))
    flags = cv2.CALIB_RECOMPUTE_EXTRINSIC + cv2.CALIB_FIX_SKEW
    cv2.fisheye.calibrate(boards, corners, size, K, k, flags=flags, criteria=criteria)
    return Intrinsics(unit.true.lens, K, k[:, 0], size)


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
    rectangle = Region(*corners.min(axis=0), *corners.max(axis=0))
    seen = rectangle if unit.true.lens == "pinhole5" else corners
    mapping = mapping_difference(ours.intrinsics, opencv, seen)
    return float(max(pinhole, np.nanmax(mapping)))
