"""A target's whole pattern, ready to be drawn: its dark outlines, its size, and the white around it.

Not here: paper (`sheet`), and virtual pictures, which are drawn by ray and not by outline.
"""

from dataclasses import dataclass

import numpy as np

from service.core.vision.printed import Area, Disc
from service.core.vision.target import Target
from service.core.vision.transforms import Array

LEAST_QUIET_M = 0.004
QUIET_SHARE = 0.15  # of a square, where that is more
MOST_PARTS = 20  # of a square in which features may lie at whole steps
WHOLE = 1e-6  # of a step


@dataclass(frozen=True)
class Pattern:
    """What is dark of a target, m, in the board's frame.

    loops (k, 2) bound the dark areas, by the even-odd rule; discs (n, 3) are dark, by centre and radius.
    corner (2,) and size (2,) are of the rectangle around all of it; quiet_m must stay white around that.
    step_m: features lie at whole multiples of it; None where there is no such step.
    """

    loops: tuple[Array, ...]
    discs: Array
    corner: Array
    size: Array
    quiet_m: float
    step_m: float | None


def pattern_of(target: Target) -> Pattern:
    """Return the pattern of a target."""
    shapes = target.shapes()
    discs = [[*shape.centre, shape.radius_m] for shape in shapes if isinstance(shape, Disc)]
    outline = target.outline[:, :2]
    return Pattern(
        loops=tuple(loop for shape in shapes if isinstance(shape, Area) for loop in shape.loops),
        discs=np.array(discs, dtype=np.float64).reshape(-1, 3),
        corner=outline.min(axis=0),
        size=np.asarray(np.ptp(outline, axis=0)),
        quiet_m=max(LEAST_QUIET_M, QUIET_SHARE * target.square_m),
        step_m=_even_step(target),
    )


def _even_step(target: Target) -> float | None:
    """Return the largest part of a square of which all features are whole multiples, m."""
    squares = target.object_points[:, :2] / target.square_m
    for parts in range(1, MOST_PARTS + 1):
        if np.all(np.abs(squares * parts - np.round(squares * parts)) < WHOLE):
            return target.square_m / parts
    return None
