"""The squares of a chessboard as products of step functions. Not here: the plate around them."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Array
from service.simulator.coverage import Steps, box_steps, integrate_product
from service.simulator.soft_edges import Levels, soft_window


@dataclass(frozen=True)
class Checks:
    """A chessboard's pattern in squares from corner 0: from -1 to columns (u) and rows (v), the first dark.

    With a window w (1 on the squares) and a wave s (±1 on them) the dark share is ½ (w(u) w(v) + s(u) s(v)).
    """

    sizes: tuple[int, int]
    window: tuple[Steps, Steps]
    wave: tuple[Steps, Steps]

    @property
    def finest(self) -> float:
        """A square."""
        return 1.0

    def sample(self, uv: Array) -> NDArray[np.bool_]:
        """Return whether points (n, 2) lie in a dark square."""
        column, row = (np.floor(uv[:, axis]).astype(np.int32) for axis in range(2))
        (left, right), (top, bottom) = (steps.edges for steps in self.window)
        u, v = uv[:, 0], uv[:, 1]
        dark: NDArray[np.bool_] = (u > left) & (u < right) & (v > top) & (v < bottom)
        dark &= (column ^ row) & 1 == 0
        return dark

    def shares(self, uv: Array, jacobian: Array) -> Array:
        """Return the dark shares (n,) of pixels; exact for a footprint smaller than a square."""
        window = integrate_product(*self.window, uv, jacobian)
        wave = integrate_product(*self.wave, uv, jacobian)
        return 0.5 * (window + wave)

    def near_edge(self, uv: Array, half: Array) -> NDArray[np.bool_]:
        """Return whether a line between squares lies within half (n, 2) of points (n, 2)."""
        near: NDArray[np.bool_] = np.any(np.abs(uv - np.rint(uv)) < half, axis=1)
        return near

    def soft_shares(self, u: Levels, v: Levels, footprint: tuple[Levels, Levels]) -> Levels:
        """Return the dark shares (h, w) of pixels, softly."""
        (columns, rows), (across, down) = self.sizes, footprint
        dark = 1.0 + _soft_wave(u, across, columns) * _soft_wave(v, down, rows)
        dark *= 0.5 * soft_window(u, across, -1.0, columns) * soft_window(v, down, -1.0, rows)
        return np.asarray(dark, dtype=np.float32)


def make_checks(target: Chessboard) -> Checks:
    """Return the pattern of a chessboard."""
    sizes = (target.columns, target.rows)
    window = (box_steps(-1.0, sizes[0]), box_steps(-1.0, sizes[1]))
    return Checks(sizes, window, (_wave(sizes[0]), _wave(sizes[1])))


def _wave(corners: int) -> Steps:
    """Return the wave: an edge at every corner and at both ends, the first square (from -1 to 0) positive."""
    signs = np.where(np.arange(corners + 1) % 2 == 0, 1.0, -1.0)
    return Steps(np.arange(-1.0, corners + 1.0), np.concatenate([[0.0], signs, [0.0]]))


def _soft_wave(u: Levels, footprint: Levels, corners: int) -> Levels:
    """Return the mean (h, w) over each pixel of the wave that is +1 from -1 to 0 and turns at each corner."""
    phase = np.clip(u, np.float32(-0.5), np.float32(corners - 0.5))
    phase += np.float32(0.5)
    phase -= np.float32(2.0) * np.rint(np.float32(0.5) * phase)
    wave: Levels = (np.float32(0.5) - np.abs(phase)) / (np.float32(0.5) * footprint)
    np.clip(wave, -1.0, 1.0, out=wave)
    return wave
