"""How much of a picture's grey levels is noise, by what even surfaces and straight ramps cannot explain.

Not here: the noise of corners (`local_noise`).
"""

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.vision.transforms import Array

# The difference of two Laplacians: zero on planes, of variance 36 for noise of variance 1 (Immerkaer 1996).
KERNEL = np.array([[1, -2, 1], [-2, 4, -2], [1, -2, 1]], dtype=np.float32)
GAIN = 6.0
SD_PER_MEDIAN = 1.4826  # of the absolute value of a normal distribution


def noise_around(image: NDArray[np.uint8], points: Array) -> float:
    """Return the sd of the noise, grey levels, in the box around points (n, 2) px of an image (h, w).

    A median, so that edges do not count as long as they are fewer than even places.
    """
    low = np.maximum(np.floor(points.min(axis=0)).astype(int), 0)
    high = np.ceil(points.max(axis=0)).astype(int) + 1
    part = image[low[1] : high[1], low[0] : high[0]].astype(np.float32)
    return float(SD_PER_MEDIAN * np.median(np.abs(cv2.filter2D(part, -1, KERNEL))) / GAIN)
