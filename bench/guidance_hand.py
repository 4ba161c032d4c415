"""Does a hand that reads only hints reach every pose of both of the paper's lenses, and in what time?

Pure geometry (`geometric_kiosk`). Every pose from random starts, one in ten upside down; whole runs from
several seeds, with lapses, and the same before a mirroring display; and whole runs in which one hint points
the wrong way, which must not complete.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from bench.geometric_kiosk import GuidedRun, as_told, guide_hand
from service.core.guidance.comparison import default_tolerances
from service.core.guidance.hints import DIRECTIONS, Hint, mirror_hint
from service.core.guidance.session import GuidanceSettings
from service.core.planning.plan import plan_pose_set
from service.core.planning.pose_space import PoseSpace, sample_poses
from service.core.vision.camera import Intrinsics
from service.core.vision.target import Chessboard, parse_target
from service.core.vision.transforms import Pose, rotation_matrix, rotation_vector
from service.demo.skus import PAPER_SKUS
from service.simulator.operator import Habits, Hand

COUNT, CANDIDATES, SEED = 12, 3000, 0
LONGEST_POSE_S, LONGEST_RUN_S = 60.0, 240.0
FRAMES_PER_S = 15.0
UPSIDE_DOWN_EVERY = 10
OPPOSITE = {a: b for pair in DIRECTIONS for a, b in (pair, pair[::-1])}


@dataclass(frozen=True)
class Effort:
    """How much is tried: starts per pose, seeds of whole runs, and how many hints are turned round."""

    starts: int
    seeds: int
    flips: int


@dataclass(frozen=True)
class Station:
    """A lens with its planned poses."""

    code: str
    settings: GuidanceSettings
    poses: tuple[Pose, ...]


def run(quick: bool) -> dict[str, Any]:
    """Return, per lens, poses reached and times; then which hints turned round a run survived (none)."""
    effort = Effort(1, 1, 2) if quick else Effort(50, 10, len(OPPOSITE))
    stations = [plan_station(sku, 300 if quick else CANDIDATES) for sku in PAPER_SKUS]
    lenses = {station.code: _measure(station, effort) for station in stations}
    flips = {hint.value: _survives(stations[1], hint) for hint in list(OPPOSITE)[: effort.flips]}
    return {**lenses, "completed_with_a_flipped_hint": flips, "seeds": list(range(effort.seeds))}


def table(result: Mapping[str, Any]) -> str:
    """Return the figures as text."""
    head = f"{'lens':<8}{'reached':>12}{'median s/pose':>15}{'run median s':>14}"
    head += f"{'mirrored s':>12}{'complete':>12}"
    lines = [head]
    for code in (sku["code"] for sku in PAPER_SKUS):
        part = result[code]
        reached = f"{part['reached']}/{part['tried']}"
        complete = f"{part['runs_complete']}/{part['runs']}"
        lines.append(
            f"{code:<8}{reached:>12}{part['pose_median_s']:>15.1f}{part['run_median_s']:>14.1f}"
            f"{part['mirrored_median_s']:>12.1f}{complete:>12}"
        )
    flips = result["completed_with_a_flipped_hint"]
    lines.append(f"runs that completed with one hint turned round: {sum(flips.values())} of {len(flips)}")
    return "\n".join(lines)


def plan_station(sku: Mapping[str, Any], candidates: int) -> Station:
    """Return a SKU document's lens with its planned set."""
    width, height = sku["image_size"]
    camera = Intrinsics.from_parameters(sku["lens"], sku["nominal"], (width, height))
    target = parse_target(sku["target"])
    planned = plan_pose_set(camera, target, PoseSpace(), COUNT, SEED, candidates=candidates)
    settings = GuidanceSettings(camera, target, default_tolerances(camera.image_size))
    return Station(sku["code"], settings, planned.poses)


def random_starts(station: Station, count: int, seed: int) -> list[Pose]:
    """Return poses to begin with: feasible ones, one in ten turned upside down."""
    camera, target = station.settings.intrinsics, station.settings.target
    poses = sample_poses(PoseSpace(), camera, target, count, seed)
    starts = [poses.pose(i) for i in range(count)]
    return [
        upside_down(start, target) if i % UPSIDE_DOWN_EVERY == UPSIDE_DOWN_EVERY - 1 else start
        for i, start in enumerate(starts)
    ]


def upside_down(pose: Pose, target: Chessboard) -> Pose:
    """Return the pose of the board turned by 180° in its own plane about its centre."""
    R = pose.rotation @ rotation_matrix(np.array([0.0, 0.0, np.pi]))
    return Pose(rotation_vector(R), pose.rotation @ target.centre + pose.tvec - R @ target.centre)


def reach(station: Station, pose: Pose, start: Pose, seed: int) -> GuidedRun:
    """Return how one pose was reached from a start."""
    hand = Hand(station.settings.target, start, Habits(lapses_per_s=0.0))
    rng = np.random.default_rng(seed)
    return guide_hand(
        (pose,), hand, station.settings, rng, longest_s=LONGEST_POSE_S, frames_per_s=FRAMES_PER_S
    )


def whole_run(
    station: Station, seed: int, *, mirrored: bool = False, flipped: Hint | None = None
) -> GuidedRun:
    """Return how a whole set was taken, before a mirroring display or with one hint turned round."""

    def flip(hint: Hint) -> Hint:
        return OPPOSITE[hint] if hint == flipped else hint

    display = mirror_hint if mirrored else as_told if flipped is None else flip
    hand = Hand(station.settings.target, None, Habits(mirrored=mirrored))
    rng = np.random.default_rng(seed)
    return guide_hand(
        station.poses,
        hand,
        station.settings,
        rng,
        longest_s=LONGEST_RUN_S,
        frames_per_s=FRAMES_PER_S,
        display=display,
    )


def _measure(station: Station, effort: Effort) -> dict[str, Any]:
    """Return the figures of one lens."""
    starts = random_starts(station, effort.starts, SEED + 1)
    single = [reach(station, pose, start, i) for pose in station.poses for i, start in enumerate(starts)]
    runs = [whole_run(station, seed) for seed in range(effort.seeds)]
    mirrored = [whole_run(station, seed, mirrored=True) for seed in range(effort.seeds)]
    return {
        "reached": sum(one.complete for one in single),
        "tried": len(single),
        "pose_median_s": float(np.median([_duration(one, LONGEST_POSE_S) for one in single])),
        "runs_complete": sum(one.complete for one in (*runs, *mirrored)),
        "runs": len(runs) + len(mirrored),
        "run_median_s": float(np.median([_duration(one, LONGEST_RUN_S) for one in runs])),
        "mirrored_median_s": float(np.median([_duration(one, LONGEST_RUN_S) for one in mirrored])),
    }


def _survives(station: Station, flipped: Hint) -> bool:
    return whole_run(station, SEED, flipped=flipped).complete


def _duration(done: GuidedRun, longest_s: float) -> float:
    """Return when the last pose was captured, or how long it was tried in vain."""
    return done.captured_at_s[-1] if done.complete else longest_s
