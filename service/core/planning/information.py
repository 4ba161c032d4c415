"""What one pose tells about the intrinsics once its own six unknowns are eliminated.

Not here: what a set of poses is worth (`scoring`).
"""

import numpy as np

from service.core.planning.pose_space import Poses
from service.core.vision.camera import Intrinsics, project_with_jacobians
from service.core.vision.target import Target
from service.core.vision.transforms import Array

# Poses per pass: the Jacobians of a 54-corner board then stay within a few megabytes.
CHUNK = 256


def pose_information(
    intrinsics: Intrinsics, target: Target, poses: Poses, sigma_px: float | Array = 0.1
) -> Array:
    """Return the information Λ (m, p, p) of m poses about the p intrinsics, in px and the lens's units.

    Λ = AᵀA − AᵀB (BᵀB)⁻¹ BᵀA with A = ∂m/∂C (2n, p) and B = ∂m/∂pose (2n, 6), rows divided by the corner
    noise sigma_px, one for all or (m,). Source: the Schur complement of the bundle's normal equations,
    DESIGN section 4.
    """
    sigma = np.broadcast_to(np.asarray(sigma_px, dtype=np.float64), (len(poses),))
    parts = []
    for start in range(0, len(poses), CHUNK):
        part = slice(start, start + CHUNK)
        weight = 1.0 / sigma[part] ** 2
        parts.append(_unit_information(intrinsics, target, poses[part]) * weight[:, None, None])
    return np.concatenate(parts)


def _unit_information(intrinsics: Intrinsics, target: Target, poses: Poses) -> Array:
    """Return Λ (m, p, p) for a corner noise of 1 px."""
    _, A, B = project_with_jacobians(
        intrinsics.lens, intrinsics.vector, poses.rotations, poses.translations, target.object_points
    )
    A, B = (J.reshape(len(poses), -1, J.shape[-1]) for J in (A, B))
    At, Bt = np.swapaxes(A, 1, 2), np.swapaxes(B, 1, 2)
    BtA = Bt @ A
    information = At @ A - np.swapaxes(BtA, 1, 2) @ np.linalg.solve(Bt @ B, BtA)
    symmetric: Array = (information + np.swapaxes(information, 1, 2)) / 2.0
    return symmetric
