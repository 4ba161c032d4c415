"""Which corner of a coded board each corner of a grid is, as the markers in its cells tell.

A grid comes without a beginning and in one of four turns. Each marker that is read votes for a turn and an
offset; two that agree, and no majority against them, decide. One marker read wrongly decides nothing.
Not here: how grids are found (`corner_grid`), and markers without a grid around them (`marker_detection`).
"""

from collections import Counter
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from service.core.vision.coded import CodedTarget
from service.core.vision.corner_grid import CornerGrid
from service.core.vision.marker_detection import board_to_image, map_points
from service.core.vision.markers import dark_cells
from service.core.vision.sampling import sample_bilinear
from service.core.vision.transforms import Array

CELLS = 200  # that are read of a grid at most
LEAST_AREA_PX = 16.0  # of a cell, in square pixels
LEAST_CONTRAST = 12.0  # grey levels between dark and bright in a cell
WRONG_SHARE = 0.06  # of a marker's modules that may be read wrongly
LEAST_VOTES = 2
FRAME_SHARE = 0.9  # of a marker's outermost modules that are dark, whatever its dictionary
READABLE_PX = 2.0  # of a module, from which on a marker that is there is read

UNIT = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
Place = tuple[int, int, int]


@dataclass(frozen=True)
class NamedCorners:
    """Corners of a board: ids (n,), ascending, and points (n, 2) px."""

    ids: NDArray[np.int64]
    points: Array


@dataclass(frozen=True)
class CodeBook:
    """A board's markers as a grid shows them, and what else of it every frame needs.

    patterns (4 m, b): the dark modules, eight to a byte, in a grid that 0 to 3 quarter turns make upright,
    all markers for each turn; cells (m, 2): row and column of the cell that holds the marker; spots (k, 2):
    modules in a unit cell. points (n, 2), m: the corners; edges (e, 2): see `CodedTarget`. evenness: the
    smallest step between neighbouring corners over the largest.
    """

    patterns: NDArray[np.uint8]
    cells: NDArray[np.int64]
    spots: Array
    points: Array
    edges: NDArray[np.int64]
    evenness: float

    @property
    def are_in_dark_cells(self) -> bool:
        """Whether markers are in cells that are dark, as tags are, or in bright ones."""
        return bool(self.cells[0].sum() % 2 == 0)


@dataclass(frozen=True)
class Reading:
    """A grid that was read. corners: None where its markers do not decide; module_px: size of a module.

    framed: cells with something bright in a dark frame, which a marker of any dictionary is.
    """

    corners: NamedCorners | None
    module_px: float
    framed: int


def read_grid(image: NDArray[np.uint8], grid: CornerGrid, target: CodedTarget) -> Reading:
    """Return which corners of a board those of a grid in an image (h, w) are."""
    book = code_book(target)
    cells, quads = _cells_of(grid, book)
    if not len(cells):
        return Reading(None, 0.0, 0)
    modules = np.sqrt(len(book.spots))
    share = float(np.ptp(book.spots[:, 0])) * modules / (modules - 1.0)
    module_px = float(np.sqrt(np.median(_areas(quads)))) * share / float(modules)
    dark, is_clear = _modules(image, quads, book)
    read = _match(cells[is_clear], dark[is_clear], book)
    place = _elect(read, grid.points.shape[:2], book)
    corners = None if place is None else _name(grid.points, place, target)
    return Reading(corners, module_px, int(np.count_nonzero(_is_framed(dark) & is_clear)))


@lru_cache(maxsize=8)
def code_book(target: CodedTarget) -> CodeBook:
    """Return the code book of a board."""
    corners, points = target.marker_corners, target.object_points[:, :2]
    x, y = np.unique(points[:, 0]), np.unique(points[:, 1])
    steps = np.concatenate([np.diff(x), np.diff(y)])
    middle = corners.mean(axis=1)
    row, column = np.searchsorted(y, middle[:, 1]) - 1, np.searchsorted(x, middle[:, 0]) - 1
    inside = (row >= 0) & (row < len(y) - 1) & (column >= 0) & (column < len(x) - 1)
    upright = [_as_printed(target, int(marker)) for marker in np.flatnonzero(inside)]
    patterns = np.array([np.rot90(dark, -turn).ravel() for turn in range(4) for dark in upright])
    return CodeBook(
        patterns=np.packbits(patterns, axis=1),
        cells=np.stack([row, column], axis=-1)[inside].astype(np.int64),
        spots=_spots(target, len(upright[0]), float(x[1] - x[0])),
        points=points,
        edges=target.edges,
        evenness=float(steps.min() / steps.max()),
    )


def _as_printed(target: CodedTarget, marker: int) -> NDArray[np.bool_]:
    """Return the dark modules (n, n) of a marker as the upright board shows them."""
    corners = target.marker_corners[marker]
    first = np.linalg.norm(UNIT - (corners[0] - corners.min(axis=0)) / np.ptp(corners, axis=0), axis=1)
    return np.rot90(dark_cells(target.dictionary, marker, target.marker_border), -int(np.argmin(first)))


def _spots(target: CodedTarget, modules: int, cell_m: float) -> Array:
    """Return the middles (k, 2) of a marker's modules in a cell of side 1, row by row."""
    side = float(np.ptp(target.marker_corners[0, :, 0])) / cell_m
    along = 0.5 + side * ((np.arange(modules) + 0.5) / modules - 0.5)
    return np.stack([np.tile(along, modules), np.repeat(along, modules)], axis=-1)


def _cells_of(grid: CornerGrid, book: CodeBook) -> tuple[NDArray[np.int64], Array]:
    """Return row and column (c, 2) of cells that may hold a marker, and their corners (c, 4, 2)."""
    points = grid.points
    quads = np.stack([points[:-1, :-1], points[:-1, 1:], points[1:, 1:], points[1:, :-1]], axis=2)
    row, column = np.indices(quads.shape[:2])
    is_dark = (row + column + grid.phase) % 2 == 0
    whole = ~np.isnan(quads).any(axis=(2, 3)) & (is_dark == book.are_in_dark_cells)
    cells = np.argwhere(whole)
    found = quads[whole]
    large = _areas(found) > LEAST_AREA_PX
    cells, found = cells[large], found[large]
    if len(cells) > CELLS:
        some = np.linspace(0, len(cells) - 1, CELLS).astype(np.int64)
        cells, found = cells[some], found[some]
    return cells, found


def _areas(quads: Array) -> Array:
    """Return the areas (c,) of quadrilaterals (c, 4, 2)."""
    one, other = quads[:, 2] - quads[:, 0], quads[:, 3] - quads[:, 1]
    return np.asarray(0.5 * np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]))


def _modules(
    image: NDArray[np.uint8], quads: Array, book: CodeBook
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Return which modules (c, k) of cells are dark, and which cells (c,) tell dark from bright."""
    H = board_to_image(np.broadcast_to(UNIT, quads.shape), quads)
    at = map_points(H, np.broadcast_to(book.spots, (len(quads), *book.spots.shape)))
    level = sample_bilinear(image, at[..., 0], at[..., 1])
    low, high = level.min(axis=1), level.max(axis=1)
    return level < 0.5 * (low + high)[:, None], high - low > LEAST_CONTRAST


def _match(cells: NDArray[np.int64], dark: NDArray[np.bool_], book: CodeBook) -> NDArray[np.int64]:
    """Return what cells with dark modules (c, k) say: row, column, turn and index in the book (r, 4)."""
    packed = np.packbits(dark, axis=1)
    wrong = np.bitwise_count(packed[:, None] ^ book.patterns).sum(axis=2, dtype=np.int64)
    sure = wrong.min(axis=1) <= WRONG_SHARE * dark.shape[1]
    turn, marker = np.divmod(wrong.argmin(axis=1), len(book.cells))
    return np.asarray(np.column_stack([cells, turn, marker])[sure], dtype=np.int64)


def _is_framed(dark: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return which cells with dark modules (c, k) have a dark frame, and bright modules within."""
    side = round(dark.shape[1] ** 0.5)
    square = dark.reshape(-1, side, side)
    inner = square[:, 1:-1, 1:-1].sum(axis=(1, 2))
    frame = square.sum(axis=(1, 2)) - inner
    return np.asarray((frame >= FRAME_SHARE * 4 * (side - 1)) & (inner < (side - 2) ** 2))


def _elect(read: NDArray[np.int64], shape: tuple[int, ...], book: CodeBook) -> Place | None:
    """Return the turn and the offset, in rows and columns, for which most markers vote, if they decide."""
    votes: Counter[Place] = Counter()
    for row, column, turn, marker in read.tolist():
        turned = _turned((row, column), (shape[0] - 1, shape[1] - 1), turn)
        own_row, own_column = book.cells[marker].tolist()
        votes[turn, own_row - turned[0], own_column - turned[1]] += 1
    if not votes:
        return None
    ((place, count),) = votes.most_common(1)
    return place if count >= LEAST_VOTES and 2 * count > len(read) else None


def _turned(at: tuple[int, int], size: tuple[int, int], turn: int) -> tuple[int, int]:
    """Return where a place of an array (rows, columns) is after quarter turns as of `numpy.rot90`."""
    (row, column), (rows, columns) = at, size
    for _ in range(turn):
        row, column, rows, columns = columns - 1 - column, row, columns, rows
    return row, column


def _name(points: Array, place: Place, target: CodedTarget) -> NamedCorners:
    """Return the corners of a grid (rows, columns, 2) that the board has, by its ids."""
    turn, down, right = place
    upright = np.rot90(points, turn)
    row, column = np.nonzero(~np.isnan(upright[..., 0]))
    own_row, own_column = row + down, column + right
    inside = (own_row >= 0) & (own_row < target.rows) & (own_column >= 0) & (own_column < target.columns)
    ids = (own_row * target.columns + own_column)[inside]
    order = np.argsort(ids)
    return NamedCorners(ids[order].astype(np.int64), upright[row, column][inside][order])
