"""A target that looks the same turned by half: its features have two orders, and a view of it has two poses.

A detector takes the one whose x axis points to the right in the image; a pose that is asked for may need the
other. Not here: which targets these are (`Target.is_symmetric`).
"""

import numpy as np

from service.core.vision.target import Target
from service.core.vision.transforms import Array, Pose, rotation_vector

HALF = np.diag([-1.0, -1.0, 1.0])


def turn_by_half(pose: Pose, target: Target) -> Pose:
    """Return the pose in which a symmetric target looks as at the given one; its features go backwards."""
    R = pose.rotation
    return Pose(rotation_vector(R @ HALF), pose.tvec + 2.0 * R @ target.centre)


def mean_distances(seen: Array, expected: Array, target: Target) -> Array:
    """Return the mean distances (...), px, of outer features (4, 2) from where they are expected (..., 4, 2).

    In the nearer of a symmetric target's two orders.
    """
    orders = (seen, np.roll(seen, 2, axis=0)) if target.is_symmetric else (seen,)
    means = [np.linalg.norm(expected - order, axis=-1).mean(axis=-1) for order in orders]
    return np.asarray(np.min(means, axis=0))
