"""What a target with markers is to its detector. Kinds: `target_charuco`, `target_aprilgrid`.

Every feature is a saddle point, and dark and bright go round it as on a chessboard: at feature (column, row)
the quadrant towards the origin is dark where column + row is even.
"""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from service.core.vision.target import Target
from service.core.vision.transforms import Array


class CodedTarget(Target, Protocol):
    """A target whose markers tell its features apart."""

    def __hash__(self) -> int:
        """Return the same for equal targets: what is worked out of one is kept by it."""
        ...

    @property
    def dictionary(self) -> str:
        """The markers' dictionary, of `markers.DICTIONARIES`."""
        ...

    @property
    def marker_border(self) -> int:
        """Dark cells around a marker's bits."""
        ...

    @property
    def marker_corners(self) -> Array:
        """Corners (m, 4, 2), m, of the markers by id, from the top left of the dictionary's, clockwise."""
        ...

    @property
    def marker_features(self) -> tuple[tuple[int, ...], ...]:
        """Indices of the features that each marker, by id, tells the place of."""
        ...

    @property
    def edges(self) -> NDArray[np.int64]:
        """Pairs (k, 2) of features with a straight edge between them."""
        ...

    @property
    def plain_m(self) -> float:
        """How far beside an edge nothing else is printed."""
        ...

    @property
    def dark_m(self) -> float:
        """How far beside an edge, on its dark side, nothing bright is printed."""
        ...

    @property
    def disc_m(self) -> float:
        """Radius around a feature for a fit."""
        ...

    @property
    def probes(self) -> tuple[float, float]:
        """How far from a marker's middle, to its four sides, it is dark, and bright, m."""
        ...
