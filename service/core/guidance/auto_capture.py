"""Capture by itself: the board matches, is held still, is sharp and well lit, for a dwell time.

Pure: times are values in seconds. Not here: whether the pose matches (`comparison`), and which pose is next
(`session`).
"""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from service.core.guidance.observation import Observation


@dataclass(frozen=True)
class CaptureLimits:
    """What a frame must meet to be captured, and for how long.

    dwell_s: how long every frame must meet it. still_px: mean corner motion between two frames, at most.
    longest_gap_s: frames that are farther apart say nothing about stillness. sharp_px: widest 10–90 % edge.
    darkest, brightest: bounds of the grey level of the board's bright squares.
    """

    dwell_s: float = 0.5
    still_px: float = 2.5
    longest_gap_s: float = 0.3
    sharp_px: float = 4.5
    darkest: float = 40.0
    brightest: float = 250.0


class Obstacle(StrEnum):
    """Why a frame with the board in it cannot be captured."""

    NOT_MATCHED = "not-matched"
    MOVING = "moving"
    BLURRED = "blurred"
    TOO_DARK = "too-dark"
    TOO_BRIGHT = "too-bright"


@dataclass(frozen=True)
class Dwell:
    """Frames that met everything, one after another: since when, until when, and the sharpest of them."""

    since_s: float
    until_s: float
    sequence: int
    edge_width_px: float


def find_obstacle(
    matched: bool, before: Observation | None, now: Observation, limits: CaptureLimits
) -> Obstacle | None:
    """Return the first thing that forbids to capture the present frame; None where nothing does.

    before: the frame that was seen last; without one nothing is known to be still.
    """
    if not matched:
        return Obstacle.NOT_MATCHED
    if now.brightness is not None and now.brightness < limits.darkest:
        return Obstacle.TOO_DARK
    if now.brightness is not None and now.brightness > limits.brightest:
        return Obstacle.TOO_BRIGHT
    if not is_still(before, now, limits):
        return Obstacle.MOVING
    if now.edge_width_px is not None and now.edge_width_px > limits.sharp_px:
        return Obstacle.BLURRED
    return None


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


def extend_dwell(dwell: Dwell | None, now: Observation) -> Dwell:
    """Return the dwell with one more good frame; the sharpest frame is kept, the latest of equals."""
    width = float("inf") if now.edge_width_px is None else now.edge_width_px
    if dwell is None:
        return Dwell(now.at_s, now.at_s, now.sequence, width)
    if width <= dwell.edge_width_px:
        return Dwell(dwell.since_s, now.at_s, now.sequence, width)
    return Dwell(dwell.since_s, now.at_s, dwell.sequence, dwell.edge_width_px)


def dwell_share(dwell: Dwell | None, limits: CaptureLimits) -> float:
    """Return how much of the dwell time is over: 0…1; the frame is captured at 1."""
    if dwell is None:
        return 0.0
    return min(1.0, (dwell.until_s - dwell.since_s) / limits.dwell_s) if limits.dwell_s > 0 else 1.0
