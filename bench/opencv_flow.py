"""OpenCV's calibration as its tutorial has it: default flags, `cornerSubPix` of 11x11, default solver.

Nothing is mended here (a window that suits the squares, a starting camera, more iterations): this is what a
person gets who follows the page. Not here: our detector and solver.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.vision.camera import Intrinsics
from service.core.vision.target import Target
from service.core.vision.transforms import Array

WINDOW = (11, 11)
CRITERIA = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, 30, 0.001)


@dataclass(frozen=True)
class OpencvResult:
    """What `cv2.calibrateCamera` returns, and the residuals (n, 2) px of each view."""

    intrinsics: Intrinsics
    rms_px: float
    residuals: tuple[Array, ...]


def find_with_opencv(image: NDArray[np.uint8], target: Target) -> Array | None:
    """Return the refined corners (n, 2) px of a grey image (h, w), or None where no board was found."""
    found, corners = cv2.findChessboardCorners(image, (target.columns, target.rows), None)
    if not found:
        return None
    refined = cv2.cornerSubPix(image, corners, WINDOW, (-1, -1), CRITERIA)
    return np.asarray(refined, dtype=np.float64).reshape(-1, 2)


def calibrate_with_opencv(
    corners: Sequence[Array], target: Target, image_size: tuple[int, int]
) -> OpencvResult | None:
    """Return OpenCV's calibration from the corners of some views; None where OpenCV gives up."""
    points = target.object_points.astype(np.float32)
    pixels = [view.astype(np.float32) for view in corners]
    try:
        rms, K, k, rvecs, tvecs = cv2.calibrateCamera([points] * len(pixels), pixels, image_size, None, None)
    except cv2.error:
        return None
    residuals = tuple(
        view - cv2.projectPoints(points, rvec, tvec, K, k)[0].reshape(-1, 2)
        for view, rvec, tvec in zip(corners, rvecs, tvecs, strict=True)
    )
    vector = np.r_[K[0, 0], K[1, 1], K[0, 2], K[1, 2], k.ravel()[:5]].astype(np.float64)
    return OpencvResult(Intrinsics.from_vector("pinhole5", vector, image_size), float(rms), residuals)
