"""Grey values between pixels. Not here: what is read out of them."""

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.vision.transforms import Array

FloatImage = NDArray[np.float32]


def smooth(image: NDArray[np.uint8] | FloatImage, sigma_px: float) -> FloatImage:
    """Return an image (h, w) blurred by a Gaussian in floating point: rounded grey levels move corners."""
    return np.asarray(cv2.GaussianBlur(image.astype(np.float32), (0, 0), sigma_px), dtype=np.float32)


def middle_of(image: FloatImage | NDArray[np.uint8]) -> Array:
    """Return the middle (2,) px of an image (h, w)."""
    return (np.array(image.shape[::-1]) - 1.0) / 2.0


def sample_bilinear(image: FloatImage | NDArray[np.uint8], x: Array, y: Array) -> Array:
    """Return grey values (...) of an image (h, w) at x, y (...) px; those outside are moved to the border.

    Written out because cv2.remap rounds positions to 1/32 px, which is as much as the corner error allowed.
    """
    height, width = image.shape
    x = np.minimum(np.maximum(x, 0.0), width - 1.001)
    y = np.minimum(np.maximum(y, 0.0), height - 1.001)
    column, row = x.astype(np.int64), y.astype(np.int64)
    a, b = x - column, y - row
    flat, start = image.ravel(), row * width + column
    top = flat[start] * (1.0 - a) + flat[start + 1] * a
    bottom = flat[start + width] * (1.0 - a) + flat[start + width + 1] * a
    values: Array = top * (1.0 - b) + bottom * b
    return values
