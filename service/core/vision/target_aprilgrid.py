"""The AprilGrid of Kalibr: `aprilgrid:COLUMNSxROWS:TAGmm:SPACING`, tags of tag36h11 with dark corner squares.

COLUMNSxROWS are tags, TAG is the side of a tag, SPACING the gap between tags as a share of it. As Kalibr
prints it: tag 0 is at the bottom left, ids run to the right and then upwards, a tag has a dark border of two
cells, and a dark square fills each crossing of the gaps, so that every corner of a tag is a saddle point.
Features run row by row from the top left, not from the bottom left as in Kalibr's files.
Source: kalibr_create_target_pdf (Schneider, 2013).
"""

import re
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np
from numpy.typing import NDArray

from service.core.errors import TargetSpecInvalid
from service.core.vision.feature_grid import grid_outer, rectangle
from service.core.vision.markers import dark_cells, marker_dictionary
from service.core.vision.printed import Area, cells_area, square_area
from service.core.vision.transforms import Array

KIND: Final = "aprilgrid"
DICTIONARY: Final = "tag36h11"
BORDER_CELLS: Final = 2
CELLS: Final = 10  # of a tag, with its border
PATTERN = re.compile(r"aprilgrid:(\d{1,2})x(\d{1,2}):(\d+(?:\.\d+)?)mm:(\d+(?:\.\d+)?)")
SPACINGS: Final = (0.1, 1.0)


@dataclass(frozen=True)
class AprilGrid:
    """A grid of tags (tag_columns x tag_rows) by a tag's side, m, and the gap as a share of it."""

    kind: ClassVar[str] = KIND

    tag_columns: int
    tag_rows: int
    tag_m: float
    spacing: float

    @property
    def spec(self) -> str:
        """The words that `parse_target` reads."""
        return f"{KIND}:{self.tag_columns}x{self.tag_rows}:{self.tag_m * 1000:g}mm:{self.spacing:g}"

    @property
    def name(self) -> str:
        """What messages call it."""
        return f"{self.tag_columns}x{self.tag_rows} AprilGrid"

    @property
    def columns(self) -> int:
        """Corners in a row: two of each tag."""
        return 2 * self.tag_columns

    @property
    def rows(self) -> int:
        """Rows of corners: two of each tag."""
        return 2 * self.tag_rows

    @property
    def square_m(self) -> float:
        """The side of a dark corner square, which is the gap between tags, m."""
        return self.spacing * self.tag_m

    @property
    def finest_m(self) -> float:
        """The side of a cell of a tag, m."""
        return self.tag_m / CELLS

    @property
    def reach_m(self) -> float:
        """Nothing: a corner is seen as soon as it is in the picture."""
        return 0.0

    @property
    def object_points(self) -> Array:
        """Corners of the tags (rows * columns, 3), m: row by row from the top left, z = 0."""
        x, y = self._places(self.columns), self._places(self.rows)
        return np.stack([np.tile(x, len(y)), np.repeat(y, len(x)), np.zeros(len(x) * len(y))], axis=-1)

    @property
    def centre(self) -> Array:
        """The middle of the corners (3,), m."""
        return np.array([self._places(self.columns)[-1], self._places(self.rows)[-1], 0.0]) / 2

    @property
    def outer_corners(self) -> tuple[int, int, int, int]:
        """Indices of the four outermost corners: top left, top right, bottom right, bottom left."""
        return grid_outer(self.columns, self.rows)

    @property
    def outline(self) -> Array:
        """Corners (4, 3), m, of the printed pattern: a dark square beyond the outermost corners."""
        gap, right, bottom = self.square_m, self._places(self.columns)[-1], self._places(self.rows)[-1]
        return rectangle(-gap, -gap, float(right) + gap, float(bottom) + gap)

    @property
    def is_symmetric(self) -> bool:
        """Never: the tags tell which way up it is."""
        return False

    @property
    def dictionary(self) -> str:
        """The family of the tags."""
        return DICTIONARY

    @property
    def marker_border(self) -> int:
        """Dark cells around a tag's bits."""
        return BORDER_CELLS

    @property
    def marker_features(self) -> tuple[tuple[int, int, int, int], ...]:
        """Indices of the features at each tag's corners, by id: top left, clockwise, on the upright board."""
        return tuple(self._corners_of(tag) for tag in range(self.tag_columns * self.tag_rows))

    @property
    def marker_corners(self) -> Array:
        """Corners (tags, 4, 2), m, of the tags by id: clockwise from the top left of the dictionary's."""
        # Kalibr prints tags the other way up than OpenCV's dictionary has them.
        return np.roll(self.object_points[np.array(self.marker_features), :2], 2, axis=1)

    @property
    def plain_m(self) -> float:
        """How far beside a tag's side nothing else is printed: to its bits, or across the gap."""
        return min(BORDER_CELLS / CELLS * self.tag_m, self.square_m)

    @property
    def dark_m(self) -> float:
        """How far beside a tag's side, on its dark side, nothing bright is printed: its border."""
        return BORDER_CELLS / CELLS * self.tag_m

    @property
    def disc_m(self) -> float:
        """Radius around a corner in which it is plain."""
        return 0.7 * self.plain_m

    @property
    def edges(self) -> NDArray[np.int64]:
        """Pairs (k, 2) of corners: the sides of tags."""
        corners = np.array(self.marker_features)
        return np.stack([corners, np.roll(corners, -1, axis=1)], axis=-1).reshape(-1, 2)

    @property
    def probes(self) -> tuple[float, float]:
        """How far from a tag's middle, to its four sides, it is dark, and bright, m."""
        return (0.5 - 0.5 * BORDER_CELLS / CELLS) * self.tag_m, 0.5 * (self.tag_m + self.square_m)

    def shapes(self) -> tuple[Area, ...]:
        """Return the tags and the dark squares where gaps cross, around the outermost tags too."""
        x, y = self._places(self.columns), self._places(self.rows)
        gap = self.square_m
        tops, lefts = np.r_[-gap, y[1::2]], np.r_[-gap, x[1::2]]
        squares = [square_area(float(left), float(top), gap) for top in tops for left in lefts]
        points = self.object_points
        tags = [self._tag(tag, points[corners[0]]) for tag, corners in enumerate(self.marker_features)]
        return (*tags, *squares)

    def _tag(self, tag: int, place: Array) -> Area:
        dark = np.rot90(dark_cells(DICTIONARY, tag, BORDER_CELLS), 2)
        return cells_area(dark, float(place[0]), float(place[1]), self.tag_m / len(dark))

    def _places(self, count: int) -> Array:
        """Return where rows or columns of corners lie (count,), m."""
        number = np.arange(count)
        return np.asarray((number // 2 * (1.0 + self.spacing) + number % 2) * self.tag_m)

    def _corners_of(self, tag: int) -> tuple[int, int, int, int]:
        up, column = divmod(tag, self.tag_columns)
        first = 2 * (self.tag_rows - 1 - up) * self.columns + 2 * column
        return first, first + 1, first + self.columns + 1, first + self.columns


def parse_aprilgrid(spec: str) -> AprilGrid:
    """Return the grid of words such as `aprilgrid:6x6:24mm:0.3`; raises TargetSpecInvalid."""
    match = PATTERN.fullmatch(spec)
    if match is None:
        raise TargetSpecInvalid(
            f"'{spec}' is not a target; write aprilgrid:COLUMNSxROWS:TAGmm:SPACING with the number of tags, "
            "the side of one and the gap as a share of it, for example aprilgrid:6x6:24mm:0.3.",
            spec=spec,
        )
    grid = AprilGrid(int(match[1]), int(match[2]), float(match[3]) / 1000, float(match[4]))
    least, most = SPACINGS
    if min(grid.tag_columns, grid.tag_rows) < 2 or grid.tag_m <= 0 or not least <= grid.spacing <= most:
        raise TargetSpecInvalid(
            "An AprilGrid needs at least 2x2 tags larger than 0 mm and a spacing from "
            f"{least:g} to {most:g}.",
            spec=spec,
        )
    needed, there = grid.tag_columns * grid.tag_rows, len(marker_dictionary(DICTIONARY).bytesList)
    if needed > there:
        raise TargetSpecInvalid(
            f"A {grid.name} needs {needed} tags, but {DICTIONARY} has only {there}; take a smaller grid.",
            spec=spec,
        )
    return grid
