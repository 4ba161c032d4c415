"""Rotations and rigid poses, vectorised over leading dimensions. Not here: cameras and projection."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
TINY_RAD = 1e-8
IDENTITY = np.eye(3)
CROSS = np.cross(IDENTITY, IDENTITY[:, None]).reshape(3, 9)  # v @ CROSS is the matrix of v ×, row by row


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
    return np.asarray((v @ CROSS).reshape(*v.shape, 3))


def rotation_matrix(rvec: Array) -> Array:
    """Return rotation matrices (..., 3, 3) of rotation vectors (..., 3), rad (Rodrigues' formula)."""
    rvec = np.asarray(rvec, dtype=np.float64)
    # To rounding, the factors of an angle of almost nothing are their limits.
    angle = np.maximum(np.sqrt(np.einsum("...i,...i->...", rvec, rvec)), TINY_RAD)
    half = np.sin(0.5 * angle) / angle
    K = skew(rvec)
    R = (np.sin(angle) / angle)[..., None, None] * K
    R += (2.0 * half * half)[..., None, None] * (K @ K)
    R += IDENTITY
    return np.asarray(R)


def turn_points(R: Array, points: Array) -> Array:
    """Return points (..., n, 3) after rotations (..., 3, 3), each component in one piece of memory."""
    return np.swapaxes(R @ np.swapaxes(points, -1, -2), -1, -2)


def rotation_quaternion(R: Array) -> Array:
    """Return unit quaternions w x y z (..., 4), w not negative, of rotation matrices (..., 3, 3)."""
    q = _quaternion(R)
    return np.asarray(q / np.sqrt(np.sum(q * q, axis=-1, keepdims=True)))


def rotation_vector(R: Array) -> Array:
    """Return rotation vectors (..., 3), rad, of rotation matrices (..., 3, 3), by way of quaternions."""
    q = _quaternion(R)
    xyz = q[..., 1:]
    sine = np.sqrt(np.sum(xyz * xyz, axis=-1))
    none = sine < 1e-12 * q[..., 0]
    # Of almost no angle the vector is twice the quaternion's of length one, whose w is one.
    angle = np.where(none, 2.0, 2.0 * np.arctan2(sine, q[..., 0]))
    vector: Array = xyz * (angle / np.where(none, q[..., 0], sine))[..., None]
    return vector


def _quaternion(R: Array) -> Array:
    """Return quaternions w x y z (..., 4) of any length, w not negative, of rotations (..., 3, 3)."""
    R = np.asarray(R, dtype=np.float64)
    # All products of two of w, x, y, z, four times; the row of the largest square is well conditioned.
    products = np.empty((*R.shape[:-2], 4, 4))
    products[..., 1:, 1:] = R + R.swapaxes(-1, -2)
    xx, yy, zz = R[..., 0, 0], R[..., 1, 1], R[..., 2, 2]
    products[..., 0, 0], products[..., 1, 1] = 1.0 + xx + yy + zz, 1.0 + xx - yy - zz
    products[..., 2, 2], products[..., 3, 3] = 1.0 - xx + yy - zz, 1.0 - xx - yy + zz
    for i, j, k in ((0, 2, 1), (1, 0, 2), (2, 1, 0)):
        products[..., 0, 1 + i] = products[..., 1 + i, 0] = R[..., j, k] - R[..., k, j]
    best = np.einsum("...ii->...i", products).argmax(axis=-1)
    q = np.take_along_axis(products, best[..., None, None], axis=-2)[..., 0, :]
    return np.where(q[..., :1] < 0, -q, q)


def angle_between(R_a: Array, R_b: Array) -> Array:
    """Return the angle (...), rad, of the rotation that turns R_a (..., 3, 3) into R_b (..., 3, 3)."""
    relative = np.swapaxes(R_a, -1, -2) @ R_b
    angle: Array = np.linalg.norm(rotation_vector(relative), axis=-1)
    return angle
