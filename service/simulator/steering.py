"""How a hand turns movement hints into a pace on each of its six axes. Not here: reaction, inertia, tremor."""

from typing import Final

import numpy as np

from service.core.guidance.hints import DIRECTIONS, ShownHint
from service.core.vision.transforms import Array

MOVES: Final = {pair[i]: (axis, (1.0, -1.0)[i]) for axis, pair in enumerate(DIRECTIONS) for i in range(2)}
SLOWEST: Final = 0.2
CONFIDENT_AFTER_S: Final = 0.6
DOUBLED_WITHIN_S: Final = 0.6


class Steering:
    """A hand's care on each axis: a hint that turns round means too far, so the next approach is slower.

    A hint that stays the same for a while means that the care was too much.
    """

    def __init__(self) -> None:
        self._pace: Array = np.ones(6)
        self._sense: Array = np.zeros(6)
        self._turned_s: Array = np.full(6, -np.inf)

    def paces(self, hints: tuple[ShownHint, ...], now_s: float, dt_s: float) -> Array:
        """Return the paces (6,), −1…1: right, down, closer, tilt, turn, roll as in PoseDifference."""
        wanted = np.zeros(6)
        for hint in hints:
            if hint.code in MOVES:
                axis, sense = MOVES[hint.code]
                self._heed(axis, sense, now_s, dt_s)
                wanted[axis] = sense * hint.amount * self._pace[axis]
        return wanted

    def startle(self) -> None:
        """Halve the pace on every axis: the board went out of the picture."""
        self._pace = np.maximum(SLOWEST, 0.5 * self._pace)

    def _heed(self, axis: int, sense: float, now_s: float, dt_s: float) -> None:
        if sense == -self._sense[axis]:
            self._pace[axis] = max(SLOWEST, 0.5 * self._pace[axis])
            self._turned_s[axis] = now_s
        elif now_s - self._turned_s[axis] > CONFIDENT_AFTER_S:
            self._pace[axis] = min(1.0, self._pace[axis] * 2.0 ** (dt_s / DOUBLED_WITHIN_S))
        self._sense[axis] = sense
