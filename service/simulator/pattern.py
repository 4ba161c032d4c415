"""What is printed on a plate, as the share of a pixel that shows it dark. Here: the interface and the choice.

Coordinates are in the target's squares from feature 0. Kinds of pattern are `pattern_*.py`; a new target
whose shapes are upright cells or discs needs none.
"""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from service.core.errors import SceneInvalid
from service.core.vision.printed import Area, Disc
from service.core.vision.target import Target
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Array
from service.simulator.pattern_cells import make_cells
from service.simulator.pattern_checks import make_checks
from service.simulator.pattern_discs import make_discs

Levels = NDArray[np.float32]


class Pattern(Protocol):
    """The dark shapes of a target; u and v in squares."""

    @property
    def finest(self) -> float:
        """How wide a pixel's footprint may be for `shares` to be exact, squares."""
        ...

    def sample(self, uv: Array) -> NDArray[np.bool_]:
        """Return whether points (n, 2) are dark."""
        ...

    def shares(self, uv: Array, jacobian: Array) -> Array:
        """Return the dark shares (n,) of pixels at uv (n, 2) with d(u, v)/d(pixel) (n, 2, 2)."""
        ...

    def near_edge(self, uv: Array, half: Array) -> NDArray[np.bool_]:
        """Return whether an edge may lie within half (n, 2), along u and v, of points (n, 2)."""
        ...

    def soft_shares(self, u: Levels, v: Levels, footprint: tuple[Levels, Levels]) -> Levels:
        """Return the dark shares (h, w) of pixels, with edges as ramps that are a footprint wide."""
        ...


def make_pattern(target: Target) -> Pattern:
    """Return the pattern of a target; raises SceneInvalid for shapes that cannot be drawn."""
    if isinstance(target, Chessboard):
        return make_checks(target)
    shapes = target.shapes()
    areas = [shape for shape in shapes if isinstance(shape, Area)]
    discs = [shape for shape in shapes if isinstance(shape, Disc)]
    if areas and discs:
        raise SceneInvalid(f"A {target.name} has both cells and dots; the virtual camera draws one of them.")
    return make_discs(discs, target.square_m) if discs else make_cells(areas, target.square_m)
