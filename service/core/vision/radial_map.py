"""A board's map by a homography, then radial terms about a centre near the image's middle, as a pinhole's.

Not here: rays (`division_map`), which of both fits (`board_map`).
"""

import cv2
import numpy as np

from service.core.vision.map_form import BoardMap, homogeneous, radial_terms, span
from service.core.vision.transforms import Array


class RadialMap(BoardMap):
    """H takes the board, m, to coordinates p; these move by Σ k |q|²ⁱ q with q = p − centre."""

    def image_of(self, points: Array) -> Array:
        """Return where board points (..., 2) m are, px."""
        p = _apply(self.H, points)
        q = p - self.centre
        bent = p + q * radial_terms(np.sum(q * q, axis=-1), self.k).value[..., None]
        return np.asarray(self.middle + self.scale * bent)

    def linearise(self, board: Array, wanted: Array) -> tuple[Array, Array]:
        """Return errors and derivatives as any map does."""
        n, rays = len(board), homogeneous(board)
        p = _apply(self.H, board)
        q, w = p - self.centre, rays @ self.H[2]
        terms = radial_terms(np.sum(q * q, axis=1), self.k)
        by_q = terms.value[:, None, None] * np.eye(2)
        by_q += 2.0 * terms.slope[:, None, None] * (q[:, :, None] * q[:, None, :])
        by_H = np.zeros((n, 2, 9))
        by_H[:, 0, :3] = by_H[:, 1, 3:6] = rays / w[:, None]
        by_H[:, :, 6:] = -p[:, :, None] * (rays / w[:, None])[:, None, :]
        J = np.concatenate([by_H + by_q @ by_H, -by_q, q[:, :, None] * terms.powers[:, None, :]], axis=2)
        return (wanted - p - q * terms.value[:, None]).ravel(), J.reshape(2 * n, -1)


def fit_radial_map(board: Array, points: Array, middle: Array, terms: int) -> RadialMap:
    """Return the map that takes board points (n, 2) m nearest to points (n, 2) px.

    middle: (2,) px, of the image; terms: how many. Without radial terms where these make it worse.
    """
    scale = span(points, middle)
    H, _ = cv2.findHomography(board, (points - middle) / scale)
    plain = RadialMap(np.asarray(H, dtype=np.float64), np.zeros(terms), np.zeros(2), middle, scale)
    bent = plain.fitted(board, points)
    squares = [np.sum((one.image_of(board) - points) ** 2) for one in (bent, plain)]
    # Written so that NaN is not better.
    return bent if squares[0] <= squares[1] else plain


def _apply(H: Array, points: Array) -> Array:
    mapped = points @ H[:, :2].T + H[:, 2]
    return np.asarray(mapped[..., :2] / mapped[..., 2:])
