"""The share of every pixel that shows a plate and its dark squares. Not here: what is behind it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.target import Target
from service.core.vision.transforms import Array
from service.simulator.coverage import Steps, integrate_product

FINEST_SPLIT = 16


@dataclass(frozen=True)
class Plate:
    """A target's pattern as step functions of u and v, in squares from corner 0.

    The squares reach from -1 to columns (u) and rows (v), the plate border_squares farther; the square
    between (-1, -1) and (0, 0) is dark. With a window w (1 on the squares) and a wave s (±1 on them) the dark
    share is ½ (w(u) w(v) + s(u) s(v)).
    """

    outline: tuple[Steps, Steps]
    window: tuple[Steps, Steps]
    wave: tuple[Steps, Steps]

    @property
    def reach(self) -> tuple[Array, Array]:
        """Where u and v lie on the plate or less than a square beside it: (low, high) of each."""
        beside = np.array([-1.0, 1.0])
        return self.outline[0].edges + beside, self.outline[1].edges + beside

    def sample(self, uv: Array) -> tuple[Array, Array]:
        """Return whether points (n, 2), squares, lie on the plate and in a dark square: 0 or 1 each (n,)."""
        plate, window = (_within(steps, uv) for steps in (self.outline, self.window))
        column, row = (np.floor(uv[:, axis]).astype(np.int32) for axis in range(2))
        dark = window & ((column ^ row) & 1 == 0)
        return plate.astype(np.float64), dark.astype(np.float64)

    def shares(self, uv: Array, jacobian: Array) -> tuple[Array, Array]:
        """Return the shares (n,) of pixels that show the plate, and its dark squares.

        uv: (n, 2) squares at the pixel's centre; jacobian: (n, 2, 2) d(u, v)/d(pixel). Exact for a footprint
        smaller than a square; larger ones are split into sub-pixels first, at most 16 by 16.
        """
        extent = np.abs(jacobian).sum(axis=2).max(axis=1)
        splits = np.clip(np.ceil(extent), 1, FINEST_SPLIT).astype(int)
        plate, dark = np.empty(len(uv)), np.empty(len(uv))
        for split in np.unique(splits):
            at = splits == split
            plate[at], dark[at] = self._split_shares(uv[at], jacobian[at], int(split))
        return plate, dark

    def _split_shares(self, uv: Array, jacobian: Array, split: int) -> tuple[Array, Array]:
        ticks = (np.arange(split) + 0.5) / split - 0.5
        offsets = np.stack(np.meshgrid(ticks, ticks), axis=-1).reshape(-1, 2)
        parts = [self._affine_shares(uv + jacobian @ offset, jacobian / split) for offset in offsets]
        plate, dark = np.mean(parts, axis=0)
        return plate, dark

    def _affine_shares(self, uv: Array, jacobian: Array) -> tuple[Array, Array]:
        plate = integrate_product(*self.outline, uv, jacobian)
        window = integrate_product(*self.window, uv, jacobian)
        wave = integrate_product(*self.wave, uv, jacobian)
        return plate, 0.5 * (window + wave)


def make_plate(target: Target, border_squares: float) -> Plate:
    """Return the plate of a target with a white border of so many squares."""
    sizes = (target.columns, target.rows)
    outline, window, wave = (
        (steps(sizes[0]), steps(sizes[1]))
        for steps in (
            lambda n: _box(-1.0 - border_squares, n + border_squares),
            lambda n: _box(-1.0, n),
            _wave,
        )
    )
    return Plate(outline, window, wave)


def _within(box: tuple[Steps, Steps], uv: Array) -> NDArray[np.bool_]:
    (left, right), (top, bottom) = (steps.edges for steps in box)
    u, v = uv[:, 0], uv[:, 1]
    within: NDArray[np.bool_] = (u > left) & (u < right) & (v > top) & (v < bottom)
    return within


def _box(low: float, high: float) -> Steps:
    return Steps(np.array([low, high]), np.array([0.0, 1.0, 0.0]))


def _wave(corners: int) -> Steps:
    """Return the wave: an edge at every corner and at both ends, the first square (from -1 to 0) positive."""
    signs = np.where(np.arange(corners + 1) % 2 == 0, 1.0, -1.0)
    return Steps(np.arange(-1.0, corners + 1.0), np.concatenate([[0.0], signs, [0.0]]))
