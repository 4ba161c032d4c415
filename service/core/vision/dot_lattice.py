"""The lattice that a grid's dots lie on, grown from one dot to the next, and the target's order in it.

Dots lie on a lattice whatever the perspective, so that a step from one to the next says where the one after
it is to be looked for. The order is never mirrored, and where a symmetric grid leaves a choice, x points as
far to the right in the image as it can.
Not here: what is a dot in an image (`circle_grid`, `live_dots`).
"""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from service.core.vision.target_circles import Circles
from service.core.vision.transforms import Array

NEAREST: Final = 12  # dots around one that may be its neighbours: enough to 70 degrees of tilt
LEAST_SINE: Final = 0.4  # of the angle between the two ways from a dot to the next
OFF_SHARE: Final = 0.3  # of a way: how far the next dot may be from where it is looked for
MOST_UNLIKE: Final = 3.5  # times the area of the dot beside it: specks at a plate's edge are smaller
# Ways between neighbouring dots, in steps; two of them that span an area of two make the lattice.
WAYS: Final = ((1, 1), (1, -1), (-1, 1), (-1, -1), (2, 0), (-2, 0), (0, 2), (0, -2))
AREA: Final = 2
CLOCKWISE: Final = np.array([(a, b) for a, b in product(WAYS, WAYS) if a[0] * b[1] - a[1] * b[0] == AREA])
# What is found turns as the ways do, so that a lattice grown the other way round swaps them.
OTHER_WAY: Final = CLOCKWISE[:, ::-1]

Places = NDArray[np.int64]
Place = tuple[int, int]
Way = tuple[float, float]


@dataclass(frozen=True)
class Dots:
    """Dots of an image (n, 2) px with their areas (n,), px².

    nearest, to: (n, k) the others around each, and the way (n, k, 2) there. ways: (n, 2, 2) px, to the
    nearest, and to the nearest in another direction; NaN where there is none.
    """

    points: Array
    areas: Array
    nearest: NDArray[np.int64]
    to: Array
    ways: Array


@dataclass(frozen=True)
class Lattice:
    """Dots (m,) by index, their places (m, 2): how often each of two ways leads there; how these turn."""

    dots: NDArray[np.int64]
    places: Places
    clockwise: bool

    def __len__(self) -> int:
        return len(self.dots)

    @property
    def steps(self) -> Places:
        """Places (b, m, 2) in steps of the target's axes, by each of b readings of the two ways."""
        ways = CLOCKWISE if self.clockwise else OTHER_WAY
        return np.asarray(np.einsum("ma,bac->bmc", self.places, ways))


def gather_dots(points: Array, areas: Array) -> Dots:
    """Return the dots at points (n, 2), px, with areas (n,), and what is around each."""
    count = min(NEAREST + 1, len(points))
    if count < 3:
        none = np.zeros((len(points), 0, 2))
        return Dots(points, areas, none[..., 0].astype(np.int64), none, np.full((len(points), 2, 2), np.nan))
    nearest = np.asarray(cKDTree(points).query(points, k=count)[1])[:, 1:]
    to = points[nearest] - points[:, None]
    length = np.linalg.norm(to, axis=-1)
    cross = np.abs(to[..., 0] * to[:, :1, 1] - to[..., 1] * to[:, :1, 0])
    aside = cross > LEAST_SINE * length * length[:, :1]
    second = to[np.arange(len(to)), aside.argmax(axis=1)]
    ways = np.stack([to[:, 0], np.where(aside.any(axis=1)[:, None], second, np.nan)], axis=1)
    return Dots(points, areas, nearest, to, ways)


def grow_lattice(dots: Dots, seed: int, most: int) -> Lattice:
    """Return the lattice around a dot; most: so many dots are enough."""
    first = dots.ways[seed]
    growth = _Growth(dots, seed)
    waiting = deque([((0, 0), first.tolist())] if not np.isnan(first).any() else [])
    while waiting and len(growth.places) < most:
        place, ways = waiting.popleft()
        ways = [growth.way_at(place, axis, ways[axis]) for axis in (0, 1)]
        waiting.extend((there, ways) for there in growth.spread(place, ways))
    clockwise = bool(first[0, 0] * first[1, 1] - first[0, 1] * first[1, 0] > 0)
    places = growth.places
    return Lattice(np.array(list(places.values())), np.array(list(places)), clockwise)


class _Growth:
    """Dots by their place, in plain numbers: they are few at a time, and arrays would take longer."""

    def __init__(self, dots: Dots, seed: int) -> None:
        self.places: dict[Place, int] = {(0, 0): seed}
        self._dots, self._points = dots, dots.points.tolist()
        self._used = {seed}

    def way_at(self, place: Place, axis: int, inherited: Way) -> Way:
        """Return the way along an axis at a place: between dots there, else beside it, else as inherited."""
        a, b = place
        for x, y in ((a, b), (a, b - 1), (a, b + 1)) if axis == 0 else ((a, b), (a - 1, b), (a + 1, b)):
            before, after = ((x - 1, y), (x + 1, y)) if axis == 0 else ((x, y - 1), (x, y + 1))
            ends = [end for end in (before, (x, y), after) if end in self.places]
            if len(ends) > 1 and (x, y) in self.places:
                (u, v), (p, q) = self._points[self.places[ends[0]]], self._points[self.places[ends[-1]]]
                return (p - u) / (len(ends) - 1), (q - v) / (len(ends) - 1)
        return inherited

    def spread(self, place: Place, ways: Sequence[Way]) -> list[Place]:
        """Put the next dots of a place into theirs, and return these."""
        (a, b), here, found = place, self.places[place], []
        dots = self._dots
        share = dots.areas[dots.nearest[here]] / dots.areas[here]
        alike = (share < MOST_UNLIKE) & (share > 1.0 / MOST_UNLIKE)
        around = list(zip(dots.nearest[here][alike].tolist(), dots.to[here][alike].tolist(), strict=True))
        for axis, sign in ((0, 1), (0, -1), (1, 1), (1, -1)):
            there = (a + sign, b) if axis == 0 else (a, b + sign)
            if there in self.places:
                continue
            x, y = sign * ways[axis][0], sign * ways[axis][1]
            near = [((u - x) ** 2 + (v - y) ** 2, dot) for dot, (u, v) in around if dot not in self._used]
            away_sq, dot = min(near, default=(np.inf, -1))
            if away_sq <= OFF_SHARE**2 * (x * x + y * y):
                self.places[there] = dot
                self._used.add(dot)
                found.append(there)
        return found


def order_dots(lattice: Lattice, points: Array, target: Circles) -> Array | None:
    """Return the dots (n, 2) px in the target's order; None where the lattice does not hold its shape."""
    wanted = np.rint(target.object_points[:, :2] / target.step_m).astype(np.int64)
    fitting: list[tuple[float, Array]] = []
    steps = lattice.steps
    steps = steps - steps.min(axis=1, keepdims=True)
    roomy = (steps.max(axis=1) >= wanted.max(axis=0)).all(axis=1)
    for reading in steps[roomy]:
        found = _placed(reading, wanted)
        if found is not None:
            ordered = points[lattice.dots[found]]
            ahead = ordered[target.columns - 1] - ordered[0]
            fitting.append((float(ahead[0] / np.linalg.norm(ahead)), ordered))
    return max(fitting, key=lambda fit: fit[0])[1] if fitting else None


def _placed(steps: Places, wanted: Places) -> NDArray[np.int64] | None:
    """Return which places (m, 2), from 0 on, are those wanted (n, 2), wherever these begin; else None."""
    size = steps.max(axis=0) + 1
    there = np.full(size, -1)
    there[steps[:, 0], steps[:, 1]] = np.arange(len(steps))
    starts = steps[(steps < size - wanted.max(axis=0)).all(axis=1)]
    x, y = (starts[:, None] + wanted).transpose(2, 0, 1)
    found = there[x, y]
    whole = np.flatnonzero((found >= 0).all(axis=1))
    return np.asarray(found[whole[0]]) if whole.size else None
