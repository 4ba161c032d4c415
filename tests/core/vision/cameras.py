"""Cameras and views that the tests of the vision core share: known truth, explicit seeds."""

import numpy as np

from service.core.vision.camera import Intrinsics, project, reach_share, unproject
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Array, rotation_matrix
from service.core.vision.view_stack import View

BOARD = Chessboard(9, 6, 0.025)
LENS1 = Intrinsics.from_parameters(
    "pinhole5",
    {"fx": 1350.1, "fy": 1352.1, "cx": 657.6, "cy": 383.8, "k1": -0.3774, "k2": 0.2425},
    (1280, 800),
)
WIDE = Intrinsics.from_vector(
    "pinhole5",
    np.array([915.7, 916.2, 955.0, 610.0, -0.1954, 0.0246, 3e-4, -2e-4, -0.0011]),
    (1920, 1208),
)
# 120 degrees across, 140 to the image corners: close to equidistant, as lenses of this width are.
RATIONAL = Intrinsics.from_vector(
    "rational8",
    np.array([917.3, 916.4, 955.0, 610.0, 0.74, 0.093, 3e-4, -2e-4, 0.001, 1.067, 0.25, 0.0098]),
    (1920, 1208),
)
FISHEYE = Intrinsics.from_vector(
    "kannala_brandt4",
    np.array([917.3, 916.4, 955.0, 610.0, -0.021, 0.0072, -0.0041, 0.0008]),
    (1920, 1208),
)
# The image corners are 200 degrees apart.
ALL_ROUND = Intrinsics.from_vector(
    "kannala_brandt4",
    np.array([431.2, 430.6, 645.1, 395.7, 0.011, -0.008, 0.0013, -0.0002]),
    (1280, 800),
)


def board_poses(camera: Intrinsics, count: int, seed: int) -> tuple[Array, Array]:
    """Return random rotations (count, 3, 3), translations (count, 3) m that show the whole board."""
    if camera.lens != "pinhole5":
        return _poses_around(camera, count, seed)
    rng = np.random.default_rng(seed)
    near, far = (0.3, 0.7) if camera is LENS1 else (0.15, 0.5)
    rotations: list[Array] = []
    translations: list[Array] = []
    last = np.array(camera.image_size) - 1.0
    while len(rotations) < count:
        R = rotation_matrix(rng.uniform(-0.7, 0.7, 3))
        depth = rng.uniform(near, far)
        middle = (rng.uniform(0, 1, 2) * last - camera.vector[2:4]) / camera.vector[:2]
        t = np.array([*(middle * depth), depth]) - R @ BOARD.centre
        pixels = project(camera, R, t, BOARD.object_points)
        if np.all((pixels > 5) & (pixels < last - 5)) and _is_unfolded(pixels):
            rotations.append(R)
            translations.append(t)
    return np.array(rotations), np.array(translations)


def _poses_around(camera: Intrinsics, count: int, seed: int) -> tuple[Array, Array]:
    """Return poses of boards that face the camera from wherever it looks, tilted at random."""
    rng = np.random.default_rng(seed)
    rotations: list[Array] = []
    translations: list[Array] = []
    last = np.array(camera.image_size) - 1.0
    while len(rotations) < count:
        sight = unproject(camera, rng.uniform(0, 1, 2) * last)
        sight /= np.linalg.norm(sight)
        across = np.array([-sight[1], sight[0], 0.0])
        angle = np.arctan2(np.linalg.norm(across), sight[2])
        facing = rotation_matrix(across * (angle / max(np.linalg.norm(across), 1e-9)))
        R = rotation_matrix(rng.uniform(-0.7, 0.7, 3)) @ facing
        t = sight * rng.uniform(0.12, 0.4) - R @ BOARD.centre
        points = BOARD.object_points @ R.T + t
        pixels = project(camera, R, t, BOARD.object_points)
        inside = np.all((pixels > 5) & (pixels < last - 5)) and np.all(reach_share(camera, points) < 0.98)
        if inside and np.all(points @ R[:, 2] > 0.02):
            rotations.append(R)
            translations.append(t)
    return np.array(rotations), np.array(translations)


def views_of(camera: Intrinsics, count: int, seed: int, sigma_px: float = 0.1) -> list[View]:
    """Return views with normal noise of the corners."""
    rotations, translations = board_poses(camera, count, seed)
    rng = np.random.default_rng([seed, 1])
    pixels = project(camera, rotations, translations, BOARD.object_points)
    noisy = pixels + sigma_px * rng.standard_normal(pixels.shape)
    return [View(BOARD.object_points, corners, f"view {i}") for i, corners in enumerate(noisy)]


def _is_unfolded(pixels: Array) -> bool:
    """Whether neighbours along both directions of the board keep their order, as before a fold."""
    grid = pixels.reshape(BOARD.rows, BOARD.columns, 2)
    across, down = np.diff(grid, axis=1)[:-1], np.diff(grid, axis=0)[:, :-1]
    return bool(np.all(across[..., 0] * down[..., 1] - across[..., 1] * down[..., 0] > 50.0))
