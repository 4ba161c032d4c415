"""What stands behind the board: gradients, boxes, blobs and bars out of focus. Not here: the board.

Shapes are opaque, each of its own grey, so that where edges meet there are Ts and Ls and never the X of a
chessboard's corner.
"""

import cv2
import numpy as np

from service.core.vision.transforms import Array

MIDDLE_GREY = 90.0


def paint_background(size: tuple[int, int], contrast: float, seed: int) -> Array:
    """Return a picture (h, w) in grey levels for size (width, height), px; the same for the same seed."""
    rng = np.random.default_rng(seed)
    picture = _gradient(size, rng)
    for _ in range(int(rng.integers(14, 26))):
        _paint_shape(picture, rng)
    soft = cv2.GaussianBlur(picture, (0, 0), max(size) / 640).astype(np.float64)
    return MIDDLE_GREY + contrast * (soft - MIDDLE_GREY)


def _gradient(size: tuple[int, int], rng: np.random.Generator) -> Array:
    width, height = size
    slope_x, slope_y = rng.uniform(-50.0, 50.0, 2)
    across = np.linspace(-1.0, 1.0, width)
    down = np.linspace(-1.0, 1.0, height)[:, None]
    gradient: Array = MIDDLE_GREY + slope_x * across + slope_y * down
    return gradient


def _paint_shape(picture: Array, rng: np.random.Generator) -> None:
    height, width = picture.shape
    centre = (int(rng.integers(0, width)), int(rng.integers(0, height)))
    half = rng.uniform(0.02, 0.18, 2) * width
    grey, turn = float(rng.uniform(15.0, 200.0)), float(rng.uniform(0.0, 180.0))
    kind = rng.integers(0, 3)
    if kind == 0:
        axes = (int(half[0]), int(half[1]))
        cv2.ellipse(picture, centre, axes, turn, 0.0, 360.0, grey, thickness=-1)
    else:
        # Every third shape is a bar: cables, frames and edges of doors.
        size = (2.0 * half[0], 2.0 * half[1] if kind == 1 else 0.01 * width)
        corners = cv2.boxPoints((centre, size, turn))
        cv2.fillConvexPoly(picture, corners.round().astype(np.int32), grey)
