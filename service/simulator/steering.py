"""How a hand turns movement hints into a pace on each of its six axes. Not here: reaction and inertia."""

from typing import Final

import numpy as np

from service.core.guidance.hints import DIRECTIONS, ShownHint
from service.core.vision.transforms import Array

MOVES: Final = {pair[i]: (axis, (1.0, -1.0)[i]) for axis, pair in enumerate(DIRECTIONS) for i in range(2)}
SLOWEST: Final = 0.2
SLOWER: Final = 0.6
FAR: Final = 1.0  # an amount at which care is not needed yet
FAR_PACE: Final = 0.5
DOUBLED_WITHIN_S: Final = 2.5
SOON_S: Final = 1.0
GOES_ON_S: Final = 0.6  # so long after a hint has ended a hand may still be on its way


class Steering:
    """A hand's care on each axis: a hint that soon turns round means too far, so the next approach is slower.

    A hint that stays the same for a while means that the care was too much. One that turns round long after
    it was obeyed says nothing: another movement, or another pose, asks for it.
    """

    def __init__(self) -> None:
        self._pace: Array = np.ones(6)
        self._sense: Array = np.zeros(6)
        self._obeyed_s: Array = np.full(6, -np.inf)
        self._now_s = 0.0

    def paces(self, hints: tuple[ShownHint, ...], dt_s: float) -> Array:
        """Return the paces (6,), −1…1: right, down, closer, tilt, turn, roll as in PoseDifference."""
        self._now_s += dt_s
        wanted = np.zeros(6)
        for hint in hints:
            if hint.code in MOVES:
                axis, sense = MOVES[hint.code]
                self._heed(axis, sense, hint.amount, dt_s)
                wanted[axis] = sense * hint.amount * self._pace[axis]
        return wanted

    def startle(self) -> None:
        """Slow down what was moved last, if that was just now: it led out of the picture."""
        latest = max(float(self._obeyed_s.max()), self._now_s - GOES_ON_S)
        for axis in np.flatnonzero(self._obeyed_s >= latest):
            self._slow_down(int(axis))

    def _heed(self, axis: int, sense: float, amount: float, dt_s: float) -> None:
        if sense == -self._sense[axis] and self._now_s - self._obeyed_s[axis] <= SOON_S:
            self._slow_down(axis)
        self._pace[axis] = min(1.0, self._pace[axis] * 2.0 ** (dt_s / DOUBLED_WITHIN_S))
        if amount >= FAR:
            self._pace[axis] = max(FAR_PACE, self._pace[axis])
        self._sense[axis] = sense
        self._obeyed_s[axis] = self._now_s

    def _slow_down(self, axis: int) -> None:
        self._pace[axis] = max(SLOWEST, SLOWER * self._pace[axis])
