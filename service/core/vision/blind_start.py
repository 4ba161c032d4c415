"""Where a solve starts from the views alone: the radial alignment constraint, in closed form.

With the centre assumed in the middle of the image, the direction of a corner from the centre depends neither
on the focal length nor on the radial distortion, so a wide lens is no harder than a narrow one (Tsai 1987;
Scaramuzza, Martinelli, Siegwart 2006). Vectorised over views. Not here: starts from assumed intrinsics
(`calibration_start`).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.calibration_start import are_shown, plain_vector
from service.core.vision.camera import LENSES
from service.core.vision.normal_equations import Estimate
from service.core.vision.transforms import Array, skew, turn_points
from service.core.vision.view_stack import ViewStack


def blind_start(lens: str, image_size: tuple[int, int], stack: ViewStack) -> Estimate | None:
    """Return an estimate from the views alone, bent about as they are; None where they give no focal length.

    The poses are those of the radial alignment, in which distortion has no part.
    """
    vector = plain_vector(lens, 1.0, image_size)
    from_centre = stack.image_points - vector[2:4]
    block, across = _radial_alignment(stack, from_centre)
    tilted = _tilted(block)
    seen = _Depths.of(stack, from_centre, tilted, across)
    each = _solved(seen.A, seen.b)
    shown = are_shown(lens, seen.translations(each, across))
    errors = np.where((each[..., 0] > 0) & shown, seen.errors(each), np.inf)
    better = np.where(errors[0] <= errors[1], 0, 1), np.arange(len(block))
    chosen = seen.chosen(better)
    both = _solved(chosen.A.sum(axis=0), chosen.b.sum(axis=0))
    translations = chosen.translations(both, across)
    if not (np.isfinite(both).all() and both[0] > 0 and np.all(are_shown(lens, translations))):
        return None
    vector[:2] = both[0] * chosen.unit_px
    vector[4:] = LENSES[lens].like_division(float(both[0] * both[1]))
    return Estimate(vector, tilted[better], translations)


def _null_vectors(rows: Array) -> Array:
    """Return the unit vectors (v, d) that systems (v, m, d) map closest to zero."""
    _, vectors = np.linalg.eigh(np.swapaxes(rows, -1, -2) @ rows)
    return np.ascontiguousarray(vectors[..., 0])


def _radial_alignment(stack: ViewStack, from_centre: Array) -> tuple[Array, Array]:
    """Return the upper left 2x2 of the rotations (v, 2, 2) and the translations across the axis (v, 2), m.

    A corner and its image lie on one ray from the centre: v (r11 X + r12 Y + tx) = u (r21 X + r22 Y + ty).
    """
    centre, size, board = stack.normalised
    plane = np.concatenate([board, np.ones_like(board[..., :1])], axis=-1)
    unit = from_centre / np.abs(from_centre).max()
    rows = np.concatenate([unit[..., 1:] * plane, -unit[..., :1] * plane], axis=-1)
    M = _null_vectors(rows * stack.weights[..., None]).reshape(-1, 2, 3)
    # The larger singular value of an upper left block of a plane's rotation is one: an unshortened direction
    # exists.
    M = M / _largest_singular_value(M[..., :2])[:, None, None]
    along = np.sum((plane @ np.swapaxes(M, -1, -2)) * unit * stack.weights[..., None], axis=(1, 2))
    M = M * np.where(along < 0, -1.0, 1.0)[:, None, None]
    across = M[..., 2] * size[:, None] - np.einsum("vij,vj->vi", M[..., :2], centre)
    return M[..., :2], across


def _largest_singular_value(M: Array) -> Array:
    """Return the larger singular value (v,) of matrices (v, 2, 2)."""
    squares = np.sum(M * M, axis=(-2, -1))
    determinant = M[..., 0, 0] * M[..., 1, 1] - M[..., 0, 1] * M[..., 1, 0]
    return np.asarray(np.sqrt(0.5 * (squares + np.sqrt(np.maximum(squares**2 - 4.0 * determinant**2, 0.0)))))


def _tilted(block: Array) -> Array:
    """Return the two rotations (2, v, 3, 3) of an upper left 2x2 (v, 2, 2): tilted to either side.

    The block's larger singular value is one: so there is a third row that makes both columns orthonormal.
    """
    lower = np.sqrt(np.maximum(1.0 - np.sum(block * block, axis=1), 0.0))
    product = -np.sum(block[..., 0] * block[..., 1], axis=1)
    lower[:, 1] *= np.where(product < 0, -1.0, 1.0)
    rotations = np.empty((2, len(block), 3, 3))
    rotations[..., :2, :2] = block
    rotations[0, :, 2, :2], rotations[1, :, 2, :2] = lower, -lower
    x, y = rotations[..., 0], rotations[..., 1]
    rotations[..., 2] = (skew(x) @ y[..., None])[..., 0]
    return rotations


@dataclass(frozen=True)
class _Depths:
    """What views (..., v) say of the focal length, the bend and their depths, as normal equations.

    With ρ a corner's distance from the centre, in units of unit_px, and d its distance from the axis, in m,
    (a + b ρ²) d − ρ tz = ρ q, where q is the corner's own depth against the board's origin; linear in a, the
    focal length, b and the depth tz. a b is the coefficient of the division model at focal length one. Each
    view's depth is eliminated, as the poses are in the solve: A (..., v, 2, 2), b (..., v, 2) and the squares
    (..., v) are of what is left; the depth itself is depth − by_shared · (a, b).
    """

    unit_px: float
    A: Array
    b: Array
    squares: Array
    depth: Array
    by_shared: Array

    @classmethod
    def of(cls, stack: ViewStack, from_centre: Array, rotations: Array, across: Array) -> "_Depths":
        """Return them for rotations (..., v, 3, 3) and translations across the axis (v, 2), m."""
        camera = turn_points(rotations, stack.object_points)
        unit_px = float(np.abs(from_centre).max())
        rho = np.sqrt(np.sum(from_centre * from_centre, axis=-1)) / unit_px
        x, y = camera[..., 0] + across[:, :1], camera[..., 1] + across[:, 1:]
        rows = np.empty((*camera.shape[:-2], 4, camera.shape[-2]))
        rows[..., 0, :] = d = np.sqrt(x * x + y * y)
        rows[..., 1, :] = d * (rho * rho)
        rows[..., 2, :] = rho * camera[..., 2]
        rows[..., 3, :] = -rho
        rows *= stack.weights[:, None]
        G = rows @ rows.swapaxes(-1, -2)
        of_depth = G[..., 3, :3] / G[..., 3, 3:]
        left = G[..., :3, :3] - G[..., :3, 3, None] * of_depth[..., None, :]
        return cls(
            unit_px, left[..., :2, :2], left[..., :2, 2], left[..., 2, 2], of_depth[..., 2], of_depth[..., :2]
        )

    def chosen(self, index: tuple[NDArray[np.intp], NDArray[np.intp]]) -> "_Depths":
        """Return them for the views of an index into (..., v)."""
        parts = (self.A, self.b, self.squares, self.depth, self.by_shared)
        return _Depths(self.unit_px, *(part[index] for part in parts))

    def errors(self, shared: Array) -> Array:
        """Return the squared errors (..., v) at a and b (..., v, 2)."""
        curved = (self.A @ shared[..., None])[..., 0] - 2.0 * self.b
        return np.asarray(self.squares + np.sum(curved * shared, axis=-1))

    def translations(self, shared: Array, across: Array) -> Array:
        """Return translations (..., v, 3), m, at a and b (..., 2), with those across the axis (v, 2)."""
        translations = np.empty((*self.depth.shape, 3))
        translations[..., :2] = across
        translations[..., 2] = self.depth - np.sum(self.by_shared * shared, axis=-1)
        return translations


def _solved(A: Array, b: Array) -> Array:
    """Return the focal length and the bend (..., 2) of normal equations A (..., 2, 2), b (..., 2)."""
    little = 1e-15 * np.trace(A, axis1=-2, axis2=-1)[..., None, None] * np.eye(2)
    return np.asarray(np.linalg.solve(A + little, b[..., None])[..., 0])
