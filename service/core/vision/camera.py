"""The camera: intrinsics, projection with analytic Jacobians, and its inverse.

A lens model is one file (`lens_*.py`) and one line in `LENSES`. Not here: how intrinsics are estimated.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import ModuleType

import numpy as np

from service.core.errors import IntrinsicsInvalid
from service.core.vision import lens_pinhole5
from service.core.vision.transforms import Array

LENSES: Mapping[str, ModuleType] = {lens_pinhole5.NAME: lens_pinhole5}
PINHOLE = ("fx", "fy", "cx", "cy")


@dataclass(frozen=True)
class Intrinsics:
    """Lens, camera_matrix (3, 3) px, dist_coeffs (c,) in the lens's order, image_size (width, height) px."""

    lens: str
    camera_matrix: Array
    dist_coeffs: Array
    image_size: tuple[int, int]

    @property
    def vector(self) -> Array:
        """Parameters (4 + c,): fx fy cx cy, then the lens's coefficients in its order."""
        K = self.camera_matrix
        return np.concatenate([[K[0, 0], K[1, 1], K[0, 2], K[1, 2]], self.dist_coeffs])

    @property
    def parameters(self) -> dict[str, float]:
        """Parameters by name, in the order of `vector`."""
        return dict(zip(parameter_names(self.lens), map(float, self.vector), strict=True))

    @classmethod
    def from_vector(cls, lens: str, vector: Array, image_size: tuple[int, int]) -> "Intrinsics":
        """Return the intrinsics of a parameter vector (4 + c,)."""
        fx, fy, cx, cy = (float(v) for v in vector[:4])
        K = np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])
        return cls(lens, K, np.array(vector[4:], dtype=np.float64), image_size)

    @classmethod
    def from_parameters(
        cls, lens: str, parameters: Mapping[str, float], image_size: tuple[int, int]
    ) -> "Intrinsics":
        """Return checked intrinsics of named parameters; coefficients that are not named are zero.

        Raises IntrinsicsInvalid for an unknown lens or name, a missing or impossible value.
        """
        names = parameter_names(lens)
        unknown = sorted(set(parameters) - set(names))
        missing = [name for name in PINHOLE if name not in parameters]
        if unknown or missing:
            raise IntrinsicsInvalid(
                f"Give {', '.join(PINHOLE)} and any of {', '.join(names[4:])}; "
                f"unknown: {', '.join(unknown) or 'none'}, missing: {', '.join(missing) or 'none'}."
            )
        vector = np.array([float(parameters.get(name, 0.0)) for name in names])
        if not np.all(np.isfinite(vector)) or min(vector[0], vector[1]) <= 0 or min(image_size) < 16:
            raise IntrinsicsInvalid(
                "Values must be finite, fx and fy positive, the image at least 16 px wide and high."
            )
        return cls.from_vector(lens, vector, image_size)


def parameter_names(lens: str) -> tuple[str, ...]:
    """Return the names of a lens's parameters, fx fy cx cy first; IntrinsicsInvalid for an unknown lens."""
    if lens not in LENSES:
        raise IntrinsicsInvalid(f"Lens '{lens}' is not known; choose one of: {', '.join(LENSES)}.", lens=lens)
    return PINHOLE + tuple(LENSES[lens].COEFFICIENTS)


def project_camera_points(intrinsics: Intrinsics, points: Array) -> Array:
    """Return pixels (..., 2) of camera-frame points (..., 3), m; NaN behind or beside the camera."""
    model, vector = LENSES[intrinsics.lens], intrinsics.vector
    z = points[..., 2:3]
    ideal = np.where(z > 1e-9, points[..., :2], np.nan) / np.where(z > 1e-9, z, 1.0)
    pixels: Array = model.distort(ideal, vector[4:]) * vector[:2] + vector[2:4]
    return pixels


def project(intrinsics: Intrinsics, rotation: Array, translation: Array, object_points: Array) -> Array:
    """Return image points (..., n, 2) px of board points (n, 3) or (..., n, 3) m.

    rotation: (..., 3, 3); translation: (..., 3) m. NaN for points behind or beside the camera.
    """
    points = object_points @ np.swapaxes(rotation, -1, -2) + translation[..., None, :]
    return project_camera_points(intrinsics, points)


def project_with_jacobians(
    lens: str, vector: Array, rotation: Array, translation: Array, object_points: Array
) -> tuple[Array, Array, Array]:
    """Return projections and their derivatives, vectorised over v views; components first in memory.

    lens: model name; vector: (p,) or (v, p) parameters; rotation: (v, 3, 3); translation: (v, 3) m;
    object_points: (n, 3) or (v, n, 3) m.
    Returns image points (v, n, 2) px, derivatives by the parameters (v, n, 2, p), and by the pose (v, n, 2,
    6): a left increment exp(ω) R in rad first, then the translation in m.
    """
    model = LENSES[lens]
    vector = np.atleast_2d(vector)[:, None, :]
    turned = object_points @ np.swapaxes(rotation, -1, -2)
    points = turned + translation[:, None, :]
    inverse_z = 1.0 / points[..., 2]
    ideal = points[..., :2] * inverse_z[..., None]
    focal, coefficients = vector[..., :2], vector[..., 4:]
    distorted = model.distort(ideal, coefficients)
    by_xy, by_k = model.distort_jacobians(ideal, coefficients)

    p = vector.shape[-1]
    by_parameters = np.zeros((2, p, *ideal.shape[:-1]))
    by_point = np.empty((2, 3, *ideal.shape[:-1]))
    for axis in range(2):
        by_parameters[axis, axis] = distorted[..., axis]
        by_parameters[axis, 2 + axis] = 1.0
        scaled = focal[..., axis] * inverse_z
        for column in range(p - 4):
            by_parameters[axis, 4 + column] = by_k[..., axis, column] * focal[..., axis]
        by_point[axis, 0] = by_xy[..., axis, 0] * scaled
        by_point[axis, 1] = by_xy[..., axis, 1] * scaled
        by_point[axis, 2] = -(by_point[axis, 0] * ideal[..., 0] + by_point[axis, 1] * ideal[..., 1])
    by_pose = np.concatenate([_by_rotation(turned, by_point), by_point], axis=1)
    pixels = distorted * focal + vector[..., 2:4]
    return pixels, by_parameters.transpose(2, 3, 0, 1), by_pose.transpose(2, 3, 0, 1)


def _by_rotation(turned: Array, by_point: Array) -> Array:
    """Return derivatives (2, 3, ...) by a rotation ω of turned points (..., 3): g · (ω × t) = ω · (t × g)."""
    tx, ty, tz = turned[..., 0], turned[..., 1], turned[..., 2]
    out = np.empty_like(by_point)
    for axis, (gx, gy, gz) in enumerate(by_point):
        out[axis, 0] = ty * gz - tz * gy
        out[axis, 1] = tz * gx - tx * gz
        out[axis, 2] = tx * gy - ty * gx
    return out


def undistort(intrinsics: Intrinsics, image_points: Array, iterations: int = 50) -> Array:
    """Return ideal image-plane coordinates (..., 2) of pixels (..., 2): the inverse of the projection.

    Newton's method on the lens's own Jacobian, which converges in the image corner where a fixed-point
    iteration of five steps (OpenCV's default) is up to a pixel off. NaN where the lens does not reach the
    pixel.
    """
    model, vector = LENSES[intrinsics.lens], intrinsics.vector
    wanted = (np.asarray(image_points, dtype=np.float64) - vector[2:4]) / vector[:2]
    limit = model.monotone_radius(vector[4:])
    ideal = _inside(wanted, 0.99 * limit)
    for _ in range(iterations):
        residual = wanted - model.distort(ideal, vector[4:])
        if not np.any(np.abs(residual) > 1e-13):
            break
        by_xy, _ = model.distort_jacobians(ideal, vector[4:])
        ideal = _before_fold(ideal, _solve_2x2(by_xy, residual), limit)
    good = np.linalg.norm(wanted - model.distort(ideal, vector[4:]), axis=-1, keepdims=True) < 1e-9
    return np.where(good, ideal, np.nan)


def _inside(points: Array, radius: float) -> Array:
    """Pull points (..., 2) back to a radius."""
    length = np.linalg.norm(points, axis=-1, keepdims=True)
    inside: Array = points * np.minimum(1.0, radius / np.maximum(length, 1e-12))
    return inside


def _before_fold(points: Array, step: Array, limit: float) -> Array:
    """Return points (..., 2) after a step, or half-way to the fold where the step leads beyond it.

    At the fold itself the Jacobian is singular, and an iteration that is put there stays there.
    """
    moved = points + step
    length = np.linalg.norm(moved, axis=-1, keepdims=True)
    beyond = length >= limit
    if not np.any(beyond):
        return moved
    halfway = 0.5 * (np.linalg.norm(points, axis=-1, keepdims=True) + limit)
    return np.where(beyond, moved * (halfway / np.maximum(length, 1e-12)), moved)


def _solve_2x2(matrix: Array, right: Array) -> Array:
    """Solve (..., 2, 2) systems for (..., 2) by Cramer's rule; singular ones give a zero step."""
    a, b, c, d = matrix[..., 0, 0], matrix[..., 0, 1], matrix[..., 1, 0], matrix[..., 1, 1]
    determinant = a * d - b * c
    safe = np.where(np.abs(determinant) < 1e-12, np.inf, determinant)
    x = (d * right[..., 0] - b * right[..., 1]) / safe
    y = (a * right[..., 1] - c * right[..., 0]) / safe
    return np.stack([x, y], axis=-1)
