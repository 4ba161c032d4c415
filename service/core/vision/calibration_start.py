"""Where a solve starts from intrinsics that are assumed: their poses, by homographies.

Closed form, vectorised over views. Not here: a start from the views alone (`blind_start`), the solve itself.
"""

import numpy as np
from numpy.typing import NDArray

from service.core.vision.camera import LENSES, Intrinsics, focal_of_view, parameter_names, unproject
from service.core.vision.normal_equations import Estimate
from service.core.vision.transforms import Array, rotation_matrix, skew
from service.core.vision.view_stack import ViewStack
from service.core.vision.virtual_view import turn_towards

DISTORTION_SHARES = (1.0, 0.9, 0.8, 0.6, 0.4, 0.2)


def nominal_start(nominal: Intrinsics, stack: ViewStack) -> Estimate:
    """Return an estimate at given intrinsics, with as much of their distortion as reaches every corner.

    A nominal that folds inside the picture of the real lens would be a start at which a solve cannot stand.
    """
    for share in DISTORTION_SHARES:
        vector = nominal.vector
        vector[4:] *= share
        rays = unproject(Intrinsics.from_vector(nominal.lens, vector, nominal.image_size), stack.image_points)
        if np.all(np.isfinite(rays)):
            return Estimate(vector, *planar_poses(stack, rays))
    plain = nominal.vector
    plain[4:] = 0.0
    return Estimate(plain, *planar_poses(stack, _plain_rays(nominal.lens, plain, stack)))


def sweep_starts(lens: str, image_size: tuple[int, int], stack: ViewStack) -> list[Estimate]:
    """Return estimates of a few focal lengths without distortion, narrow to wide."""
    starts = []
    for degrees in LENSES[lens].sweep_hfov_deg:
        vector = plain_vector(lens, focal_of_view(lens, image_size[0], degrees), image_size)
        starts.append(Estimate(vector, *planar_poses(stack, _plain_rays(lens, vector, stack))))
    return starts


def _plain_rays(lens: str, vector: Array, stack: ViewStack) -> Array:
    """Return directions (v, n, 3) of the corners through a lens without distortion.

    Where not even that reaches, as through a fisheye of too short a focal length, they are as in a pinhole.
    """
    image = (stack.image_points - vector[2:4]) / vector[:2]
    rays = LENSES[lens].unproject(image, np.zeros(len(vector) - 4))
    return np.where(np.isfinite(rays), rays, np.concatenate([image, np.ones_like(image[..., :1])], axis=-1))


def planar_poses(stack: ViewStack, rays: Array) -> tuple[Array, Array]:
    """Return rotations (v, 3, 3), translations (v, 3) m of directions (v, n, 3), by homographies."""
    towards, ideal = turn_towards(rays)
    rotations, translations = _poses_in_plane(stack, ideal)
    back = np.swapaxes(towards, -1, -2)
    return back @ rotations, (back @ translations[..., None])[..., 0]


def are_shown(lens: str, translations: Array) -> NDArray[np.bool_]:
    """Whether a lens has an image at all of boards' origins (..., 3), m."""
    return LENSES[lens].radius(translations) < np.inf


def _poses_in_plane(stack: ViewStack, ideal: Array) -> tuple[Array, Array]:
    """Return rotations (v, 3, 3), translations (v, 3) m of ideal coordinates (v, n, 2)."""
    centre, scale, board = stack.normalised
    plane = np.concatenate([board, np.ones_like(board[..., :1])], axis=-1) * stack.weights[..., None]
    rows = np.zeros((len(board), 2, board.shape[1], 9))
    rows[:, 0, :, :3] = rows[:, 1, :, 3:6] = plane
    rows[:, 0, :, 6:], rows[:, 1, :, 6:] = -ideal[..., :1] * plane, -ideal[..., 1:] * plane
    H = _with_last_one(rows.reshape(len(board), -1, 9)).reshape(-1, 3, 3)
    length = np.sqrt(np.sum(H[..., :2] ** 2, axis=1)).mean(axis=-1)
    H = H / length[:, None, None]
    H[..., 2] = H[..., 2] * scale[:, None]
    rotations = _orthonormal(H[..., 0], H[..., 1])
    translations = H[..., 2] - np.einsum("vij,vj->vi", rotations[..., :2], centre)
    depths = stack.visible_points @ rotations[:, 2, :, None] + translations[:, None, 2:]
    behind = depths.min(axis=(1, 2)) <= 0
    if np.any(behind):
        # A lens far from the assumed one can bend a view so much that its homography crosses the camera's
        # plane.
        frontal = _frontal_poses(stack, ideal)
        rotations = np.where(behind[:, None, None], frontal[0], rotations)
        translations = np.where(behind[:, None], frontal[1], translations)
    return rotations, translations


def _orthonormal(x: Array, y: Array) -> Array:
    """Return the rotations (v, 3, 3) whose first two columns are near x and y (v, 3), and as near to each.

    The bisectors of two unit vectors are orthogonal whatever their angle.
    """
    x = x / np.sqrt(np.sum(x * x, axis=-1, keepdims=True))
    y = y / np.sqrt(np.sum(y * y, axis=-1, keepdims=True))
    along, across = x + y, x - y
    along /= np.sqrt(2.0 * np.sum(along * along, axis=-1, keepdims=True))
    across /= np.sqrt(2.0 * np.sum(across * across, axis=-1, keepdims=True))
    rotations = np.empty((len(x), 3, 3))
    rotations[..., 0], rotations[..., 1] = x, y = along + across, along - across
    rotations[..., 2] = (skew(x) @ y[..., None])[..., 0]
    return rotations


def _frontal_poses(stack: ViewStack, ideal: Array) -> tuple[Array, Array]:
    """Return rotations (v, 3, 3), translations (v, 3) m of boards parallel to the image, by similarities."""
    w = stack.weights
    board = stack.object_points[..., 0] + 1j * stack.object_points[..., 1]
    image = ideal[..., 0] + 1j * ideal[..., 1]
    middles = [np.sum(w * points, axis=1) / w.sum(axis=1) for points in (board, image)]
    board, image = board - middles[0][:, None], image - middles[1][:, None]
    similarity = np.sum(w * board.conj() * image, axis=1) / np.sum(w * np.abs(board) ** 2, axis=1)
    depth = 1.0 / np.maximum(np.abs(similarity), 1e-9)
    rotations = rotation_matrix(np.angle(similarity)[:, None] * np.array([0.0, 0.0, 1.0]))
    origin = (middles[1] - similarity * middles[0]) * depth
    return rotations, np.stack([origin.real, origin.imag, depth], axis=-1)


def plain_vector(lens: str, focal: float, image_size: tuple[int, int]) -> Array:
    """Return parameters with the centre in the middle of the image and no distortion."""
    vector = np.zeros(len(parameter_names(lens)))
    vector[:4] = focal, focal, (image_size[0] - 1) / 2.0, (image_size[1] - 1) / 2.0
    return vector


def _with_last_one(rows: Array) -> Array:
    """Return the vectors (v, d) with a last component of one that systems (v, m, d) map closest to zero."""
    A = np.swapaxes(rows, -1, -2) @ rows
    others = A[..., :-1, :-1]
    others += 1e-15 * np.trace(others, axis1=-2, axis2=-1)[..., None, None] * np.eye(others.shape[-1])
    solution = np.linalg.solve(others, -A[..., :-1, -1:])[..., 0]
    return np.concatenate([solution, np.ones_like(solution[..., :1])], axis=-1)
