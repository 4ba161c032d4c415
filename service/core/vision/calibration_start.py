"""Where a solve starts: poses from assumed intrinsics, and intrinsics from nothing but the views.

The blind start uses the radial alignment constraint (Tsai 1987; Scaramuzza, Martinelli, Siegwart 2006): with
the centre assumed in the middle of the image, the direction of a corner from the centre depends neither on
the focal length nor on the radial distortion, so a wide lens is no harder than a narrow one. Closed form,
vectorised over views. Not here: the solve itself.
"""

import numpy as np
from numpy.typing import NDArray

from service.core.vision.camera import LENSES, Intrinsics, focal_of_view, parameter_names, unproject
from service.core.vision.normal_equations import Estimate
from service.core.vision.transforms import Array, rotation_matrix, skew, turn_points
from service.core.vision.view_stack import ViewStack
from service.core.vision.virtual_view import turn_towards

DISTORTION_SHARES = (1.0, 0.9, 0.8, 0.6, 0.4, 0.2)


def nominal_start(nominal: Intrinsics, stack: ViewStack) -> Estimate:
    """Return an estimate at given intrinsics, with as much of their distortion as reaches every corner.

    A nominal that folds inside the picture of the real lens would be a start at which a solve cannot stand.
    """
    for share in DISTORTION_SHARES:
        vector = nominal.vector * np.r_[np.ones(4), np.full(len(nominal.dist_coeffs), share)]
        rays = unproject(Intrinsics.from_vector(nominal.lens, vector, nominal.image_size), stack.image_points)
        if np.all(np.isfinite(rays)):
            return Estimate(vector, *planar_poses(stack, rays))
    plain = np.r_[nominal.vector[:4], np.zeros(len(nominal.dist_coeffs))]
    return Estimate(plain, *planar_poses(stack, _plain_rays(nominal.lens, plain, stack)))


def sweep_starts(lens: str, image_size: tuple[int, int], stack: ViewStack) -> list[Estimate]:
    """Return estimates of a few focal lengths without distortion, narrow to wide."""
    starts = []
    for degrees in LENSES[lens].sweep_hfov_deg:
        vector = _plain_vector(lens, focal_of_view(lens, image_size[0], degrees), image_size)
        starts.append(Estimate(vector, *planar_poses(stack, _plain_rays(lens, vector, stack))))
    return starts


def _plain_rays(lens: str, vector: Array, stack: ViewStack) -> Array:
    """Return directions (v, n, 3) of the corners through a lens without distortion.

    Where not even that reaches, as through a fisheye of too short a focal length, they are as in a pinhole.
    """
    image = (stack.image_points - vector[2:4]) / vector[:2]
    rays = LENSES[lens].unproject(image, np.zeros(len(vector) - 4))
    return np.where(np.isfinite(rays), rays, np.concatenate([image, np.ones_like(image[..., :1])], axis=-1))


def blind_start(lens: str, image_size: tuple[int, int], stack: ViewStack) -> Estimate | None:
    """Return an estimate from the views alone, without distortion; None where they give no focal length.

    The poses are those of the radial alignment, in which distortion has no part.
    """
    vector = _plain_vector(lens, 1.0, image_size)
    from_centre = stack.image_points - vector[2:4]
    in_plane = _radial_alignment(stack, from_centre)
    tilted = _tilted(in_plane[0])
    focal, translations, errors = _depths_and_focal(stack, from_centre, tilted, in_plane[1], joint=False)
    errors = np.where((focal > 0) & _are_shown(lens, translations), errors, np.inf)
    better = np.where(errors[0] <= errors[1], 0, 1)
    rotations = tilted[better, np.arange(len(better))]
    focal, translations, _ = _depths_and_focal(stack, from_centre, rotations, in_plane[1], joint=True)
    if not (np.isfinite(focal).all() and focal[0] > 0 and np.all(_are_shown(lens, translations))):
        return None
    vector[:2] = focal[0]
    return Estimate(vector, rotations, translations)


def planar_poses(stack: ViewStack, rays: Array) -> tuple[Array, Array]:
    """Return rotations (v, 3, 3), translations (v, 3) m of directions (v, n, 3), by homographies."""
    towards, ideal = turn_towards(rays)
    rotations, translations = _poses_in_plane(stack, ideal)
    back = np.swapaxes(towards, -1, -2)
    return back @ rotations, (back @ translations[..., None])[..., 0]


def _are_shown(lens: str, translations: Array) -> NDArray[np.bool_]:
    """Whether a lens has an image at all of boards' origins (..., 3), m."""
    return LENSES[lens].radius(translations) < np.inf


def _poses_in_plane(stack: ViewStack, ideal: Array) -> tuple[Array, Array]:
    """Return rotations (v, 3, 3), translations (v, 3) m of ideal coordinates (v, n, 2)."""
    centre, scale, board = _normalised_board(stack)
    one, zero = np.ones_like(board[..., :1]), np.zeros_like(board)
    plane = np.concatenate([board, one], axis=-1)
    nil = np.concatenate([zero, 0.0 * one], axis=-1)
    rows_x = np.concatenate([plane, nil, -ideal[..., :1] * plane], axis=-1)
    rows_y = np.concatenate([nil, plane, -ideal[..., 1:] * plane], axis=-1)
    rows = np.concatenate([rows_x, rows_y], axis=1) * np.concatenate([stack.weights] * 2, axis=1)[..., None]
    H = _null_vectors(rows).reshape(-1, 3, 3)
    H = H * np.where(H[:, 2:, 2:] < 0, -1.0, 1.0)
    length = (np.linalg.norm(H[..., 0], axis=-1) + np.linalg.norm(H[..., 1], axis=-1)) / 2.0
    H = H / length[:, None, None]
    H[..., 2] = H[..., 2] * scale[:, None]
    columns = np.concatenate([H[..., :2], skew(H[..., 0]) @ H[..., 1:2]], axis=-1)
    U, _, Vt = np.linalg.svd(columns)
    rotations = U @ Vt
    rotations = rotations * np.sign(np.linalg.det(rotations))[:, None, None]
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


def _plain_vector(lens: str, focal: float, image_size: tuple[int, int]) -> Array:
    """Return parameters with the centre in the middle of the image and no distortion."""
    vector = np.zeros(len(parameter_names(lens)))
    vector[:4] = focal, focal, (image_size[0] - 1) / 2.0, (image_size[1] - 1) / 2.0
    return vector


def _normalised_board(stack: ViewStack) -> tuple[Array, Array, Array]:
    """Return the boards' centres (v, 2) m, sizes (v,) m, and corners (v, n, 2) in those terms."""
    plane = stack.object_points[..., :2]
    centre = plane.mean(axis=1)
    scale = np.sqrt(np.mean(np.sum((plane - centre[:, None]) ** 2, axis=-1), axis=1))
    return centre, scale, (plane - centre[:, None]) / scale[:, None, None]


def _null_vectors(rows: Array) -> Array:
    """Return the unit vectors (v, d) that systems (v, m, d) map closest to zero."""
    _, vectors = np.linalg.eigh(np.swapaxes(rows, -1, -2) @ rows)
    return np.ascontiguousarray(vectors[..., 0])


def _radial_alignment(stack: ViewStack, from_centre: Array) -> tuple[Array, Array]:
    """Return the upper left 2x2 of the rotations (v, 2, 2) and the translations across the axis (v, 2), m.

    A corner and its image lie on one ray from the centre: v (r11 X + r12 Y + tx) = u (r21 X + r22 Y + ty).
    """
    centre, size, board = _normalised_board(stack)
    plane = np.concatenate([board, np.ones_like(board[..., :1])], axis=-1)
    unit = from_centre / np.abs(from_centre).max()
    rows = np.concatenate([unit[..., 1:] * plane, -unit[..., :1] * plane], axis=-1)
    M = _null_vectors(rows * stack.weights[..., None]).reshape(-1, 2, 3)
    # The larger singular value of an upper left block of a plane's rotation is one: an unshortened direction
    # exists.
    M = M / np.linalg.norm(M[..., :2], ord=2, axis=(-2, -1))[:, None, None]
    along = np.sum((plane @ np.swapaxes(M, -1, -2)) * unit * stack.weights[..., None], axis=(1, 2))
    M = M * np.where(along < 0, -1.0, 1.0)[:, None, None]
    across = M[..., 2] * size[:, None] - np.einsum("vij,vj->vi", M[..., :2], centre)
    return M[..., :2], across


def _tilted(block: Array) -> Array:
    """Return the two rotations (2, v, 3, 3) of an upper left 2x2 (v, 2, 2): tilted to either side."""
    lower = np.sqrt(np.maximum(1.0 - np.sum(block * block, axis=1), 0.0))
    product = -np.sum(block[..., 0] * block[..., 1], axis=1)
    lower[:, 1] *= np.where(product < 0, -1.0, 1.0)
    first_two = np.stack([np.concatenate([block, side[:, None]], axis=1) for side in (lower, -lower)])
    third = skew(first_two[..., 0]) @ first_two[..., 1:]
    U, _, Vt = np.linalg.svd(np.concatenate([first_two, third], axis=-1))
    rotations: Array = U @ Vt
    return rotations


def _depths_and_focal(
    stack: ViewStack, from_centre: Array, rotations: Array, across: Array, joint: bool
) -> tuple[Array, Array, Array]:
    """Return the focal length of all views (1,) or of each (..., v) px, translations (..., v, 3) m, errors.

    rotations (..., v, 3, 3); across: translations across the axis (v, 2), m; errors: squared ones (..., v).
    With ρ a corner's distance from the centre and d its distance from the axis, (a + b ρ²) d − ρ tz = ρ q,
    where q is the corner's own depth against the board's origin; linear in a = f, b and the depths.
    """
    camera = turn_points(rotations, stack.object_points)
    unit = 1.0 / np.abs(from_centre).max()
    rho = np.linalg.norm(from_centre, axis=-1) * unit
    d = np.linalg.norm(camera[..., :2] + across[:, None], axis=-1)
    w = stack.weights
    shared = np.stack([d, d * rho**2], axis=-1) * w[..., None]
    own, right = (-rho * w)[..., None], (rho * camera[..., 2]) * w
    # The depth of each view is eliminated, as the poses are in the solve.
    weight = np.sum(own * own, axis=1)
    shared_free = shared - own * (np.sum(own * shared, axis=-2) / weight)[..., None, :]
    right_free = right - own[..., 0] * (np.sum(own[..., 0] * right, axis=-1) / weight[:, 0])[..., None]
    A = np.swapaxes(shared_free, -1, -2) @ shared_free
    b = np.swapaxes(shared_free, -1, -2) @ right_free[..., None]
    if joint:
        A, b = A.sum(axis=0, keepdims=True), b.sum(axis=0, keepdims=True)
    solution = np.linalg.solve(A + 1e-15 * np.trace(A, axis1=-2, axis2=-1)[..., None, None] * np.eye(2), b)
    error = right_free - (shared_free @ solution)[..., 0]
    depths = np.sum(own[..., 0] * (right - (shared @ solution)[..., 0]), axis=-1) / weight[:, 0]
    translations = np.empty((*depths.shape, 3))
    translations[..., :2], translations[..., 2] = across, depths
    return solution[..., 0, 0] / unit, translations, np.sum(error * error, axis=-1)
