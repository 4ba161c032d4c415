"""The paper's two cameras, and poses to look at from them."""

import numpy as np

from service.core.vision.camera import Intrinsics, unproject
from service.core.vision.target import Target
from service.core.vision.target_chessboard import parse_chessboard
from service.core.vision.transforms import Pose, compose, rotation_matrix, rotation_vector

LENS_1 = Intrinsics.from_parameters(
    "pinhole5",
    {"fx": 1350.1, "fy": 1352.1, "cx": 657.6, "cy": 383.8, "k1": -0.3774, "k2": 0.2425},
    (1280, 800),
)
LENS_2 = Intrinsics.from_parameters(
    "pinhole5",
    {"fx": 972.5, "fy": 974.4, "cx": 954.9, "cy": 644.4, "k1": -0.3454, "k2": 0.1398},
    (1920, 1208),
)
# 120 degrees across; its image corners look 72 degrees aside.
FISHEYE = Intrinsics.from_parameters(
    "kannala_brandt4",
    {
        "fx": 917.3,
        "fy": 916.4,
        "cx": 955.0,
        "cy": 610.0,
        "k1": -0.021,
        "k2": 0.0072,
        "k3": -0.0041,
        "k4": 8e-4,
    },
    (1920, 1208),
)
# Its image corners look behind the camera.
ALL_ROUND = Intrinsics.from_parameters(
    "kannala_brandt4", {"fx": 80.0, "fy": 80.0, "cx": 128.0, "cy": 80.0, "k1": 0.01}, (256, 160)
)
BOARD = parse_chessboard("chessboard:9x6:25mm")

# Pitch, yaw, roll, degrees; where the target's centre lies, in shares of the picture's size; its depth, m.
# Near and far, upright and on its side, tilted to 45 degrees, in the middle and towards every corner.
VARIED = (
    (0, 0, 0, 0.50, 0.50, 0.34),
    (20, -10, 5, 0.47, 0.52, 0.37),
    (40, 5, -10, 0.55, 0.47, 0.40),
    (-40, 10, 20, 0.35, 0.60, 0.50),
    (10, 45, -30, 0.70, 0.40, 0.55),
    (-10, -45, 40, 0.25, 0.45, 0.60),
    (30, 30, 10, 0.72, 0.65, 0.65),
    (-30, -30, -20, 0.25, 0.70, 0.75),
    (35, -35, 90, 0.85, 0.25, 0.80),
    (5, 5, 180, 0.82, 0.80, 0.90),
    (-45, 0, -45, 0.15, 0.20, 0.95),
    (0, 40, 15, 0.86, 0.16, 1.00),
)


def centred_pose(target: Target, degrees: tuple[float, ...], centre: tuple[float, ...]) -> Pose:
    """Return the pose of a target turned by pitch, yaw and roll with its centre at a point, m."""
    turns = np.diag(np.radians(degrees))
    R = rotation_matrix(turns[0]) @ rotation_matrix(turns[1]) @ rotation_matrix(turns[2])
    return Pose(rotation_vector(R), np.array(centre) - R @ target.centre)


def varied_poses(camera: Intrinsics) -> list[Pose]:
    """Return a dozen poses at which a camera sees the 9x6 board whole.

    Of a fisheye depth and turn are along the line of sight: far aside, a board that faces along the axis
    shows its edge.
    """
    poses = []
    for *degrees, share_x, share_y, depth in VARIED:
        ray = unproject(camera, np.array([share_x, share_y]) * camera.image_size)
        if camera.lens == "pinhole5":
            poses.append(centred_pose(BOARD, tuple(degrees), tuple(ray / ray[2] * depth)))
            continue
        aside = np.cross([0.0, 0.0, 1.0], ray)
        turn = Pose(aside / np.linalg.norm(aside) * np.arccos(ray[2]), np.zeros(3))
        poses.append(compose(turn, centred_pose(BOARD, tuple(degrees), (0.0, 0.0, depth))))
    return poses
