"""A virtual hand that reads only hints: codes and coarse amounts, never a pose or a picture.

It reacts late, goes on for a moment when a hint ends, trembles, and now and then lowers the board out of the
picture and comes back, sometimes with the board upside down. What it knows besides the hints is where the
camera is, as anyone does who stands before it. Not here: what a camera sees of the board.
"""

from collections import deque
from dataclasses import dataclass
from typing import Final

import numpy as np

from service.core.guidance.hints import Hint, ShownHint
from service.core.vision.target import Target
from service.core.vision.transforms import Array, Pose
from service.simulator.grip import grip_of
from service.simulator.steering import Steering
from service.simulator.tremor import Tremor

FLIP_S: Final = 0.8
FLIP_ERROR_RAD: Final = float(np.deg2rad(8.0))
LAPSE_S: Final = 1.0
LOWERING_M_S: Final = 0.5
HOMING_S: Final = 0.2  # the last part of the way home takes about so long
CAREFUL: Final = 0.25  # of full speed, where only a part of the board is missing
SHIFTS_ONLY: Final = np.array([1.0, 1.0, 1.0, 0.0, 0.0, 0.0])
MIRROR: Final = np.array([-1.0, 1.0, 1.0, 1.0, -1.0, -1.0])


@dataclass(frozen=True)
class Habits:
    """How a hand moves: no quicker than people do.

    A hint's amount sets the pace, so that hand and hints are a loop of speed_m_s / FAR_M = 1.3 rad/s. People
    who keep one thing in place on a screen reach about 3 (McRuer and Jex 1967, the crossover model).

    speed_m_s, turn_rad_s: at full pace. reaction_s: from a hint on the screen to the hand. inertia_s: how
    long a change of pace takes. tremor_*: standard deviations and memory. lapses_per_s: how often the board
    is lowered out of the picture; upside_down_share: how often it comes back upside down. home_m: where the
    board's centre is held to be shown. grip_m: from the centre to the hand, towards the board's lower edge.
    mirrored: the hand's screen shows picture and words as a mirror does.
    """

    speed_m_s: float = 0.32
    turn_rad_s: float = float(np.deg2rad(120.0))
    reaction_s: float = 0.25
    inertia_s: float = 0.1
    tremor_m: float = 0.0003
    tremor_rad: float = 0.0015
    tremor_memory_s: float = 0.12
    lapses_per_s: float = 0.01
    upside_down_share: float = 0.3
    home_m: tuple[float, float, float] = (0.0, 0.0, 0.5)
    grip_m: float = 0.05
    mirrored: bool = False


class Hand:
    """A hand that holds a board and does what it is told."""

    def __init__(self, target: Target, start: Pose | None = None, habits: Habits | None = None) -> None:
        """Take the board and the pose to begin with: upright before the camera unless another is given."""
        self._target = target
        self._habits = habits or Habits()
        self._home: Array = np.array(self._habits.home_m)
        self._pose = start or Pose(np.zeros(3), self._home - target.centre)
        self._grip = grip_of(self._pose, target, np.array([0.0, self._habits.grip_m, 0.0]))
        self._tremor = Tremor(self._habits.tremor_m, self._habits.tremor_rad, self._habits.tremor_memory_s)
        self._steering = Steering()
        self._now_s = 0.0
        self._read: deque[tuple[float, tuple[ShownHint, ...]]] = deque()
        self._obeyed: tuple[ShownHint, ...] = ()
        self._aim: Array = np.zeros(6)
        self._velocity: Array = np.zeros(6)
        self._busy_until_s = 0.0

    @property
    def pose(self) -> Pose:
        """Where the board is now, `T_cam_board`; it may be outside the picture or upside down."""
        return self._pose

    def step(self, hints: tuple[ShownHint, ...], dt_s: float, rng: np.random.Generator) -> Pose:
        """Move on by dt_s with these hints on the screen and return the new pose `T_cam_board`."""
        self._now_s += dt_s
        if self._now_s >= self._busy_until_s:
            self._read_hints(hints)
            self._aim = self._decide(dt_s, rng)
        kept = np.exp(-dt_s / self._habits.inertia_s)
        surplus = self._velocity - self._aim
        # Integrated over the step: the hand overshoots by the same way at every frame rate.
        way = self._aim * dt_s + surplus * self._habits.inertia_s * (1.0 - kept)
        self._grip, self._velocity = self._grip.moved(way), self._aim + surplus * kept
        self._pose = self._grip.moved(self._tremor.step(dt_s, rng)).pose(self._target)
        return self._pose

    def _read_hints(self, hints: tuple[ShownHint, ...]) -> None:
        """Let the hints of a reaction time ago reach the hand."""
        self._read.append((self._now_s + self._habits.reaction_s, hints))
        while self._read and self._read[0][0] <= self._now_s:
            arrived = self._read.popleft()[1]
            if _shows(arrived, Hint.SHOW_WHOLE_BOARD) and not _shows(self._obeyed, Hint.SHOW_WHOLE_BOARD):
                self._steering.startle()
            self._obeyed = arrived

    def _decide(self, dt_s: float, rng: np.random.Generator) -> Array:
        """Return the velocity (6,), m/s and rad/s, at which the hand now means to move."""
        if rng.random() < self._habits.lapses_per_s * dt_s:
            turn = np.pi / LAPSE_S if rng.random() < self._habits.upside_down_share else 0.0
            return self._busy(np.array([0.0, LOWERING_M_S, 0.0, 0.0, 0.0, turn]), LAPSE_S)
        if _shows(self._obeyed, Hint.TURN_UPSIDE_DOWN):
            angle = np.pi + rng.normal(0.0, FLIP_ERROR_RAD)
            return self._busy(np.array([0.0, 0.0, 0.0, 0.0, 0.0, angle / FLIP_S]), FLIP_S)
        if _shows(self._obeyed, Hint.SHOW_BOARD):
            return self._homewards(1.0)
        if _shows(self._obeyed, Hint.SHOW_WHOLE_BOARD):
            return np.asarray(self._homewards(CAREFUL) * SHIFTS_ONLY, dtype=np.float64)
        speeds = np.repeat([self._habits.speed_m_s, self._habits.turn_rad_s], 3)
        paces = self._steering.paces(self._obeyed, dt_s)
        # Before a mirror's screen the hand goes where the board in the mirror has to go.
        return np.asarray(paces * speeds * (MIRROR if self._habits.mirrored else 1.0), dtype=np.float64)

    def _busy(self, velocity: Array, for_s: float) -> Array:
        """Do one thing for a while, without a look at the screen; what it said before is forgotten."""
        self._busy_until_s = self._now_s + for_s
        self._obeyed = ()
        self._read.clear()
        return velocity

    def _homewards(self, share: float) -> Array:
        """Return the velocity (6,) that brings the board before the camera and turns its face there."""
        sight = self._grip.centre / np.linalg.norm(self._grip.centre)
        way = _limited((self._home - self._grip.centre) / HOMING_S, share * self._habits.speed_m_s)
        turn = np.cross(self._grip.rotation[:, 2], sight) / HOMING_S
        closer = -way[2] / sight[2]
        shift = way + closer * sight
        return np.concatenate([[shift[0], shift[1], closer], _limited(turn, share * self._habits.turn_rad_s)])


def _shows(hints: tuple[ShownHint, ...], code: Hint) -> bool:
    return any(hint.code == code for hint in hints)


def _limited(vector: Array, longest: float) -> Array:
    """Return a vector (3,), shortened to a length."""
    return np.asarray(
        vector * min(1.0, longest / max(float(np.linalg.norm(vector)), 1e-12)), dtype=np.float64
    )
