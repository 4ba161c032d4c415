"""A view through any lens as a pinhole camera turned towards it would see it, for closed forms that need one.

What is computed in the turned frame is turned back by the transposed rotation. Not here: the closed forms.
"""

import numpy as np

from service.core.vision.transforms import Array

NEAR_PLANE = 0.2  # cosine of the angle from the axis: farther out an image plane stretches noise too much
NARROWEST = 0.05


def turn_towards(rays: Array) -> tuple[Array, Array]:
    """Return rotations (v, 3, 3) and the rays (v, n, 3) of v views after them, in the plane z = 1 (v, n, 2).

    A view that keeps away from the image plane of the camera itself is not turned; of others the middle ray
    becomes the axis, and a ray that even then lies beyond 87 degrees is put there, which does for a start.
    """
    length = np.sqrt(np.sum(rays * rays, axis=-1))
    aside = np.any(rays[..., 2] < NEAR_PLANE * length, axis=-1)
    rotations = np.tile(np.eye(3), (len(rays), 1, 1))
    if np.any(aside):
        middle = np.mean(rays[aside] / length[aside][..., None], axis=1)
        rotations[aside] = _rotations_to_axis(middle)
        rays = rays @ np.swapaxes(rotations, -1, -2)
        depth = np.maximum(rays[..., 2], NARROWEST * length)
    else:
        depth = rays[..., 2]
    return rotations, rays[..., :2] / depth[..., None]


def _rotations_to_axis(directions: Array) -> Array:
    """Return rotations (v, 3, 3) that turn directions (v, 3) to the z axis."""
    z = directions / np.linalg.norm(directions, axis=-1, keepdims=True)
    # The frame's x axis stays as far as it can; where it is too near the direction, y takes its place.
    other = np.where(np.abs(z[:, :1]) < 0.9, np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]))
    x = other - z * np.sum(other * z, axis=-1, keepdims=True)
    x = x / np.linalg.norm(x, axis=-1, keepdims=True)
    rotations: Array = np.stack([x, np.cross(z, x), z], axis=1)
    return rotations
