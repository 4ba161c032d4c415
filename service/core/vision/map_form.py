"""What the forms of a board's map have in common: their numbers, radial terms, and the fit to one image.

Not here: the forms (`radial_map`, `division_map`), which of them fits (`board_map`).
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from service.core.vision.transforms import Array

ITERATIONS = 12
SETTLED = 1e-9
RIDGE = 1e-10  # of the diagonal: what few points do not tell stays as it is
CENTRE_WEIGHT = 1e-5  # a centre off by a twentieth of the picture counts like noise of a twentieth of a pixel
HOMOGRAPHY, CENTRE, TERMS = slice(0, 9), slice(9, 11), slice(11, None)


@dataclass(frozen=True)
class BoardMap(ABC):
    """A smooth map from a board into an image: H (3, 3), of any length; k (t,) of radial terms; centre (2,).

    middle: (2,) px, of the image; scale: px. Pixels are middle + scale times a form's coordinates, and so is
    the centre.
    """

    H: Array
    k: Array
    centre: Array
    middle: Array
    scale: float

    @abstractmethod
    def image_of(self, points: Array) -> Array:
        """Return where board points (..., 2) m are, px."""

    @abstractmethod
    def linearise(self, board: Array, wanted: Array) -> tuple[Array, Array]:
        """Return how far points (n, 2) m are from wanted coordinates (n, 2), (2n,), and its derivatives.

        These are (2n, 11 + t): by H, row by row, by the centre and by k, of the coordinates.
        """

    def fitted(self, board: Array, points: Array) -> Self:
        """Return the map that takes board points (n, 2) m nearest to points (n, 2) px: Gauss and Newton's."""
        here, wanted = self, (points - self.middle) / self.scale
        for _ in range(ITERATIONS):
            step = here._step(board, wanted)
            H = here.H + step[HOMOGRAPHY].reshape(3, 3)
            here = replace(here, H=H, centre=here.centre + step[CENTRE], k=here.k + step[TERMS])
            if np.abs(step[TERMS]).max() < SETTLED:
                break
        return here

    def _step(self, board: Array, wanted: Array) -> Array:
        error, J = self.linearise(board, wanted)
        information, gradient = J.T @ J, J.T @ error
        information += np.diag(RIDGE * np.diagonal(information))
        # A longer H is the same map.
        along = self.H.ravel() / np.linalg.norm(self.H)
        information[HOMOGRAPHY, HOMOGRAPHY] += np.trace(information[HOMOGRAPHY, HOMOGRAPHY]) * np.outer(
            along, along
        )
        # Without distortion nothing tells where its centre is: then it is in the middle.
        information[CENTRE, CENTRE] += CENTRE_WEIGHT * np.eye(2)
        gradient[CENTRE] -= CENTRE_WEIGHT * self.centre
        return np.asarray(np.linalg.solve(information, gradient))


@dataclass(frozen=True)
class RadialTerms:
    """At places q (..., 2): |q|²ⁱ (..., t), their sum by k (...), and the sum's derivative by |q|² (...)."""

    powers: Array
    value: Array
    slope: Array


def radial_terms(square: Array, k: Array) -> RadialTerms:
    """Return the terms at squares |q|² (...) with coefficients k (t,)."""
    order = np.arange(len(k))
    lower = square[..., None] ** order
    powers = lower * square[..., None]
    return RadialTerms(powers, np.asarray(powers @ k), np.asarray(lower @ ((order + 1) * k)))


def span(points: Array, middle: Array) -> float:
    """Return the scale, px, at which no point (n, 2) px is farther than 1 from the middle (2,)."""
    return float(np.linalg.norm(points - middle, axis=1).max())


def homogeneous(board: Array) -> Array:
    """Return board points (n, 2) with a one, (n, 3)."""
    return np.column_stack([board, np.ones(len(board))])
