"""Capture by itself: the board matches, is held still, is sharp and well lit, for a dwell time.

Pure: times are values in seconds. Not here: whether the pose matches (`comparison`), and which pose is next
(`session`).
"""

from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from service.core.guidance.observation import Observation


@dataclass(frozen=True)
class CaptureLimits:
    """What a frame must meet to be captured, and for how long.

    dwell_s: how long every frame must meet it. still_px: mean corner motion between two frames, at most.
    longest_gap_s: frames that are farther apart say nothing about stillness; a slow link or a busy computer
    that brings two in a second must still be able to capture. sharp_px: widest 10–90 % edge.
    darkest, brightest: bounds of the grey level of the board's bright squares. glare_share: of these squares,
    how much may be saturated.
    """

    dwell_s: float = 0.5
    still_px: float = 2.5
    longest_gap_s: float = 1.0
    sharp_px: float = 4.5
    darkest: float = 40.0
    brightest: float = 250.0
    glare_share: float = 0.15


class Obstacle(StrEnum):
    """Why a frame with the board in it cannot be captured."""

    NOT_MATCHED = "not-matched"
    MOVING = "moving"
    BLURRED = "blurred"
    TOO_DARK = "too-dark"
    TOO_BRIGHT = "too-bright"
    GLARE = "glare"


@dataclass(frozen=True)
class Dwell:
    """Frames that met everything, one after another: since when, until when, and the sharpest of them.

    sequence, sharpest_s, edge_width_px: of the sharpest frame of the last dwell time.
    """

    since_s: float
    until_s: float
    sequence: int
    sharpest_s: float
    edge_width_px: float


def find_obstacles(
    matched: bool, before: Observation | None, now: Observation, limits: CaptureLimits
) -> tuple[Obstacle, ...]:
    """Return what forbids to capture the present frame, the first thing to mend first; () where nothing does.

    before: the frame that was seen last; without one nothing is known to be still.
    """
    width_px, brightness, glare = now.edge_width_px, now.brightness, now.glare_share
    found = {
        Obstacle.NOT_MATCHED: not matched,
        Obstacle.TOO_DARK: brightness is not None and brightness < limits.darkest,
        Obstacle.TOO_BRIGHT: brightness is not None and brightness > limits.brightest,
        Obstacle.GLARE: glare is not None and glare > limits.glare_share,
        Obstacle.MOVING: not is_still(before, now, limits),
        Obstacle.BLURRED: width_px is not None and width_px > limits.sharp_px,
    }
    return tuple(obstacle for obstacle, stands in found.items() if stands)


def is_still(before: Observation | None, now: Observation, limits: CaptureLimits) -> bool:
    """Whether the board's corners hardly moved since the frame before."""
    if before is None or before.image_points is None or now.image_points is None:
        return False
    if before.image_points.shape != now.image_points.shape:
        return False
    if not 0.0 < now.at_s - before.at_s <= limits.longest_gap_s:
        return False
    motion = np.linalg.norm(now.image_points - before.image_points, axis=-1)
    return bool(motion.mean() <= limits.still_px)


def extend_dwell(dwell: Dwell | None, now: Observation, limits: CaptureLimits) -> Dwell:
    """Return the dwell with one more good frame; the sharpest frame is kept, the latest of equals.

    One that is older than the dwell time gives way: a board may be held for long before a key is pressed, and
    sources keep their frames for a moment only.
    """
    width = float("inf") if now.edge_width_px is None else now.edge_width_px
    since_s = now.at_s if dwell is None else dwell.since_s
    is_old = dwell is not None and now.at_s - dwell.sharpest_s > limits.dwell_s
    if dwell is None or is_old or width <= dwell.edge_width_px:
        return Dwell(since_s, now.at_s, now.sequence, now.at_s, width)
    return replace(dwell, until_s=now.at_s)


def dwell_share(dwell: Dwell | None, limits: CaptureLimits) -> float:
    """Return how much of the dwell time is over: 0…1; the frame is captured at 1."""
    if dwell is None:
        return 0.0
    return min(1.0, (dwell.until_s - dwell.since_s) / limits.dwell_s) if limits.dwell_s > 0 else 1.0
