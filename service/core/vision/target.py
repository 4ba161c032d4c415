"""What a target is to the rest of the house, and the words that name one.

The board's frame: origin at feature 0, x along the rows of features, y from row to row, z away from the
camera when the board is upright and faces it. Features lie on z = 0, row by row.
A kind of target is one file (`target_*.py`) and one line in `KINDS`; its detector is one line in
`detection.DETECTORS`. Not here: how a kind is found in an image.
"""

from collections.abc import Callable, Mapping
from typing import Protocol

from service.core.errors import TargetSpecInvalid
from service.core.vision import target_aprilgrid, target_charuco, target_chessboard, target_circles
from service.core.vision.printed import Shape
from service.core.vision.transforms import Array


class Target(Protocol):
    """A flat pattern of known features: corners or the centres of dots."""

    @property
    def kind(self) -> str:
        """The first word of its spec."""
        ...

    @property
    def spec(self) -> str:
        """The words that `parse_target` reads."""
        ...

    @property
    def name(self) -> str:
        """What messages call it, such as `9x6 chessboard`."""
        ...

    @property
    def columns(self) -> int:
        """Features in a row."""
        ...

    @property
    def rows(self) -> int:
        """Rows of features."""
        ...

    @property
    def square_m(self) -> float:
        """The measure that its spec is scaled by: the side of a square, of circles the grid's step."""
        ...

    @property
    def finest_m(self) -> float:
        """The side of the smallest thing that must be told apart in an image: a square, a cell, a dot."""
        ...

    @property
    def reach_m(self) -> float:
        """How far around a feature its print must be seen, m: the radius of a dot, nothing at a corner."""
        ...

    @property
    def object_points(self) -> Array:
        """Features (rows * columns, 3), m: row by row, z = 0."""
        ...

    @property
    def centre(self) -> Array:
        """The middle of the features (3,), m."""
        ...

    @property
    def outer_corners(self) -> tuple[int, int, int, int]:
        """Indices of the four outermost features: top left, top right, bottom right, bottom left."""
        ...

    @property
    def outline(self) -> Array:
        """Corners (4, 3), m, of the rectangle around all that is printed dark, in the order of the above."""
        ...

    @property
    def is_symmetric(self) -> bool:
        """Whether the pattern looks the same turned by 180 degrees: the order is a choice then."""
        ...

    def shapes(self) -> tuple[Shape, ...]:
        """Return the print: dark shapes on white, m, which touch but do not overlap."""
        ...


KINDS: Mapping[str, Callable[[str], Target]] = {
    target_chessboard.KIND: target_chessboard.parse_chessboard,
    target_charuco.KIND: target_charuco.parse_charuco,
    target_aprilgrid.KIND: target_aprilgrid.parse_aprilgrid,
    target_circles.KIND: target_circles.parse_circles,
}


def parse_target(spec: str) -> Target:
    """Return the target of words such as `chessboard:9x6:25mm`.

    Raises TargetSpecInvalid when the kind is unknown or the words do not follow its pattern.
    """
    words = spec.strip()
    parse = KINDS.get(words.partition(":")[0])
    if parse is None:
        raise TargetSpecInvalid(
            f"'{spec}' is not a target; write one such as chessboard:9x6:25mm, "
            "charuco:11x8:25mm:18mm:4x4_250, aprilgrid:6x6:24mm:0.3 or circles:4x11:20mm:10mm.",
            spec=spec,
        )
    return parse(words)
