"""A virtual hand that reads only hints: codes and coarse amounts, never a pose or a picture.

Not here: what a camera sees of the board that it holds.
"""

from dataclasses import dataclass

import numpy as np

from service.core.guidance.hints import ShownHint
from service.core.vision.target import Chessboard
from service.core.vision.transforms import Pose


@dataclass(frozen=True)
class Habits:
    """How a hand moves: fastest speeds, reaction time, tremor, and how often it errs."""

    speed_m_s: float = 0.25
    turn_rad_s: float = 1.05
    reaction_s: float = 0.25


class Hand:
    """A hand that holds a board and does what it is told, late, shaking and a little too far."""

    def __init__(self, target: Chessboard, start: Pose | None = None, habits: Habits | None = None) -> None:
        self._target = target
        self._habits = habits or Habits()
        self._pose = start or Pose(np.zeros(3), np.array([0.0, 0.0, 0.5]) - target.centre)

    @property
    def pose(self) -> Pose:
        """Where the board is now, `T_cam_board`; it may be outside the picture or upside down."""
        return self._pose

    def step(self, hints: tuple[ShownHint, ...], dt_s: float, rng: np.random.Generator) -> Pose:
        """Move on by dt_s with these hints on the screen and return the new pose."""
        return self._pose
