"""Cameras and views that the tests of the vision core share: known truth, explicit seeds."""

import numpy as np

from service.core.vision.camera import Intrinsics, project
from service.core.vision.target import Chessboard
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


def board_poses(camera: Intrinsics, count: int, seed: int) -> tuple[Array, Array]:
    """Return random rotations (count, 3, 3), translations (count, 3) m that show the whole board."""
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
