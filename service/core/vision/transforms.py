"""Rotations and rigid poses, vectorised over leading dimensions. Not here: cameras and projection."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Pose:
    """A rigid transform `T_cam_board`: maps board coordinates (m) into the camera frame (m).

    rvec: (3,) rotation vector, rad. tvec: (3,) board origin in the camera frame, m.
    """

    rvec: Array
    tvec: Array

    @property
    def rotation(self) -> Array:
        """Rotation matrix (3, 3)."""
        return rotation_matrix(self.rvec)

    @property
    def matrix(self) -> Array:
        """Homogeneous matrix (4, 4)."""
        T = np.eye(4)
        T[:3, :3] = self.rotation
        T[:3, 3] = self.tvec
        return T


def stack_poses(poses: "list[Pose] | tuple[Pose, ...]") -> tuple[Array, Array]:
    """Return rotations (v, 3, 3) and translations (v, 3), m, of v poses."""
    rvecs = np.array([pose.rvec for pose in poses], dtype=np.float64).reshape(-1, 3)
    tvecs = np.array([pose.tvec for pose in poses], dtype=np.float64).reshape(-1, 3)
    return rotation_matrix(rvecs), tvecs


def pose_from_matrix(T: Array) -> Pose:
    """Return the pose of a homogeneous matrix (4, 4)."""
    return Pose(rotation_vector(T[:3, :3]), np.array(T[:3, 3], dtype=np.float64))


def compose(T_ab: Pose, T_bc: Pose) -> Pose:
    """Return `T_ac = T_ab T_bc`."""
    R = T_ab.rotation
    return Pose(rotation_vector(R @ T_bc.rotation), R @ T_bc.tvec + T_ab.tvec)


def invert(T_ab: Pose) -> Pose:
    """Return `T_ba`."""
    R = T_ab.rotation.T
    return Pose(rotation_vector(R), -R @ T_ab.tvec)


def skew(v: Array) -> Array:
    """Return the cross-product matrices (..., 3, 3) of vectors (..., 3)."""
    K = np.zeros((*v.shape[:-1], 3, 3))
    K[..., 0, 1], K[..., 0, 2], K[..., 1, 2] = -v[..., 2], v[..., 1], -v[..., 0]
    return K - np.swapaxes(K, -1, -2)


def rotation_matrix(rvec: Array) -> Array:
    """Return rotation matrices (..., 3, 3) of rotation vectors (..., 3), rad (Rodrigues' formula)."""
    rvec = np.asarray(rvec, dtype=np.float64)
    half = np.linalg.norm(rvec, axis=-1)[..., None, None] / (2.0 * np.pi)
    # sin θ / θ and (1 − cos θ) / θ², also where θ vanishes; NumPy's sinc is of π x.
    a, b = np.sinc(2.0 * half), 0.5 * np.sinc(half) ** 2
    K = skew(rvec)
    rotation: Array = np.eye(3) + a * K + b * (K @ K)
    return rotation


def turn_points(R: Array, points: Array) -> Array:
    """Return points (..., n, 3) after rotations (..., 3, 3), each component in one piece of memory."""
    return np.swapaxes(R @ np.swapaxes(points, -1, -2), -1, -2)


def rotation_vector(R: Array) -> Array:
    """Return rotation vectors (..., 3), rad, of rotation matrices (..., 3, 3), by way of unit quaternions."""
    R = np.asarray(R, dtype=np.float64)
    trace = np.trace(R, axis1=-2, axis2=-1)
    diagonal = np.diagonal(R, axis1=-2, axis2=-1)
    # The four candidate quaternions (w, x, y, z); the one with the largest pivot is well conditioned.
    pivots = np.concatenate([trace[..., None], 2.0 * diagonal - trace[..., None]], axis=-1) + 1.0
    d = np.stack(
        [R[..., 2, 1] - R[..., 1, 2], R[..., 0, 2] - R[..., 2, 0], R[..., 1, 0] - R[..., 0, 1]], axis=-1
    )
    s = R + np.swapaxes(R, -1, -2)
    rows = [
        [pivots[..., 0], d[..., 0], d[..., 1], d[..., 2]],
        [d[..., 0], pivots[..., 1], s[..., 0, 1], s[..., 0, 2]],
        [d[..., 1], s[..., 0, 1], pivots[..., 2], s[..., 1, 2]],
        [d[..., 2], s[..., 0, 2], s[..., 1, 2], pivots[..., 3]],
    ]
    candidates = np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
    best = np.argmax(pivots, axis=-1)
    q = np.take_along_axis(candidates, best[..., None, None], axis=-2)[..., 0, :]
    q = q / np.linalg.norm(q, axis=-1, keepdims=True)
    q = np.where(q[..., :1] < 0, -q, q)
    sine = np.linalg.norm(q[..., 1:], axis=-1)
    angle = 2.0 * np.arctan2(sine, q[..., 0])
    scale = np.where(sine < 1e-12, 2.0, angle / np.where(sine < 1e-12, 1.0, sine))
    vector: Array = q[..., 1:] * scale[..., None]
    return vector


def angle_between(R_a: Array, R_b: Array) -> Array:
    """Return the angle (...), rad, of the rotation that turns R_a (..., 3, 3) into R_b (..., 3, 3)."""
    relative = np.swapaxes(R_a, -1, -2) @ R_b
    angle: Array = np.linalg.norm(rotation_vector(relative), axis=-1)
    return angle
