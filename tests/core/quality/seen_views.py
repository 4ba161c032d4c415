"""Detections as a good camera gives them, computed and not rendered, for the tests of the gates."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from service.core.planning.plan import plan_pose_set
from service.core.planning.pose_space import PoseSpace
from service.core.quality.evidence import Expectation, NamedDetection
from service.core.quality.gates import Measurement
from service.core.quality.verdict import Judged, calibrate_and_judge
from service.core.vision.camera import Intrinsics, project
from service.core.vision.detection import Detection
from service.core.vision.sharpness import Sharpness
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Array, Pose

NOMINAL = Intrinsics.from_parameters(
    "pinhole5",
    {"fx": 1350.1, "fy": 1352.1, "cx": 657.6, "cy": 383.8, "k1": -0.3774, "k2": 0.2425},
    (1280, 800),
)
CAMERA = Intrinsics.from_parameters(
    "pinhole5",
    {"fx": 1354.1, "fy": 1356.1, "cx": 655.2, "cy": 386.1, "k1": -0.379, "k2": 0.248},
    (1280, 800),
)
BOARD = Chessboard(9, 6, 0.025)
SHARP = Sharpness(2.0, (2.0, 2.0, 2.0, 2.0), 2.0)
POSES = plan_pose_set(NOMINAL, BOARD, PoseSpace(), 12, seed=4, candidates=600).poses


def see(image_points: Array, name: str, image_size: tuple[int, int] = (1280, 800)) -> NamedDetection:
    """Return a detection of all corners, sharp and bright."""
    return NamedDetection(
        name,
        Detection(image_points, np.arange(len(image_points)), image_size, SHARP, 0.9, 150.0),
        sha256=name,
    )


def see_poses(
    poses: Sequence[Pose] = POSES,
    camera: Intrinsics = CAMERA,
    noise_px: float = 0.1,
    seed: int = 1,
    heights: Array | None = None,
) -> list[NamedDetection]:
    """Return what a camera sees at poses; heights (n,), m, bend the board."""
    rng = np.random.default_rng(seed)
    board = BOARD.object_points
    if heights is not None:
        board = board + np.outer(heights, [0.0, 0.0, 1.0])
    return [
        see(
            project(camera, pose.rotation, pose.tvec, board) + rng.normal(0, noise_px, (len(board), 2)),
            f"{i:02d}.png",
        )
        for i, pose in enumerate(poses)
    ]


def with_sharpness(view: NamedDetection, sharpness: Sharpness) -> NamedDetection:
    """Return the view with other edges."""
    return replace(view, detection=replace(view.detection, sharpness=sharpness))


def moved(view: NamedDetection, corner: int, by_px: float) -> NamedDetection:
    """Return the view with one corner moved along both axes."""
    points = view.detection.image_points.copy()
    points[corner] += by_px
    return replace(view, detection=replace(view.detection, image_points=points))


def judge(views: Sequence[NamedDetection], expectation: Expectation | None = None) -> Judged:
    """Calibrate and judge with the board of this module."""
    return calibrate_and_judge(views, BOARD, expectation=expectation)


def measured(judged: Judged, name: str) -> Measurement:
    """Return the measurement of a name."""
    (found,) = [one for one in judged.measurements if one.name == name]
    return found
