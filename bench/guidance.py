"""Live guidance, frame in to state out: times, what is found, hard conditions, and OpenCV on the same frames.

Exact pictures of a plant's pose space, the board any way up: whole, cut by the border, absent (backgrounds,
noise); a thousand random poses and as many empty frames; named hard conditions; a mixed set that OpenCV's
finders see as well; corners of captures against the truth. One thread, times of the wall and of the CPU.
Every frame is looked for from scratch: there is no tracking, and its keys are those of `first`.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from bench.corner_error import measure_corner_error
from bench.detection import LENS1, SPACE, TARGET, WRONG_PX, cut_off, judge, opencv_corners
from bench.frame_to_state import Image, Look, guide
from bench.guidance_opencv import compare, mix
from bench.guidance_rates import rate_empty_frames, rate_random_poses
from bench.guidance_words import describe
from bench.hard_frames import measure_conditions
from bench.timing import spread, time_each
from service.core.planning.pose_space import sample_poses
from service.core.vision.camera import Intrinsics
from service.core.vision.live_detection import LiveDetection, LiveWorkspace, detect_live
from service.core.vision.transforms import Array, Pose
from service.simulator.background import paint_background
from service.simulator.live_renderer import LiveRenderer
from service.simulator.renderer import PreparedScene, prepare
from service.simulator.scene import production_scene, true_corners

LENS2 = Intrinsics.from_parameters(
    "pinhole5",
    {"fx": 972.5, "fy": 974.4, "cx": 954.9, "cy": 644.4, "k1": -0.3454, "k2": 0.1398},
    (1920, 1208),
)
SEED = 11
QUICK_POSES, POSES = 12, 200
NOWHERE = Pose(np.zeros(3), np.array([50.0, 0.0, 1.0]))
NOISE_SIGMAS_PX = (0.6, 1.0, 1.5, 2.0, 3.0, 5.0)
JPEG_QUALITY = 80
NEGATIVES = Path(__file__).parents[2] / "shared" / "data" / "neg_udacity_road"


@dataclass(frozen=True)
class Effort:
    """How much is tried: boards of each kind, random poses and empty frames, frames of each
    condition, mixed frames, captures."""

    poses: int
    many: int
    each: int
    mixed: int
    captures: int


QUICK = Effort(QUICK_POSES, 16, 1, 10, 6)
FULL = Effort(POSES, 1000, 40, 100, 100)
FULL_LARGE = replace(FULL, many=300, each=20, mixed=60)


def run(quick: bool) -> dict[str, Any]:
    """Return both image sizes' figures under `1280x800` and `1920x1208`."""
    efforts = (QUICK, QUICK) if quick else (FULL, FULL_LARGE)
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)
    try:
        sizes = {
            _size(camera): measure(camera, effort)
            for camera, effort in zip((LENS1, LENS2), efforts, strict=True)
        }
    finally:
        cv2.setNumThreads(threads)
    return {**sizes, "tracking": "none: every frame is looked for from scratch", "seeds": [SEED]}


def table(result: Mapping[str, Any]) -> str:
    """Return the result as text."""
    columns = ("p50_ms", "p95_ms", "p99_ms", "max_ms", "cpu_p50_ms", "cpu_p95_ms", "cpu_p99_ms", "cpu_max_ms")
    lines = [" ".join([f"{'frame':<24}", *(f"{column:>10}" for column in columns)])]
    for size in (_size(camera) for camera in (LENS1, LENS2)):
        row = result[size]
        for name in ("first", "partial", "absent"):
            times = (f"{row[name][column]:>10.1f}" for column in columns)
            lines.append(" ".join([f"{size + ' ' + name:<24}", *times]))
        lines += [f"{size} {words}" for words in describe(row)]
    lines.append(f"tracking: {result['tracking']}")
    return "\n".join(lines)


def measure(camera: Intrinsics, effort: Effort) -> dict[str, Any]:
    """Return the figures of one camera; of boards cut off and frames without one a quarter as many."""
    count = effort.poses
    prepared = prepare(production_scene(camera, TARGET, seed=SEED))
    sampled = sample_poses(SPACE, camera, TARGET, count, SEED)
    poses = [sampled.pose(i) for i in range(len(sampled))]
    rng = np.random.default_rng(SEED)
    whole = [prepared.render(pose, rng) for pose in poses]
    truths = [true_corners(prepared.scene, pose) for pose in poses]
    cut = [prepared.render(cut_off(pose, camera), rng) for pose in poses[::4]]
    nothing = _frames_without_a_board(prepared, count // 4, rng)
    frame_to_state = guide(camera, TARGET, poses)
    frame_to_state(whole[0])  # the first frame of all allocates the buffers
    kinds = {"first": whole, "partial": cut, "absent": nothing}
    seen = {name: time_each(frame_to_state, images) for name, images in kinds.items()}
    times = {name: spread(timed) for name, (timed, _) in seen.items()}
    theirs = judge(opencv_corners, whole, truths)
    return {
        "tracking": times["first"],
        **times,
        "max_ms": max(row["max_ms"] for row in times.values()),
        "decode_ms": _decode_ms(whole),
        "opencv_p95_ms": theirs["p95_ms"],
        "speedup_p95": theirs["p95_ms"] / times["first"]["p95_ms"],
        "detection_rate": judge_found(seen["first"][1], truths)["rate"],
        "opencv_detection_rate": theirs["found"],
        **_detection_alone(kinds, truths),
        "opencv_absent_p95_ms": spread(time_each(opencv_corners, nothing[: -len(NOISE_SIGMAS_PX) : 3])[0])[
            "p95_ms"
        ],
        "false_alarms": sum(detection.kind != "absent" for detection in seen["absent"][1]) / len(nothing),
        "called_whole_though_cut": sum(found.kind == "present" for found in seen["partial"][1]) / len(cut),
        "random_poses": rate_random_poses(prepared, frame_to_state, effort.many, SEED),
        "empty_frames": rate_empty_frames(prepared, frame_to_state, effort.many, SEED),
        "real_negatives": _real_negatives(frame_to_state),
        "conditions": measure_conditions(prepared, frame_to_state, poses[: effort.each], SEED),
        "mixed": compare(mix(prepared, effort.mixed, SEED), frame_to_state, TARGET),
        "corner_error": measure_corner_error(camera, TARGET, effort.captures, SEED),
        "live_renderer": _time_renderer(prepared, poses),
        "frames": {name: len(images) for name, images in kinds.items()},
    }


def judge_found(found: list[LiveDetection], truths: list[Array]) -> dict[str, float]:
    """Return the shares of boards found in order and in a wrong one, and the rms of their corners, px."""
    squares: list[float] = []
    wrong = 0
    for detection, truth in zip(found, truths, strict=True):
        if detection.image_points is None:
            continue
        error_sq = float(np.mean(np.sum((detection.image_points - truth) ** 2, axis=1)))
        if error_sq > WRONG_PX**2:
            wrong += 1
        else:
            squares.append(error_sq)
    return {
        "rate": len(squares) / len(found),
        "wrong": wrong / len(found),
        "rms_px": float(np.sqrt(np.mean(squares))) if squares else float("nan"),
    }


def _real_negatives(look: Look) -> dict[str, Any]:
    """Return what photographs of roads are called, where they are there."""
    images = [cv2.imread(str(file), cv2.IMREAD_GRAYSCALE) for file in sorted(NEGATIVES.glob("*.jpg"))]
    found = [look(np.asarray(image, dtype=np.uint8)) for image in images if image is not None]
    return {"frames": len(found), "false": sum(one.kind != "absent" for one in found)}


def _detection_alone(kinds: Mapping[str, list[Image]], truths: list[Array]) -> dict[str, Any]:
    """Return the times of `detect_live` by itself, and how right it is."""
    workspace = LiveWorkspace()
    seen = {
        name: time_each(lambda image: detect_live(image, TARGET, workspace), images)
        for name, images in kinds.items()
    }
    return {
        "detection": {name: spread(timed) for name, (timed, _) in seen.items()},
        "found": judge_found(seen["first"][1], truths),
    }


def _frames_without_a_board(prepared: PreparedScene, count: int, rng: np.random.Generator) -> list[Image]:
    """Return pictures of backgrounds, and as a worst case of noise of all grains."""
    width, height = prepared.scene.intrinsics.image_size
    frames = [
        replace(prepared, background=paint_background((width, height), 1.0, SEED + i)).render(NOWHERE, rng)
        for i in range(count)
    ]
    noise = rng.integers(0, 256, (height, width), dtype=np.uint8)
    return frames + [np.asarray(cv2.GaussianBlur(noise, (0, 0), sigma)) for sigma in NOISE_SIGMAS_PX]


def _decode_ms(images: list[Image]) -> float:
    """Return the median time to decode a full-size JPEG: a floor that no server-side guidance goes below."""
    quality = [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY]
    pictures = [cv2.imencode(".jpg", image, quality)[1] for image in images[:20]]
    timed, _ = time_each(lambda picture: cv2.imdecode(picture, cv2.IMREAD_GRAYSCALE), pictures)
    return spread(timed)["p50_ms"]


def _time_renderer(prepared: PreparedScene, poses: list[Pose]) -> dict[str, float]:
    """Return the times of the virtual station's live frames and how many a second one core draws."""
    live, rng = LiveRenderer(prepared.scene), np.random.default_rng(SEED)
    timed, _ = time_each(lambda pose: live.frame(pose, rng), poses)
    return {**spread(timed), "frames_per_s": 1e3 / float(np.mean(timed.cpu_ms))}


def _size(camera: Intrinsics) -> str:
    return "{}x{}".format(*camera.image_size)
