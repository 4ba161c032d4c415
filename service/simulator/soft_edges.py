"""Edges as ramps, a pixel's footprint wide, for pictures that must be drawn fast. Not here: exact areas."""

import cv2
import numpy as np
from numpy.typing import NDArray

Levels = NDArray[np.float32]

WIDEST_RAMP = 1.0  # of a square: wider, and its neighbours would be left out


def footprint_of(u: Levels) -> Levels:
    """Return how far (h, w) a coordinate changes over a pixel, at most a square."""
    dx = cv2.Sobel(u, cv2.CV_32F, 1, 0, ksize=1, scale=0.5, borderType=cv2.BORDER_REPLICATE)
    dy = cv2.Sobel(u, cv2.CV_32F, 0, 1, ksize=1, scale=0.5, borderType=cv2.BORDER_REPLICATE)
    return np.clip(cv2.magnitude(dx, dy), np.float32(1e-6), np.float32(WIDEST_RAMP))


def soft_window(u: Levels, footprint: Levels, low: float, high: float) -> Levels:
    """Return the share (h, w) of each pixel between two edges."""
    return soft_step(np.minimum(u - np.float32(low), np.float32(high) - u), footprint)


def soft_step(distance: Levels, footprint: Levels) -> Levels:
    """Return the share (h, w) of each pixel beyond an edge, by its centre's distance beyond it."""
    beyond: Levels = distance / footprint
    beyond += np.float32(0.5)
    np.clip(beyond, 0.0, 1.0, out=beyond)
    return beyond
