"""A target's print as a flat picture, painted by OpenCV from its shapes."""

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.vision.printed import Area
from service.core.vision.target import Target
from service.core.vision.transforms import Array

SHIFT = 6


def paint_print(target: Target, px_per_m: float, border_m: float) -> tuple[NDArray[np.uint8], Array, float]:
    """Return a picture (h, w), the board point (2,), m, at the centre of its pixel (0, 0), and its scale."""
    low, high = target.outline[0, :2] - border_m, target.outline[2, :2] + border_m
    width, height = np.ceil((high - low) * px_per_m).astype(int)
    picture = np.full((height, width), 255, dtype=np.uint8)
    origin = low + 0.5 / px_per_m

    def fixed(points: Array) -> NDArray[np.int32]:
        return np.asarray(np.rint((points - origin) * px_per_m * 2**SHIFT), dtype=np.int32)

    for shape in target.shapes():
        if isinstance(shape, Area):
            cv2.fillPoly(picture, [fixed(loop) for loop in shape.loops], 0, lineType=cv2.LINE_AA, shift=SHIFT)
        else:
            x, y = (int(value) for value in fixed(shape.centre))
            radius = round(shape.radius_m * px_per_m * 2**SHIFT)
            cv2.circle(picture, (x, y), radius, 0, -1, cv2.LINE_AA, SHIFT)
    return picture, origin, px_per_m
