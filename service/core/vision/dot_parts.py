"""Whether a lattice of dots that is not the whole target is a part of a grid, a larger one, or just pattern.

A perforated plate makes lattices too: they go on and on, or much else lies beside them.
Not here: how a lattice is grown and put in order (`dot_lattice`).
"""

from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.vision.detection_circles import SHARE_OF_A_GRID
from service.core.vision.dot_lattice import Dots, Lattice
from service.core.vision.live_detected import BoardKind
from service.core.vision.target_circles import Circles
from service.core.vision.transforms import Array

LARGEST_GRID: Final = 4  # times the target's dots
LEAST_LARGEST: Final = 150  # dots that a grid may have at any rate
LEAST_DOTS: Final = 12  # fewer occur by chance
STRAY_DOTS: Final = 120  # beside a grid, from which on the frame is full of pattern
LARGEST_SHARES: Final = {"partial": 0.7, "wrong": 0.5}  # of the frame: more is a pattern that goes on outside
LEAST_FULL: Final = 0.6  # of the places of a rectangle around a lattice
SOLID: Final = 0.75  # of the fullest line: a line of a larger grid has more, not so specks at an edge


def largest_grid(target: Circles) -> int:
    """Return how many dots a grid may have: what has more is no board."""
    return max(LARGEST_GRID * target.columns * target.rows, LEAST_LARGEST)


def kind_of_part(lattice: Lattice, dots: Dots, frame_px: int, target: Circles) -> BoardKind:
    """Return what a lattice of a frame's dots that is not the whole target is told as.

    frame_px: how many pixels the frame has.
    """
    least = max(LEAST_DOTS, SHARE_OF_A_GRID * target.columns * target.rows)
    is_sized = least <= len(lattice) <= largest_grid(target)
    if not is_sized or len(dots.points) - len(lattice) > STRAY_DOTS:
        return "absent"
    kind: BoardKind = "wrong" if is_larger(lattice, target) else "partial"
    share = area_px(dots.points[lattice.dots]) / frame_px
    is_bounded = share <= LARGEST_SHARES[kind] and _fullness(_upright(lattice)) >= LEAST_FULL
    return kind if is_bounded else "absent"


def area_px(points: Array) -> float:
    """Return the area, px², that points (n, 2) span."""
    return float(cv2.contourArea(cv2.convexHull(points.astype(np.float32))))


def is_larger(lattice: Lattice, target: Circles) -> bool:
    """Whether a grid has more lines than the target one way or the other, solid ones."""
    spans = []
    for along in _upright(lattice).T:
        counts = np.bincount(along - along.min())
        spans.append(int(np.ptp(np.flatnonzero(counts > SOLID * counts.max()))))
    few, many = sorted((2 * target.columns - 1, target.rows - 1))
    return max(spans) > many or min(spans) > few


def _upright(lattice: Lattice) -> NDArray[np.int64]:
    """Return the places (m, 2), in steps, by the reading of the lattice that fills a rectangle best."""
    return max(lattice.steps, key=_fullness)


def _fullness(steps: NDArray[np.int64]) -> float:
    """Return the share of a rectangle around steps (m, 2) that is taken: every other exists."""
    return float(2 * len(steps) / np.prod(np.ptp(steps, axis=0) + 1))
