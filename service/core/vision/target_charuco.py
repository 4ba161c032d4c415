"""The ChArUco board: `charuco:COLUMNSxROWS:SQUAREmm:MARKERmm:DICTIONARY`, a chessboard with markers.

COLUMNSxROWS are inner corners, as on a chessboard: OpenCV's board of 12x9 squares is 11x8 here. As OpenCV
prints it (not its legacy pattern), the first square is dark, and the bright squares hold the markers 0, 1, 2
and so on, row by row.
"""

import re
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np
from numpy.typing import NDArray

from service.core.errors import TargetSpecInvalid
from service.core.vision.feature_grid import SquareGrid, dark_squares, neighbours
from service.core.vision.markers import DICTIONARIES, dark_cells, marker_dictionary
from service.core.vision.printed import Area, cells_area
from service.core.vision.transforms import Array

KIND: Final = "charuco"
PATTERN = re.compile(r"charuco:(\d{1,2})x(\d{1,2}):(\d+(?:\.\d+)?)mm:(\d+(?:\.\d+)?)mm:(\w+)")
LEAST_MARGIN = 0.02  # between a marker and its square's sides, of the square
SMALLEST_MARKER = 0.4  # of the square


@dataclass(frozen=True)
class Charuco(SquareGrid):
    """A chessboard by its inner corners and the side of a square, m, with markers of a side, m."""

    kind: ClassVar[str] = KIND

    marker_m: float
    dictionary: str

    @property
    def spec(self) -> str:
        """The words that `parse_target` reads."""
        square, marker = f"{self.square_m * 1000:g}mm", f"{self.marker_m * 1000:g}mm"
        return f"{KIND}:{self.columns}x{self.rows}:{square}:{marker}:{self.dictionary}"

    @property
    def name(self) -> str:
        """What messages call it."""
        return f"{self.columns}x{self.rows} ChArUco board"

    @property
    def finest_m(self) -> float:
        """The side of a cell of a marker, m."""
        return self.marker_m / (marker_dictionary(self.dictionary).markerSize + 2)

    @property
    def is_symmetric(self) -> bool:
        """Never: the markers tell which way up it is."""
        return False

    @property
    def marker_corners(self) -> Array:
        """Corners (markers, 4, 2), m, of the markers by id: each from its top left, clockwise."""
        margin = 0.5 * (self.square_m - self.marker_m)
        unit = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
        squares = np.array(_bright_squares(self.columns, self.rows), dtype=np.float64)
        return squares[:, None] * self.square_m + margin + self.marker_m * unit

    @property
    def marker_border(self) -> int:
        """Dark cells around a marker's bits."""
        return 1

    @property
    def marker_features(self) -> tuple[tuple[int, ...], ...]:
        """Indices of the corners of each marker's square, by id; fewer at the border."""
        return tuple(
            tuple(
                y * self.columns + x
                for y in (row, row + 1)
                for x in (column, column + 1)
                if 0 <= x < self.columns and 0 <= y < self.rows
            )
            for column, row in _bright_squares(self.columns, self.rows)
        )

    @property
    def plain_m(self) -> float:
        """How far beside an edge of a square nothing else is printed: to the marker."""
        return 0.5 * (self.square_m - self.marker_m)

    @property
    def dark_m(self) -> float:
        """How far beside an edge, on its dark side, nothing bright is printed: the square."""
        return self.square_m

    @property
    def disc_m(self) -> float:
        """Radius around a corner in which it is plain: to the markers of the bright squares beside it."""
        return min(0.4 * self.square_m, float(np.sqrt(2.0)) * self.plain_m)

    @property
    def edges(self) -> NDArray[np.int64]:
        """Pairs (k, 2) of neighbouring corners: the sides of squares."""
        return neighbours(self.columns, self.rows)

    @property
    def probes(self) -> tuple[float, float]:
        """How far from a marker's middle, to its four sides, it is dark, and bright, m."""
        return self.square_m, 0.5 * (self.marker_m + self.plain_m)

    def shapes(self) -> tuple[Area, ...]:
        """Return the dark squares and the markers in the bright ones."""
        places = self.marker_corners[:, 0]
        cells = [dark_cells(self.dictionary, marker, 1) for marker in range(len(places))]
        markers = [
            cells_area(dark, float(x), float(y), self.marker_m / len(dark))
            for dark, (x, y) in zip(cells, places, strict=True)
        ]
        return (*dark_squares(self.columns, self.rows, self.square_m), *markers)


def parse_charuco(spec: str) -> Charuco:
    """Return the board of words such as `charuco:11x8:25mm:18mm:4x4_250`; raises TargetSpecInvalid."""
    match = PATTERN.fullmatch(spec)
    if match is None:
        raise TargetSpecInvalid(
            f"'{spec}' is not a target; write charuco:COLUMNSxROWS:SQUAREmm:MARKERmm:DICTIONARY with inner "
            "corners (one fewer than squares each way), for example charuco:11x8:25mm:18mm:4x4_250.",
            spec=spec,
        )
    board = Charuco(int(match[1]), int(match[2]), float(match[3]) / 1000, float(match[4]) / 1000, match[5])
    _check(board, spec)
    return board


def _check(board: Charuco, spec: str) -> None:
    if min(board.columns, board.rows) < 3 or board.square_m <= 0:
        raise TargetSpecInvalid(
            "A ChArUco board needs at least 3x3 inner corners and squares larger than 0 mm.", spec=spec
        )
    largest = (1.0 - 2.0 * LEAST_MARGIN) * board.square_m
    if not SMALLEST_MARKER * board.square_m <= board.marker_m <= largest:
        raise TargetSpecInvalid(
            f"A ChArUco board's markers are smaller than its squares: from {SMALLEST_MARKER:g} to "
            f"{1 - 2 * LEAST_MARGIN:g} of a square's side. The square's size comes first.",
            spec=spec,
        )
    if board.dictionary not in DICTIONARIES:
        raise TargetSpecInvalid(
            f"'{board.dictionary}' is no dictionary of markers; known are {', '.join(DICTIONARIES)}.",
            spec=spec,
        )
    needed, there = (
        len(_bright_squares(board.columns, board.rows)),
        len(marker_dictionary(board.dictionary).bytesList),
    )
    if needed > there:
        raise TargetSpecInvalid(
            f"A {board.name} has {needed} markers, but {board.dictionary} has only {there}; take a larger "
            "dictionary.",
            spec=spec,
        )


def _bright_squares(columns: int, rows: int) -> list[tuple[int, int]]:
    """Return the bright squares (column, row) by their corner nearest to the origin, row by row."""
    return [
        (column, row) for row in range(-1, rows) for column in range(-1, columns) if (row + column) % 2 != 0
    ]
