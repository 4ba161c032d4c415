"""A grid of corners made complete: each place is predicted from its neighbours and proven in the full image.

What linking missed (a reflection, a weak corner) is found again here, and so is every further row or column,
which tells how large the board really is. What linking caught by chance is thrown out by the same proof.
Not here: whether the grid is the declared board (`board`).
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.vision.corner_candidates import inspect_rings
from service.core.vision.corner_grid import CornerGrid, keep_squares, trim
from service.core.vision.saddle import refine_saddles
from service.core.vision.sampling import FloatImage
from service.core.vision.transforms import Array

FARTHEST = 0.35  # of a square, from the predicted to the proven corner
REACH = 3  # corners, along a line, from which a next one is predicted
LARGEST_ANGLE_SINE = 0.5  # between an edge of the corner and the side of its square


Refiner = Callable[[FloatImage, Array, NDArray[np.int64]], tuple[Array, NDArray[np.bool_]]]


@dataclass(frozen=True)
class Steps:
    """The sides of the squares at each place (rows, columns, 2) px: to the next column, to the next row."""

    across: Array
    down: Array

    @property
    def square_px(self) -> Array:
        """The smaller height of the parallelogram at each place (rows, columns), px."""
        area = np.abs(self.across[..., 0] * self.down[..., 1] - self.across[..., 1] * self.down[..., 0])
        longer = np.maximum(_length(self.across), _length(self.down))
        height: Array = area / np.maximum(longer, 1e-9)
        return height


def refine_with_care(
    blurred: FloatImage, points: Array, radii: NDArray[np.int64]
) -> tuple[Array, NDArray[np.bool_]]:
    """Return saddle points (n, 2) near the given ones and which are proven, for a capture."""
    return refine_saddles(blurred, points, radii, tolerance_px=0.02)


def complete_grid(blurred: FloatImage, grid: CornerGrid, rounds: int) -> CornerGrid:
    """Return the grid with proven corners only, filled and grown by up to `rounds` lines on each side."""
    grid = keep_squares(grid)
    if not grid.points.size:
        return grid
    proven = keep_squares(_prove(blurred, grid, grid.points, refine_with_care))
    return keep_squares(grow_grid(blurred, proven, rounds))


def grow_grid(
    blurred: FloatImage, grid: CornerGrid, rounds: int, refine: Refiner = refine_with_care
) -> CornerGrid:
    """Return the grid with its gaps filled, and grown by up to `rounds` lines on each side."""
    for _ in range(rounds):
        if not grid.points.size:
            break
        padded = replace(grid, points=_with_margin(grid.points, 1))
        grown = _filled(blurred, padded, refine)
        if grown.known.sum() == grid.known.sum():
            break
        grid = trim(grown)
    return grid


def fill_grid(blurred: FloatImage, grid: CornerGrid, rounds: int, refine: Refiner) -> CornerGrid:
    """Return the grid with gaps in its rows and columns filled from their edges, `rounds` corners deep."""
    for _ in range(rounds):
        filled = _filled(blurred, grid, refine)
        if filled.known.sum() == grid.known.sum():
            break
        grid = filled
    return grid


def _filled(blurred: FloatImage, grid: CornerGrid, refine: Refiner) -> CornerGrid:
    """Return the grid with those unknown corners that their neighbours predict and the image confirms."""
    return _prove(blurred, grid, np.where(grid.known[..., None], np.nan, predict(grid.points)), refine)


def predict(points: Array) -> Array:
    """Return where corners (rows, columns, 2) px should be by their neighbours, NaN if unknown."""
    around = _with_margin(points, REACH)
    stack = np.empty((6, *points.shape))
    for along in (0, 1):
        before, after = _shifted(around, along, 1), _shifted(around, along, -1)
        np.multiply(before + after, 0.5, out=stack[3 * along])
        for place, sign in enumerate((1, -1), start=1):
            one, two, three = (_shifted(around, along, sign * k) for k in (1, 2, 3))
            bent = 3.0 * (one - two) + three
            stack[3 * along + place] = np.where(np.isnan(bent), 2.0 * one - two, bent)
    known = ~np.isnan(stack)
    count = known.sum(axis=0)
    return np.where(count > 0, np.where(known, stack, 0.0).sum(axis=0) / np.maximum(count, 1), np.nan)


def measure_steps(points: Array) -> Steps:
    """Return the sides of the squares near each place of (rows, columns, 2) px corners."""
    across, down = np.full(points.shape, np.nan), np.full(points.shape, np.nan)
    across[:, :-1] = points[:, 1:] - points[:, :-1]
    down[:-1] = points[1:] - points[:-1]
    return Steps(_local_mean(across, (3, 2), (1, 1)), _local_mean(down, (2, 3), (1, 1)))


def _local_mean(field: Array, first: tuple[int, int], anchor: tuple[int, int]) -> Array:
    """Mean of the known values around each place; wider and wider where there are none."""
    known = ~np.isnan(field[..., 0])
    filled = np.where(known[..., None], field, 0.0)
    weight = known.astype(np.float64)
    result = np.full(field.shape, np.nan)
    for kernel, at in ((first, anchor), ((5, 5), (2, 2)), ((9, 9), (4, 4))):
        size, spot = (kernel[1], kernel[0]), (at[1], at[0])
        sums = [_box_sum(plane, size, spot) for plane in (filled[..., 0], filled[..., 1], weight)]
        missing = np.isnan(result[..., 0]) & (sums[2] > 0.5)
        result[missing] = np.stack(sums[:2], axis=-1)[missing] / sums[2][missing][:, None]
        if not np.isnan(result).any():
            break
    return result


def _box_sum(plane: Array, size: tuple[int, int], anchor: tuple[int, int]) -> Array:
    plane = np.ascontiguousarray(plane)
    total = cv2.boxFilter(plane, -1, size, anchor=anchor, normalize=False, borderType=cv2.BORDER_CONSTANT)
    return np.asarray(total, dtype=np.float64)


def _with_margin(points: Array, margin: int) -> Array:
    """Return corners (rows, columns, 2) px with unknown ones, NaN, around them."""
    rows, columns = points.shape[:2]
    around = np.full((rows + 2 * margin, columns + 2 * margin, 2), np.nan)
    around[margin : margin + rows, margin : margin + columns] = points
    return around


def _shifted(around: Array, axis: int, places: int) -> Array:
    """Return corners whose value at i is that of i - places along an axis; around: with a margin."""
    down, right = (places, 0) if axis == 0 else (0, places)
    rows, columns = (size - 2 * REACH for size in around.shape[:2])
    return around[REACH - down : REACH - down + rows, REACH - right : REACH - right + columns]


def _prove(blurred: FloatImage, grid: CornerGrid, guesses: Array, refine: Refiner) -> CornerGrid:
    """Return the grid with the guessed corners that the image confirms; one that fails is unknown."""
    steps = measure_steps(grid.points)
    square_px = steps.square_px
    row, column = np.nonzero(~np.isnan(guesses[..., 0]) & ~np.isnan(square_px))
    points = np.where(np.isnan(guesses), grid.points, np.nan)
    square = square_px[row, column]
    # Near the border of the image less room is enough: the wanted board may well end there.
    room = room_px(blurred, guesses[row, column])
    widest = np.minimum(np.rint(0.3 * square), np.floor(room))
    radii = np.minimum(np.maximum(widest, 2), 7).astype(np.int64)
    near, proven = refine(blurred, guesses[row, column], radii)
    proven &= _length(near - guesses[row, column]) < FARTHEST * square
    rings = np.minimum(np.maximum(np.minimum(0.42 * square, room), 2.2), 10.0)
    passed, corners = inspect_rings(blurred, near, rings)
    dark = (row + column + grid.phase)[passed] % 2 == 0
    along = np.stack([corners.slots[:, 0], corners.slots[:, 1]], axis=-1)
    across_angle, down_angle = (
        np.where(dark, along[:, 0], along[:, 1]),
        np.where(dark, along[:, 1], along[:, 0]),
    )
    passed[passed] = (_sine(across_angle, steps.across[row, column][passed]) < LARGEST_ANGLE_SINE) & (
        _sine(down_angle, steps.down[row, column][passed]) < LARGEST_ANGLE_SINE
    )
    good = proven & passed
    points[row[good], column[good]] = near[good]
    return replace(grid, points=points)


def room_px(image: FloatImage, points: Array) -> Array:
    """Return how far (n,) px points (n, 2) are from the border of an image (h, w), less one pixel."""
    last = np.array(image.shape[::-1]) - 1.0
    room: Array = np.minimum(points, last - points).min(axis=1) - 1.0
    return room


def _sine(angle: Array, vector: Array) -> NDArray[np.float64]:
    """Return |sin| of the angles (n,) between lines and vectors (n, 2)."""
    cross = np.abs(np.cos(angle) * vector[:, 1] - np.sin(angle) * vector[:, 0])
    return np.asarray(cross / np.maximum(_length(vector), 1e-9))


def _length(vectors: Array) -> Array:
    """Return the lengths (...) of vectors (..., 2)."""
    return np.asarray(np.sqrt(np.sum(vectors * vectors, axis=-1)))
