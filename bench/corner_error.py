"""How near the corners of an accepted capture are to the truth, beside `cornerSubPix` at its best window.

Exactly rendered boards with noise of 3 grey levels and a blur of 0.7 px. `cornerSubPix` starts from our
corners, which is as well as it can start; its best window is chosen afterwards, over all frames.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import cv2
import numpy as np

from bench.detection import SPACE
from service.core.errors import ServiceError
from service.core.planning.pose_space import sample_poses
from service.core.vision.camera import Intrinsics
from service.core.vision.detection import detect_target
from service.core.vision.target import Target
from service.core.vision.transforms import Array
from service.simulator.renderer import prepare
from service.simulator.scene import production_scene, true_corners

NOISE_GREY, BLUR_PX = 3.0, 0.7
WINDOWS = (2, 3, 4, 5, 6, 7, 8, 9, 10, 12)
STOP = (3, 60, 1e-4)


def measure_corner_error(camera: Intrinsics, target: Target, count: int, seed: int) -> dict[str, Any]:
    """Return both rms errors, px (root of the mean squared distance), and their ratio."""
    scene = replace(production_scene(camera, target, seed), noise_grey=NOISE_GREY, blur_px=BLUR_PX)
    prepared, rng = prepare(scene), np.random.default_rng(seed)
    poses = sample_poses(SPACE, camera, target, count, seed)
    ours: list[Array] = []
    theirs: Mapping[int, list[Array]] = {window: [] for window in WINDOWS}
    for i in range(count):
        truth = true_corners(scene, poses.pose(i))
        image = prepared.render(poses.pose(i), rng)
        try:
            points = detect_target(image, target).image_points
        except ServiceError:
            continue
        ours.append(points - truth)
        for window in WINDOWS:
            start = points.astype(np.float32).reshape(-1, 1, 2)
            refined = cv2.cornerSubPix(image, start, (window, window), (-1, -1), STOP)
            theirs[window].append(np.asarray(refined, dtype=np.float64).reshape(-1, 2) - truth)
    by_window = {str(window): _rms(errors) for window, errors in theirs.items()}
    best = min(by_window, key=lambda window: by_window[window])
    return {
        "captures": len(ours),
        "of": count,
        "rms_px": _rms(ours),
        "corner_sub_pix_rms_px": by_window[best],
        "best_window": int(best),
        "ratio": _rms(ours) / by_window[best],
        "by_window": by_window,
    }


def _rms(errors: list[Array]) -> float:
    return float(np.sqrt(np.mean(np.sum(np.concatenate(errors) ** 2, axis=1)))) if errors else float("nan")
