"""Live guidance, frame in to state out: times, what is found of random poses, and OpenCV on the same frames.

Exact pictures of a plant's pose space, the board any way up: whole, cut by the border, absent (backgrounds,
noise). One thread. The state is what an operator's page gets: detection, pose, comparison, hints and the
session's step. Every frame is looked for from scratch: there is no tracking, and its keys are those of
`first`.
"""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import cv2
import numpy as np
from numpy.typing import NDArray

from bench.detection import LENS1, SPACE, TARGET, WRONG_PX, cut_off, judge, opencv_corners
from service.core.errors import PoseUndetermined
from service.core.guidance.actions import Frame
from service.core.guidance.comparison import default_tolerances
from service.core.guidance.observation import Observation
from service.core.guidance.session import GuidanceSettings, start_session, step
from service.core.guidance.session_view import view
from service.core.planning.pose_space import sample_poses
from service.core.vision.camera import Intrinsics
from service.core.vision.live_detection import LiveDetection, LiveWorkspace, detect_live
from service.core.vision.pose import estimate_pose
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
QUICK_POSES, POSES = 24, 200
NOWHERE = Pose(np.zeros(3), np.array([50.0, 0.0, 1.0]))
NOISE_SIGMAS_PX = (0.6, 1.0, 1.5, 2.0, 3.0, 5.0)
JPEG_QUALITY = 80

Image = NDArray[np.uint8]
Look = Callable[[Image], LiveDetection]
Given = TypeVar("Given")
Made = TypeVar("Made")


def run(quick: bool) -> dict[str, Any]:
    """Return both image sizes' figures under `1280x800` and `1920x1208`."""
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)
    try:
        sizes = {_size(camera): measure(camera, QUICK_POSES if quick else POSES) for camera in (LENS1, LENS2)}
    finally:
        cv2.setNumThreads(threads)
    return {**sizes, "tracking": "none: every frame is looked for from scratch", "seeds": [SEED]}


def table(result: Mapping[str, Any]) -> str:
    """Return the result as text."""
    columns = ("p50_ms", "p95_ms", "p99_ms", "max_ms", "cpu_p95_ms")
    lines = [" ".join([f"{'frame':<24}", *(f"{column:>10}" for column in columns)])]
    for size in (_size(camera) for camera in (LENS1, LENS2)):
        row = result[size]
        for name in ("first", "partial", "absent"):
            times = (f"{row[name][column]:>10.1f}" for column in columns)
            lines.append(" ".join([f"{size + ' ' + name:<24}", *times]))
        lines += [f"{size} {words}" for words in _words(row)]
    lines.append(f"tracking: {result['tracking']}")
    return "\n".join(lines)


def measure(camera: Intrinsics, count: int) -> dict[str, Any]:
    """Return the figures of one camera from `count` whole boards and a quarter as many of each other kind."""
    prepared = prepare(production_scene(camera, TARGET, seed=SEED))
    sampled = sample_poses(SPACE, camera, TARGET, count, SEED)
    poses = [sampled.pose(i) for i in range(len(sampled))]
    rng = np.random.default_rng(SEED)
    whole = [prepared.render(pose, rng) for pose in poses]
    truths = [true_corners(prepared.scene, pose) for pose in poses]
    cut = [prepared.render(cut_off(pose, camera), rng) for pose in poses[::4]]
    nothing = _frames_without_a_board(prepared, count // 4, rng)
    frame_to_state = _guide(camera, poses)
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
        "live_renderer": _time_renderer(prepared, poses),
        "frames": {name: len(images) for name, images in kinds.items()},
    }


@dataclass(frozen=True)
class Timed:
    """Times of frames, ms, on the wall's clock and on the thread's own, which others cannot make longer."""

    wall_ms: list[float]
    cpu_ms: list[float]


def spread(timed: Timed) -> dict[str, float]:
    """Return the median, 95th and 99th percentile and maximum of the wall's times, ms, and CPU's 95th."""
    p50, p95, p99 = (float(value) for value in np.percentile(timed.wall_ms, (50, 95, 99)))
    cpu_p95 = float(np.percentile(timed.cpu_ms, 95))
    return {"p50_ms": p50, "p95_ms": p95, "p99_ms": p99, "max_ms": max(timed.wall_ms), "cpu_p95_ms": cpu_p95}


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


def _guide(camera: Intrinsics, poses: list[Pose]) -> Look:
    """Return what makes the next state of a session from a frame, 20 frames a second."""
    settings = GuidanceSettings(camera, TARGET, default_tolerances(camera.image_size))
    workspace = LiveWorkspace()
    state = start_session(poses)
    at_s = 0.0

    def see(image: Image) -> LiveDetection:
        nonlocal state, at_s
        at_s += 0.05
        found = detect_live(image, TARGET, workspace)
        state, _ = step(state, Frame(_observe(found, camera, at_s)), settings)
        view(state, settings)
        return found

    return see


def _observe(found: LiveDetection, camera: Intrinsics, at_s: float) -> Observation:
    pose = None
    if found.image_points is not None:
        try:
            pose = estimate_pose(camera, TARGET.object_points, found.image_points).pose
        except PoseUndetermined:
            pose = None
    return Observation(
        at_s,
        found.kind,
        found.corners_seen,
        pose,
        found.image_points,
        found.edge_width_px,
        found.brightness,
    )


def time_each(act: Callable[[Given], Made], given: Sequence[Given]) -> tuple[Timed, list[Made]]:
    """Return how long an act took for each of what is given, and what it made."""
    timed, made = Timed([], []), []
    for item in given:
        began, began_cpu = time.perf_counter(), time.thread_time()
        made.append(act(item))
        timed.wall_ms.append(1e3 * (time.perf_counter() - began))
        timed.cpu_ms.append(1e3 * (time.thread_time() - began_cpu))
    return timed, made


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


def _words(row: Mapping[str, Any]) -> list[str]:
    alone, found, live = row["detection"], row["found"], row["live_renderer"]
    p95 = ", ".join(f"{name} {alone[name]['p95_ms']:.1f}" for name in ("first", "partial", "absent"))
    right = f"found {row['detection_rate']:.3f}, wrong {found['wrong']:.3f}, rms {found['rms_px']:.3f} px"
    alarms = f"false alarms {row['false_alarms']:.3f}, cut called whole {row['called_whole_though_cut']:.3f}"
    theirs = f"OpenCV: found {row['opencv_detection_rate']:.3f}, p95 {row['opencv_p95_ms']:.1f} ms"
    drawn = f"live renderer: {live['p50_ms']:.1f} ms, {live['frames_per_s']:.0f} frames/s of one core"
    return [
        f"detection alone, p95 ms: {p95}",
        f"{right}; {alarms}",
        f"{theirs} ({row['speedup_p95']:.1f} times), without a board {row['opencv_absent_p95_ms']:.1f} ms",
        f"{drawn}; decoding a JPEG: {row['decode_ms']:.1f} ms",
    ]


def _size(camera: Intrinsics) -> str:
    return "{}x{}".format(*camera.image_size)
