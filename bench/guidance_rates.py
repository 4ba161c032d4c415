"""How many of many random boards a live frame shows, by tilt, distance, blur and light; and of empty frames.

Exact pictures one at a time: any roll, tilt to 50 degrees, a random defocus, motion and exposure each. A
board in another order than the true one, or at another place, is wrong; a frame without a board that is
called anything but absent is false.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import cv2
import numpy as np

from bench.frame_to_state import Image, Look
from bench.timing import Timed, spread
from service.core.planning.pose_space import PoseSpace, sample_poses
from service.core.vision.live_detection import LiveDetection
from service.core.vision.transforms import Array, Pose
from service.simulator.background import paint_background
from service.simulator.disturbances import Holes, perforate, smear
from service.simulator.renderer import PreparedScene
from service.simulator.scene import true_corners
from service.simulator.sensor import expose

SPACE = PoseSpace(
    yaw_deg=(-50.0, 50.0), pitch_deg=(-50.0, 50.0), roll_deg=(-180.0, 180.0), largest_incidence_deg=65.0
)
NOWHERE = Pose(np.zeros(3), np.array([50.0, 0.0, 1.0]))
WRONG_PX = 2.0
EDGES: Mapping[str, tuple[float, ...]] = {
    "tilt_deg": (0.0, 15.0, 30.0, 90.0),
    "distance_m": (0.0, 0.45, 0.7, 2.0),
    "defocus_px": (0.0, 1.0, 1.5, 2.0),
    "motion_px": (0.0, 4.0, 8.0, 12.0),
    "exposure": (0.0, 0.5, 1.0, 1.5, 2.5),
}
PLATE_EVERY = 4  # of the empty frames: a perforated plate


@dataclass(frozen=True)
class Tried:
    """A board before the camera: what the frame was like, by the names of EDGES, and what was found."""

    facts: Mapping[str, float]
    verdict: str


def rate_random_poses(prepared: PreparedScene, look: Look, count: int, seed: int) -> dict[str, Any]:
    """Return found and wrong shares with times over `count` random poses, and by each fact."""
    timed, tried = Timed(), list[Tried]()
    squares: list[float] = []
    for pose, facts, image in random_boards(prepared, count, seed):
        truth = true_corners(prepared.scene, pose)
        found = timed.act(look, image)
        verdict, error_sq = judge_one(found, truth)
        tried.append(Tried(facts, verdict))
        if verdict == "found":
            squares.append(error_sq)
    totals = _totals(tried)
    rms = float(np.sqrt(np.mean(squares))) if squares else float("nan")
    return {**totals, "rms_px": rms, **spread(timed), "by": group(tried)}


def rate_empty_frames(prepared: PreparedScene, look: Look, count: int, seed: int) -> dict[str, Any]:
    """Return how many of `count` frames without a board are called anything but absent, with times."""
    timed, rng = Timed(), np.random.default_rng(seed)
    called: dict[str, int] = {}
    for number in range(count):
        found = timed.act(look, empty_frame(prepared, number, seed, rng))
        called[found.kind] = called.get(found.kind, 0) + 1
    return {"frames": count, "false": count - called.get("absent", 0), "called": called, **spread(timed)}


def empty_frame(prepared: PreparedScene, number: int, seed: int, rng: np.random.Generator) -> Image:
    """Return a frame without a board: shapes out of focus, or a perforated plate."""
    size = prepared.scene.intrinsics.image_size
    if number % PLATE_EVERY:
        background = paint_background(size, 1.0, seed + number)
    else:
        background = random_plate(size, rng)
    return replace(prepared, background=background).render(NOWHERE, rng)


def random_plate(size: tuple[int, int], rng: np.random.Generator) -> Array:
    """Return a random perforated plate's picture (h, w), grey levels, from fine holes to large ones."""
    pitch = float(np.exp(rng.uniform(np.log(6.0), np.log(80.0))))
    grey, other = rng.uniform(10.0, 80.0), rng.uniform(120.0, 210.0)
    dark, bright = (grey, other) if rng.random() < 0.5 else (other, grey)
    holes = Holes(
        pitch, pitch * rng.uniform(0.4, 0.8), bool(rng.random() < 0.5), bright, dark, rng.uniform(0.0, 180.0)
    )
    picture = cv2.GaussianBlur(perforate(size, holes), (0, 0), rng.uniform(0.5, 2.0))
    return np.asarray(picture, dtype=np.float64)


def judge_one(found: LiveDetection, truth: Array) -> tuple[str, float]:
    """Return "found", "wrong" or what a frame was called instead; and the mean squared error, px²."""
    if found.image_points is None:
        return found.kind if found.kind != "wrong" else "called another board", float("nan")
    error_sq = float(np.mean(np.sum((found.image_points - truth) ** 2, axis=1)))
    return ("found" if error_sq <= WRONG_PX**2 else "wrong"), error_sq


def group(tried: Sequence[Tried]) -> dict[str, list[dict[str, Any]]]:
    """Return the totals of each range of each fact: from, to, boards, rate, wrong."""
    rows: dict[str, list[dict[str, Any]]] = {}
    for name, edges in EDGES.items():
        rows[name] = []
        for low, high in pairwise(edges):
            within = [one for one in tried if low <= one.facts[name] < high]
            if within:
                rows[name].append({"from": low, "to": high, **_totals(within)})
    return rows


def _totals(tried: Sequence[Tried]) -> dict[str, Any]:
    found = sum(one.verdict == "found" for one in tried)
    wrong = sum(one.verdict == "wrong" for one in tried)
    return {"boards": len(tried), "rate": found / len(tried), "wrong": wrong}


def random_boards(
    prepared: PreparedScene, count: int, seed: int
) -> Iterator[tuple[Pose, dict[str, float], Image]]:
    """Yield poses with what their frames are like, by the names of EDGES, and the frames."""
    camera, target = prepared.scene.intrinsics, prepared.scene.target
    poses, rng = sample_poses(SPACE, camera, target, count, seed), np.random.default_rng(seed)
    for i in range(count):
        pose = poses.pose(i)
        centre = pose.rotation @ target.centre + pose.tvec
        facing = abs(float(pose.rotation[:, 2] @ centre)) / float(np.linalg.norm(centre))
        facts = {
            "tilt_deg": float(np.degrees(np.arccos(min(facing, 1.0)))),
            "distance_m": float(np.linalg.norm(centre)),
            "defocus_px": float(rng.uniform(0.6, 2.0)),
            "motion_px": float(rng.uniform(0.0, 12.0)),
            "exposure": float(np.exp(rng.uniform(np.log(0.2), np.log(2.4)))),
        }
        # Small squares leave no room for a long smear: a path beyond half a square destroys the pattern.
        square_px = target.square_m / centre[2] * camera.vector[0] * facing
        facts["motion_px"] = min(facts["motion_px"], 0.4 * float(square_px))
        turn = rng.uniform(0.0, np.pi)
        path = (facts["motion_px"] * np.cos(turn), facts["motion_px"] * np.sin(turn))
        scene = replace(prepared.scene, blur_px=facts["defocus_px"], exposure=facts["exposure"])
        yield pose, facts, expose(smear(prepared.light(pose), path), scene, rng)
