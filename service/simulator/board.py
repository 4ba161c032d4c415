"""The share of every pixel that shows a plate and what is printed on it. Not here: what is behind it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.target import Target
from service.core.vision.transforms import Array
from service.simulator.coverage import Steps, box_steps, integrate_product
from service.simulator.pattern import Levels, Pattern, make_pattern
from service.simulator.soft_edges import footprint_of, soft_window

FINEST_SPLIT = 16


@dataclass(frozen=True)
class Plate:
    """A white plate by its outline as step functions of u and v, squares from feature 0, and its print."""

    outline: tuple[Steps, Steps]
    pattern: Pattern

    @property
    def reach(self) -> tuple[Array, Array]:
        """Where u and v lie on the plate or less than a square beside it: (low, high) of each."""
        beside = np.array([-1.0, 1.0])
        return self.outline[0].edges + beside, self.outline[1].edges + beside

    def sample(self, uv: Array) -> tuple[Array, Array]:
        """Return whether points (n, 2), squares, lie on the plate and in the print: 0 or 1 each (n,)."""
        plate = _within(self.outline, uv)
        return plate.astype(np.float64), self.pattern.sample(uv).astype(np.float64)

    def near_edge(self, uv: Array, half: Array) -> NDArray[np.bool_]:
        """Return whether an edge may lie within half (n, 2) of points (n, 2), squares."""
        near = self.pattern.near_edge(uv, half)
        for axis, steps in enumerate(self.outline):
            beside = np.abs(uv[:, axis] - steps.edges.mean()) - 0.5 * np.ptp(steps.edges)
            near |= np.abs(beside) < half[:, axis]
        return near

    def shares(self, uv: Array, jacobian: Array) -> tuple[Array, Array]:
        """Return the shares (n,) of pixels that show the plate, and its print.

        uv: (n, 2) squares at the pixel's centre; jacobian: (n, 2, 2) d(u, v)/d(pixel). Exact for a footprint
        smaller than the pattern's finest; larger ones are split into sub-pixels first, at most 16 by 16.
        """
        extent = np.abs(jacobian).sum(axis=2).max(axis=1)
        splits = np.clip(np.ceil(extent / self.pattern.finest), 1, FINEST_SPLIT).astype(int)
        plate, dark = np.empty(len(uv)), np.empty(len(uv))
        for split in np.unique(splits):
            at = splits == split
            plate[at], dark[at] = self._split_shares(uv[at], jacobian[at], int(split))
        return plate, dark

    def soft_shares(self, u: Levels, v: Levels) -> tuple[Levels, Levels]:
        """Return the shares (h, w) of pixels that show the plate, and its print, softly."""
        footprint = footprint_of(u), footprint_of(v)
        plate = np.ones_like(u)
        for x, width, steps in zip((u, v), footprint, self.outline, strict=True):
            plate *= soft_window(x, width, *steps.edges)
        return plate, self.pattern.soft_shares(u, v, footprint)

    def _split_shares(self, uv: Array, jacobian: Array, split: int) -> tuple[Array, Array]:
        ticks = (np.arange(split) + 0.5) / split - 0.5
        offsets = np.stack(np.meshgrid(ticks, ticks), axis=-1).reshape(-1, 2)
        parts = [self._affine_shares(uv + jacobian @ offset, jacobian / split) for offset in offsets]
        plate, dark = np.mean(parts, axis=0)
        return plate, dark

    def _affine_shares(self, uv: Array, jacobian: Array) -> tuple[Array, Array]:
        return integrate_product(*self.outline, uv, jacobian), self.pattern.shares(uv, jacobian)


def make_plate(target: Target, border_squares: float) -> Plate:
    """Return the plate of a target with a white border of so many squares around the print."""
    low, high = (target.outline[corner, :2] / target.square_m for corner in (0, 2))
    sides = (box_steps(low[axis] - border_squares, high[axis] + border_squares) for axis in range(2))
    u, v = sides
    return Plate((u, v), make_pattern(target))


def _within(box: tuple[Steps, Steps], uv: Array) -> NDArray[np.bool_]:
    (left, right), (top, bottom) = (steps.edges for steps in box)
    u, v = uv[:, 0], uv[:, 1]
    within: NDArray[np.bool_] = (u > left) & (u < right) & (v > top) & (v < bottom)
    return within
