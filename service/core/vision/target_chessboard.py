"""The chessboard: `chessboard:COLUMNSxROWS:SIZEmm`, by its inner corners.

The square that lies diagonally outside corner 0 is dark; on a board with an odd and an even number of corners
this fixes the order, whichever way up the board is held.
"""

import re
from dataclasses import dataclass
from typing import ClassVar, Final

from service.core.errors import TargetSpecInvalid
from service.core.vision.feature_grid import SquareGrid, dark_squares
from service.core.vision.printed import Area

KIND: Final = "chessboard"
PATTERN = re.compile(r"chessboard:(\d{1,2})x(\d{1,2})(?::(\d+(?:\.\d+)?)mm)?")


@dataclass(frozen=True)
class Chessboard(SquareGrid):
    """A chessboard by its inner corners (columns x rows) and the side of one square, m."""

    kind: ClassVar[str] = KIND

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
