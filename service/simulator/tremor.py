"""The tremor of a hand: a smooth random motion around where the hand means to be. Not here: where that is."""

from typing import Final

import numpy as np

from service.core.vision.transforms import Array

SMOOTHING_LOSS: Final = 2.0  # smoothing noise by its own memory halves its variance


class Tremor:
    """Six smooth random offsets: three shifts (m) and three turns (rad)."""

    def __init__(self, shift_m: float, turn_rad: float, memory_s: float) -> None:
        """Take the standard deviations per axis, and after how long the tremor forgets where it was."""
        self._amplitude: Array = np.sqrt(SMOOTHING_LOSS) * np.repeat([shift_m, turn_rad], 3)
        self._memory_s = memory_s
        self._rough: Array = np.zeros(6)
        self._smooth: Array = np.zeros(6)

    def step(self, dt_s: float, rng: np.random.Generator) -> Array:
        """Return the offsets (6,) after dt_s: noise with a memory, smoothed so that it does not jump."""
        kept = np.exp(-dt_s / self._memory_s)
        self._rough = kept * self._rough + np.sqrt(1.0 - kept**2) * rng.standard_normal(6)
        self._smooth = kept * self._smooth + (1.0 - kept) * self._rough
        return np.asarray(self._amplitude * self._smooth, dtype=np.float64)
