"""The asymmetric grid of circles: `circles:COLUMNSxROWS:STEPmm:DIAMETERmm`, as OpenCV defines it.

Dot j of row i lies at x = (2 j + i mod 2) STEP and y = i STEP: rows are a step apart, the dots of a row two,
every other row is shifted by one. DIAMETER is that of a dot; without it, half a step.
"""

import re
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np

from service.core.errors import TargetSpecInvalid
from service.core.vision.feature_grid import grid_outer, rectangle
from service.core.vision.printed import Disc
from service.core.vision.transforms import Array

KIND: Final = "circles"
PATTERN = re.compile(r"circles:(\d{1,2})x(\d{1,2}):(\d+(?:\.\d+)?)mm(?::(\d+(?:\.\d+)?)mm)?")
DIAMETERS: Final = (0.2, 1.2)  # of a step; nearest dots are 1.41 steps apart


@dataclass(frozen=True)
class Circles:
    """A grid of dots (columns x rows) by its step and a dot's diameter, m."""

    kind: ClassVar[str] = KIND

    columns: int
    rows: int
    step_m: float
    diameter_m: float

    @property
    def spec(self) -> str:
        """The words that `parse_target` reads."""
        step, diameter = f"{self.step_m * 1000:g}mm", f"{self.diameter_m * 1000:g}mm"
        return f"{KIND}:{self.columns}x{self.rows}:{step}:{diameter}"

    @property
    def name(self) -> str:
        """What messages call it."""
        return f"{self.columns}x{self.rows} grid of circles"

    @property
    def square_m(self) -> float:
        """The step, m."""
        return self.step_m

    @property
    def finest_m(self) -> float:
        """A dot's diameter, m."""
        return self.diameter_m

    @property
    def reach_m(self) -> float:
        """A dot's radius, m."""
        return 0.5 * self.diameter_m

    @property
    def object_points(self) -> Array:
        """Centres of the dots (rows * columns, 3), m: row by row, z = 0."""
        row, column = np.divmod(np.arange(self.rows * self.columns), self.columns)
        return np.stack([2.0 * column + row % 2, 1.0 * row, 0.0 * row], axis=-1) * self.step_m

    @property
    def centre(self) -> Array:
        """The middle of the dots' centres (3,), m."""
        return np.array([2 * self.columns - 1, self.rows - 1, 0.0]) * self.step_m / 2

    @property
    def outer_corners(self) -> tuple[int, int, int, int]:
        """Indices of the four outermost dots: top left, top right, bottom right, bottom left."""
        return grid_outer(self.columns, self.rows)

    @property
    def outline(self) -> Array:
        """Corners (4, 3), m, of the rectangle around the dots."""
        radius, step = 0.5 * self.diameter_m, self.step_m
        right, bottom = (2 * self.columns - 1) * step, (self.rows - 1) * step
        return rectangle(-radius, -radius, right + radius, bottom + radius)

    @property
    def is_symmetric(self) -> bool:
        """Whether it looks the same turned by 180 degrees, as with an even number of rows."""
        return self.rows % 2 == 0

    def shapes(self) -> tuple[Disc, ...]:
        """Return the dots."""
        return tuple(Disc(point[:2], 0.5 * self.diameter_m) for point in self.object_points)


def parse_circles(spec: str) -> Circles:
    """Return the grid of words such as `circles:4x11:20mm:10mm`; raises TargetSpecInvalid."""
    match = PATTERN.fullmatch(spec)
    if match is None:
        raise TargetSpecInvalid(
            f"'{spec}' is not a target; write circles:COLUMNSxROWS:STEPmm:DIAMETERmm with the dots in a row, "
            "the rows, the distance of rows and the diameter of a dot, for example circles:4x11:20mm:10mm.",
            spec=spec,
        )
    step_m = float(match[3]) / 1000
    diameter_m = float(match[4]) / 1000 if match[4] else 0.5 * step_m
    grid = Circles(int(match[1]), int(match[2]), step_m, diameter_m)
    least, most = DIAMETERS
    if min(grid.columns, grid.rows) < 3 or not 0 < least * step_m <= diameter_m <= most * step_m:
        raise TargetSpecInvalid(
            "A grid of circles needs at least 3 rows of 3 dots, and dots of a diameter from "
            f"{least:g} to {most:g} steps.",
            spec=spec,
        )
    return grid
