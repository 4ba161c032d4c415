"""Detection for a capture on rendered pictures: found, exact, in order, fast; and refused where it must be.

Whole boards at poses of a plant's pose space, any way up, under a near-infrared lamp with blur and noise; the
same declared too small; boards that the picture's border cuts; pictures of the background alone. OpenCV's
finders work on the same pictures, one after the other; their order of corners is not judged, only their
accuracy in ours.
"""

import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.errors import ServiceError, WrongTarget
from service.core.planning.pose_space import PoseSpace, sample_poses
from service.core.vision.camera import Intrinsics
from service.core.vision.detection import detect_target
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Array, Pose
from service.simulator.renderer import PreparedScene, prepare
from service.simulator.scene import production_scene, true_corners

LENS1 = Intrinsics.from_parameters(
    "pinhole5",
    {"fx": 1350.1, "fy": 1352.1, "cx": 657.6, "cy": 383.8, "k1": -0.3774, "k2": 0.2425},
    (1280, 800),
)
TARGET = Chessboard(9, 6, 0.025)
TOO_SMALL = Chessboard(8, 6, 0.025)
SPACE = PoseSpace(roll_deg=(-180.0, 180.0))
SEED = 7
WRONG_PX = 2.0

Image = NDArray[np.uint8]
Finder = Callable[[Image], Array | None]


def run(quick: bool) -> dict[str, Any]:
    """Return shares, errors and times of ours and OpenCV's finders, and how often ours refuses rightly."""
    prepared = prepare(production_scene(LENS1, TARGET, seed=SEED))
    rng = np.random.default_rng(SEED)
    poses = sample_poses(SPACE, LENS1, TARGET, 12 if quick else 120, SEED)
    whole = [poses.pose(i) for i in range(len(poses))]
    images = [prepared.render(pose, rng) for pose in whole]
    truths = [true_corners(prepared.scene, pose) for pose in whole]
    cut = [prepared.render(cut_off(pose), rng) for pose in whole[::3]]
    nothing = Pose(np.zeros(3), np.array([50.0, 0.0, 1.0]))
    empty = [_background(prepared, seed).render(nothing, rng) for seed in range(2 if quick else 12)]
    return {
        "ours": judge(_ours, images, truths),
        "opencv": judge(opencv_corners, images, truths),
        "opencv_sb": judge(_opencv_sb, images[: len(images) // 3], truths),
        "wrong_target_share": float(np.mean([_names_the_board(image) for image in images])),
        "cut_off": _judge_refusals(cut),
        "empty": _judge_refusals(empty),
        "seeds": [SEED],
    }


def table(result: Mapping[str, Any]) -> str:
    """Return the result as text."""
    columns = ("found", "wrong", "mean_px", "max_px", "p50_ms", "p95_ms")
    lines = [" ".join([f"{'finder':<10}", *(f"{column:>8}" for column in columns)])]
    lines += [
        " ".join([f"{name:<10}", *(f"{result[name][column]:>8.3f}" for column in columns)])
        for name in ("ours", "opencv", "opencv_sb")
    ]
    for name in ("cut_off", "empty"):
        row = result[name]
        lines.append(
            f"{name}: refused {row['refused']:.3f}, p50 {row['p50_ms']:.1f}, max {row['max_ms']:.1f} ms"
        )
    lines.append(f"declared too small: the right board named {result['wrong_target_share']:.3f}")
    return "\n".join(lines)


def judge(find: Finder, images: list[Image], truths: list[Array]) -> dict[str, float]:
    """Return the shares found and read wrongly, the errors and the times of a finder on pictures."""
    times, errors, wrong = [], [], 0
    for image, truth in zip(images, truths, strict=False):
        began = time.perf_counter()
        points = find(image)
        times.append(time.perf_counter() - began)
        if points is None:
            continue
        error = np.linalg.norm(points - truth, axis=1)
        if error.mean() > WRONG_PX:
            wrong += 1
        else:
            errors.append(error)
    every = np.concatenate(errors) if errors else np.array([np.nan])
    p50, p95 = np.percentile(times, (50, 95)) * 1e3
    return {
        "found": len(errors) / len(times),
        "wrong": wrong / len(times),
        "mean_px": float(every.mean()),
        "max_px": float(every.max()),
        "p50_ms": float(p50),
        "p95_ms": float(p95),
    }


def _judge_refusals(images: list[Image]) -> dict[str, float]:
    times, refused = [], 0
    for image in images:
        began = time.perf_counter()
        refused += _ours(image) is None
        times.append(time.perf_counter() - began)
    milliseconds = np.array(times) * 1e3
    return {
        "refused": refused / len(images),
        "p50_ms": float(np.median(milliseconds)),
        "max_ms": float(milliseconds.max()),
    }


def _ours(image: Image) -> Array | None:
    try:
        return detect_target(image, TARGET).image_points
    except ServiceError:
        return None


def _names_the_board(image: Image) -> bool:
    try:
        detect_target(image, TOO_SMALL)
    except WrongTarget as error:
        return error.facts["found_columns"] == TARGET.columns and error.facts["found_rows"] == TARGET.rows
    except ServiceError:
        return False
    return False


def opencv_corners(image: Image) -> Array | None:
    """Return the corners (n, 2) px in our order as OpenCV finds them, or None."""
    flags = cv2.CALIB_CB_ADAPTIVE_THRESH | cv2.CALIB_CB_NORMALIZE_IMAGE | cv2.CALIB_CB_FAST_CHECK
    found, corners = cv2.findChessboardCorners(image, (TARGET.columns, TARGET.rows), flags=flags)
    if not found:
        return None
    # The widest window that no square of these poses is too small for.
    refined = cv2.cornerSubPix(image, corners, (4, 4), (-1, -1), (3, 40, 1e-3)).reshape(-1, 2)
    return _dark_first(image, np.asarray(refined, dtype=np.float64))


def _opencv_sb(image: Image) -> Array | None:
    found, corners = cv2.findChessboardCornersSB(
        image, (TARGET.columns, TARGET.rows), flags=cv2.CALIB_CB_ACCURACY
    )
    return _dark_first(image, np.asarray(corners, dtype=np.float64).reshape(-1, 2)) if found else None


def _dark_first(image: Image, corners: Array) -> Array:
    """Turn OpenCV's order by 180 degrees where its first square is not dark."""
    grid = corners.reshape(TARGET.rows, TARGET.columns, 2)
    spots = [grid[:2, :2].mean(axis=(0, 1)), grid[:2, 1:3].mean(axis=(0, 1))]
    first, second = (int(image[int(y), int(x)]) for x, y in spots)
    return corners if first < second else corners[::-1]


def cut_off(pose: Pose, camera: Intrinsics = LENS1) -> Pose:
    """Move a board sideways until part of its corners is beyond the border."""
    width, _ = camera.image_size
    step = np.array([0.1 * TARGET.square_m * np.sign(pose.tvec[0]), 0.0, 0.0])
    scene = production_scene(camera, TARGET)
    for _ in range(1000):
        x = true_corners(scene, pose)[:, 0]
        if np.nanmin(x) < -5.0 or np.nanmax(x) > width + 4.0:
            break
        pose = Pose(pose.rvec, pose.tvec + step)
    return pose


def _background(prepared: PreparedScene, seed: int) -> PreparedScene:
    return prepare(replace(prepared.scene, seed=seed))
