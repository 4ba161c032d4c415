"""The chessboard: `chessboard:COLUMNSxROWS:SIZEmm`, by its inner corners.

The square that lies diagonally outside corner 0 is dark; on a board with an odd and an even number of corners
this fixes the order, whichever way up the board is held.
"""

import re
from dataclasses import dataclass
from typing import Final

import numpy as np

from service.core.errors import TargetSpecInvalid
from service.core.vision.feature_grid import dark_squares, grid_outer, grid_outline, grid_points
from service.core.vision.printed import Area
from service.core.vision.transforms import Array

KIND: Final = "chessboard"
PATTERN = re.compile(r"chessboard:(\d{1,2})x(\d{1,2})(?::(\d+(?:\.\d+)?)mm)?")


@dataclass(frozen=True)
class Chessboard:
    """A chessboard by its inner corners (columns x rows) and the side of one square, m."""

    columns: int
    rows: int
    square_m: float

    @property
    def kind(self) -> str:
        """The first word of its spec."""
        return KIND

    @property
    def spec(self) -> str:
        """The words that `parse_target` reads."""
        return f"{KIND}:{self.columns}x{self.rows}:{self.square_m * 1000:g}mm"

    @property
    def name(self) -> str:
        """What messages call it."""
        return f"{self.columns}x{self.rows} chessboard"

    @property
    def finest_m(self) -> float:
        """The side of a square, m."""
        return self.square_m

    @property
    def object_points(self) -> Array:
        """Corners (rows * columns, 3), m: row by row, z = 0."""
        return grid_points(self.columns, self.rows, self.square_m)

    @property
    def centre(self) -> Array:
        """The middle of the corners (3,), m."""
        return np.array([(self.columns - 1) / 2, (self.rows - 1) / 2, 0.0]) * self.square_m

    @property
    def outer_corners(self) -> tuple[int, int, int, int]:
        """Indices of the four outermost corners: top left, top right, bottom right, bottom left."""
        return grid_outer(self.columns, self.rows)

    @property
    def outline(self) -> Array:
        """Corners (4, 3), m, of the printed pattern: one square beyond the outermost corners."""
        return grid_outline(self.columns, self.rows, self.square_m)

    @property
    def is_coded(self) -> bool:
        """Never: a part of a chessboard may be any part."""
        return False

    @property
    def is_symmetric(self) -> bool:
        """Whether the pattern looks the same turned by 180 degrees: the order of corners is a choice then."""
        return (self.columns + self.rows) % 2 == 0

    def shapes(self) -> tuple[Area, ...]:
        """Return the dark squares."""
        return dark_squares(self.columns, self.rows, self.square_m)


def parse_chessboard(spec: str) -> Chessboard:
    """Return the board of words such as `chessboard:9x6:25mm` (inner corners; 1 m squares if no size).

    Raises TargetSpecInvalid when it does not follow the pattern or the board is smaller than 3x3.
    """
    match = PATTERN.fullmatch(spec)
    if match is None:
        raise TargetSpecInvalid(
            f"'{spec}' is not a target; write chessboard:COLUMNSxROWS:SIZEmm with inner corners, "
            "for example chessboard:9x6:25mm.",
            spec=spec,
        )
    columns, rows = int(match[1]), int(match[2])
    square_m = float(match[3]) / 1000 if match[3] else 1.0
    if min(columns, rows) < 3 or square_m <= 0:
        raise TargetSpecInvalid(
            "A chessboard needs at least 3x3 inner corners and squares larger than 0 mm.", spec=spec
        )
    return Chessboard(columns, rows, square_m)
