"""A board's map by a homography into rays and the division model of a lens (Fitzgibbon, CVPR 2001).

A place q about a centre near the image's middle sees the ray (q, 1 + Σ k |q|²ⁱ). Few terms follow wide lenses
and fisheyes, beyond 90 degrees too; a lens that folds does not see one ray at one place.
Not here: homographies into the image (`radial_map`), which of both fits (`board_map`).
"""

import numpy as np

from service.core.vision.map_form import SETTLED, BoardMap, homogeneous, radial_terms, span
from service.core.vision.transforms import Array

NEWTON_STEPS = 12
LARGEST_RADIUS = 2.0  # within which places are looked for; those of features are at most 1


class DivisionMap(BoardMap):
    """H takes the board, m, to rays (X, Y, Z); the place centre + q sees those along (q, 1 + Σ k |q|²ⁱ)."""

    def image_of(self, points: Array) -> Array:
        """Return where board points (..., 2) m are, px."""
        X, Y, Z = np.moveaxis(points @ self.H[:, :2].T + self.H[:, 2], -1, 0)
        across = np.maximum(np.hypot(X, Y), 1e-12)
        q = np.stack([X, Y], axis=-1) * (_solve_radius(across, Z, self.k) / across)[..., None]
        return np.asarray(self.middle + self.scale * (self.centre + q))

    def linearise(self, board: Array, wanted: Array) -> tuple[Array, Array]:
        """Return errors and derivatives as any map does.

        Where a place's ray misses that of its feature by e, the place is off by (de/dq)⁻¹ e to first order.
        """
        n, points = len(board), homogeneous(board)
        ray, q = points @ self.H.T, wanted - self.centre
        terms = radial_terms(np.sum(q * q, axis=1), self.k)
        f = 1.0 + terms.value
        by_q = 2.0 * terms.slope[:, None, None] * ray[:, :2, None] * q[:, None, :]
        by_q -= ray[:, 2, None, None] * np.eye(2)
        by_H = np.zeros((n, 2, 9))
        by_H[:, 0, :3] = by_H[:, 1, 3:6] = f[:, None] * points
        by_H[:, :, 6:] = -q[:, :, None] * points[:, None, :]
        e = ray[:, :2] * f[:, None] - q * ray[:, 2:]
        by_k = ray[:, :2, None] * terms.powers[:, None, :]
        parts = np.concatenate([e[:, :, None], by_H, -by_q, by_k], axis=2)
        in_image = np.linalg.solve(by_q, parts).reshape(2 * n, -1)
        return in_image[:, 0], -in_image[:, 1:]


def fit_division_map(board: Array, points: Array, middle: Array, terms: int) -> DivisionMap:
    """Return the map that takes board points (n, 2) m nearest to points (n, 2) px.

    middle: (2,) px, of the image; terms: how many.
    """
    scale = span(points, middle)
    H, k = _first_numbers(board, (points - middle) / scale, terms)
    return DivisionMap(H, k, np.zeros(2), middle, scale).fitted(board, points)


def _first_numbers(board: Array, wanted: Array, terms: int) -> tuple[Array, Array]:
    """Return H and k of a map about the middle, (0, 0), by linear least squares twice.

    Directions from the middle are what no radial term changes, and give two rows of H (the radial alignment
    of Tsai, 1987). Distances then give its third row and the terms.
    """
    points = homogeneous(board)
    x, y = wanted[:, :1], wanted[:, 1:]
    rows = np.linalg.svd(np.hstack([-y * points, x * points]))[2][-1].reshape(2, 3)
    aligned = np.sum(wanted * (points @ rows.T), axis=1)
    if aligned.sum() < 0:
        rows, aligned = -rows, -aligned
    square = np.sum(wanted * wanted, axis=1)
    powers = radial_terms(square, np.zeros(terms)).powers
    A = np.hstack([square[:, None] * points, -aligned[:, None] * powers])
    solved = np.linalg.lstsq(A, aligned, rcond=None)[0]
    return np.vstack([rows, solved[:3]]), solved[3:]


def _solve_radius(across: Array, Z: Array, k: Array) -> Array:
    """Return the radii (...) at which rays with X² + Y² = across² are seen, by Newton from a pinhole's."""
    radius = np.where(across < Z, across / np.maximum(Z, across), 1.0)
    for _ in range(NEWTON_STEPS):
        terms = radial_terms(radius * radius, k)
        miss = across * (1.0 + terms.value) - radius * Z
        step = miss / (2.0 * across * radius * terms.slope - Z)
        radius = np.clip(radius - step, 0.0, LARGEST_RADIUS)
        if np.abs(step).max(initial=0.0) < SETTLED:
            break
    return np.asarray(radius)
