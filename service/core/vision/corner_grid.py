"""Corners to grids: who is whose neighbour, and a pair of integers for each.

Two corners are linked along an edge when each is the other's nearest in that direction and the colours beside
the edge agree. Numbering then walks the links and needs no geometry, so distortion does not matter.
Not here: missing corners (`grid_growth`) and which grid is the declared board (`board`).
"""

from collections import deque
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from service.core.vision.corner_candidates import Corners
from service.core.vision.transforms import Array

NEIGHBOURS = 24
SIDEWAYS = 0.36  # tangent of the largest angle between an edge's direction and the neighbour
ALIGNED = 0.88  # cosine of the largest angle between the two ends of an edge
LIKE_CONTRAST = 0.3  # least ratio of the contrasts of two neighbours
LIKE_LENGTH = 0.4  # least ratio of the two edges that meet head on in a corner
LEAST_CORNERS = 6


@dataclass(frozen=True)
class CornerGrid:
    """Corners by row and column: points (rows, columns, 2) px, NaN where there is none.

    Rows and columns run so that x × y points away from the camera (never mirrored). The cell whose corners
    are [row, column] to [row + 1, column + 1] is dark when (row + column + phase) is even.
    """

    points: Array
    phase: int

    @property
    def known(self) -> NDArray[np.bool_]:
        """Where there is a corner (rows, columns)."""
        return ~np.isnan(self.points[..., 0])


def link_corners(corners: Corners, evenness: float = 1.0) -> NDArray[np.int64]:
    """Return the neighbour (n, 4) of each corner in each slot's direction, -1 where there is none.

    Links are mutual: link[q].index(p) exists whenever link[p] holds q. evenness: the smallest step between
    neighbouring corners of the board over the largest.
    """
    n = len(corners)
    if n < 2:
        return np.full((n, 4), -1)
    nearest = cKDTree(corners.points).query(corners.points, k=min(NEIGHBOURS + 1, n))
    near = np.asarray(nearest[1], dtype=np.int64)[:, 1:]
    vector = corners.points[near] - corners.points[:, None]
    link, back = _nearest_along_slots(corners, near, vector)
    rows, slots = np.nonzero(link >= 0)
    ends = link[rows, slots]
    here, there = corners.contrast[rows], corners.contrast[ends]
    weak, strong = np.minimum(here, there), np.maximum(here, there)
    good = (link[ends, back[rows, slots]] == rows) & (weak > LIKE_CONTRAST * strong)
    link[rows[~good], slots[~good]] = -1
    return _without_bridges(_without_misfits(corners, link, back, LIKE_LENGTH * evenness), back)


def _without_misfits(
    corners: Corners, link: NDArray[np.int64], back: NDArray[np.int64], like_length: float
) -> NDArray[np.int64]:
    """Cut the longer of two edges that meet head on when they are too unlike to be sides of squares."""
    vector = np.where(link[..., None] >= 0, corners.points[link] - corners.points[:, None], np.nan)
    length = np.sqrt(np.sum(vector * vector, axis=-1))
    opposite = length[:, [2, 3, 0, 1]]
    rows, slots = np.nonzero(opposite < like_length * length)
    pruned = link.copy()
    pruned[link[rows, slots], back[rows, slots]] = -1
    pruned[rows, slots] = -1
    return pruned


def _without_bridges(link: NDArray[np.int64], back: NDArray[np.int64]) -> NDArray[np.int64]:
    """Cut the links that are a side of no square: where two boards meet, a chance one would make them one."""
    rows, slots = np.nonzero(link >= 0)
    ends, looking_back = link[rows, slots], back[rows, slots]
    side = np.zeros(len(rows), dtype=bool)
    for turn in (1, -1):
        beside, beyond = link[rows, (slots + turn) % 4], link[ends, (looking_back - turn) % 4]
        closed = np.any(link[beside] == beyond[:, None], axis=1)
        side |= (beside >= 0) & (beyond >= 0) & closed
    pruned = link.copy()
    pruned[rows[~side], slots[~side]] = -1
    return pruned


def _nearest_along_slots(
    corners: Corners, near: NDArray[np.int64], vector: Array
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the nearest corner (n, 4) along each slot, and the slot (n, 4) by which it looks back; -1: none.

    near: (n, k) corners nearby; vector: (n, k, 2) px to them.
    """
    link = np.full((len(near), 4), -1)
    back = np.full((len(near), 4), -1)
    x, y = np.cos(corners.slots[:, :2]), np.sin(corners.slots[:, :2])
    rows = np.arange(len(near))
    for line in (0, 1):
        own_x, own_y = x[:, line, None], y[:, line, None]
        ahead = vector[..., 0] * own_x + vector[..., 1] * own_y
        sideways = np.abs(vector[..., 0] * own_y - vector[..., 1] * own_x)
        # Across an edge the colours change places, so the neighbour looks back by a slot of the other line.
        likeness = x[near, 1 - line] * own_x + y[near, 1 - line] * own_y
        fits = (sideways < SIDEWAYS * np.abs(ahead)) & (np.abs(likeness) > ALIGNED)
        cost = np.where(fits, np.abs(ahead) + 2.0 * sideways, np.inf)
        for slot, sign in ((line, 1.0), (line + 2, -1.0)):
            choice = np.argmin(np.where(sign * ahead > 0, cost, np.inf), axis=1)
            found = np.isfinite(cost[rows, choice]) & (sign * ahead[rows, choice] > 0)
            turned = sign * likeness[rows, choice] > 0
            link[:, slot] = np.where(found, near[rows, choice], -1)
            back[:, slot] = np.where(found, np.where(turned, 3 - line, 1 - line), -1)
    return link, back


def number_corners(corners: Corners, link: NDArray[np.int64], enough: int | None = None) -> list[CornerGrid]:
    """Return the grids of linked corners, those with the most contrast in all first.

    Inside a board the middles of its squares can make a second, faint grid; counting corners would not tell.
    enough: corners beyond which more do not count, so that no perforated plate comes before a board.
    """
    neighbours: list[list[int]] = link.tolist()
    seen: set[int] = set()
    grids: list[tuple[float, CornerGrid]] = []
    for seed in range(len(corners)):
        if seed in seen or max(neighbours[seed]) < 0:
            continue
        places = _walk(neighbours, seed)
        seen.update(places)
        if len(places) >= LEAST_CORNERS:
            counted = len(places) if enough is None else min(len(places), enough)
            contrast = counted * float(corners.contrast[list(places)].mean())
            grids.append((contrast, _as_grid(corners, places)))
    return [grid for _, grid in sorted(grids, key=lambda pair: -pair[0])]


def _walk(neighbours: list[list[int]], seed: int) -> dict[int, tuple[int, int]]:
    """Number all corners that are linked to a seed: (column, row) by corner, breadth first."""
    turn = {seed: 0}
    places = {seed: (0, 0)}
    queue = deque([seed])
    while queue:
        corner = queue.popleft()
        column, row = places[corner]
        for way, (dx, dy) in enumerate(((1, 0), (0, 1), (-1, 0), (0, -1))):
            neighbour = neighbours[corner][(way + turn[corner]) % 4]
            if neighbour < 0 or neighbour in places:
                continue
            back = neighbours[neighbour].index(corner)
            turn[neighbour] = (back - way - 2) % 4
            places[neighbour] = (column + dx, row + dy)
            queue.append(neighbour)
    return places


def _as_grid(corners: Corners, places: dict[int, tuple[int, int]]) -> CornerGrid:
    """Lay numbered corners out as an array; the first to claim a place keeps it."""
    index = np.array(list(places))
    place = np.array(list(places.values()))
    low = place.min(axis=0)
    columns, rows = place.max(axis=0) - low + 1
    points = np.full((rows, columns, 2), np.nan)
    # Written backwards, so that the corner that was reached first is written last.
    points[place[::-1, 1] - low[1], place[::-1, 0] - low[0]] = corners.points[index[::-1]]
    return CornerGrid(points, int(low.sum()) % 2)


def keep_squares(grid: CornerGrid) -> CornerGrid:
    """Return the grid without the corners that belong to no square of four, and without its empty margins."""
    known = grid.known
    square = known[:-1, :-1] & known[1:, :-1] & known[:-1, 1:] & known[1:, 1:]
    kept = np.zeros_like(known)
    for row in (slice(None, -1), slice(1, None)):
        for column in (slice(None, -1), slice(1, None)):
            kept[row, column] |= square
    return trim(replace(grid, points=np.where(kept[..., None], grid.points, np.nan)))


def trim(grid: CornerGrid) -> CornerGrid:
    """Return the grid without empty rows and columns at its sides."""
    rows, columns = (np.flatnonzero(grid.known.any(axis=axis)) for axis in (1, 0))
    if not rows.size:
        return CornerGrid(np.zeros((0, 0, 2)), 0)
    return crop(grid, rows[0], columns[0], rows[-1] + 1, columns[-1] + 1)


def crop(grid: CornerGrid, top: int, left: int, bottom: int, right: int) -> CornerGrid:
    """Return rows top to bottom and columns left to right, the ends excluded."""
    return CornerGrid(grid.points[top:bottom, left:right], (grid.phase + int(top) + int(left)) % 2)
