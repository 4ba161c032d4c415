"""Our planner against the paper's procedure: Lens 1, equal N, equal numbers of candidate poses.

The paper's side draws its poses uniformly, ours by low discrepancy; a third row lets the paper's search
loose on our candidates, so that the part that sampling plays can be seen. Its sets are solved by the
service's own solver, which is faster than OpenCV's: `opencv_wall_s` is the same search with
`cv2.calibrateCamera`, as it was published, scaled up from some of the sets. Monte-Carlo is the root mean
square of ‖Ĉ − C‖ over calibrations from fresh noise.
"""

import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np

from service.core.errors import PoseSetInfeasible
from service.core.planning.paper import calibrate_noisy, sample_uniform_poses, score_random_sets
from service.core.planning.plan import PoseSet, plan_pose_set
from service.core.planning.pose_space import Poses, PoseSpace, sample_poses
from service.core.planning.prediction import predict_accuracy, zone_within
from service.core.vision.camera import Intrinsics, project
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import stack_poses

LENS1 = Intrinsics.from_parameters(
    "pinhole5",
    {"fx": 1350.1, "fy": 1352.1, "cx": 657.6, "cy": 383.8, "k1": -0.3774, "k2": 0.2425},
    (1280, 800),
)
TARGET = Chessboard(9, 6, 0.025)
SPACE = PoseSpace()
SEED = 20240
REPEATS = 3  # of our plan, whose time is too short to be timed once
ROWS = ("ours", "paper", "paper_our_candidates")


@dataclass(frozen=True)
class Effort:
    """How much is measured: candidate poses, sets of the paper, trials; the first count is the main one."""

    candidates: int = 3000
    sets: int = 1000
    trials: int = 300
    counts: tuple[int, ...] = (20, 5, 6, 10)
    opencv_sets: int = 60
    sigma_px: float = 0.1


QUICK = Effort(sets=40, trials=30, counts=(20, 6), opencv_sets=10)


def run(quick: bool) -> dict[str, Any]:
    """Return the comparison at the main N first, then by N."""
    return measure(QUICK if quick else Effort())


def measure(effort: Effort) -> dict[str, Any]:
    """Return the comparison of an effort."""
    by_n = {count: _compare(count, effort) for count in effort.counts}
    ours, paper = (by_n[effort.counts[0]][row] for row in ROWS[:2])
    return {
        "ours": ours,
        "paper": paper,
        "norm_ratio": paper["monte_carlo_px"] / ours["monte_carlo_px"],
        "wall_ratio": paper["wall_s"] / ours["wall_s"],
        "by_n": {str(count): by_n[count] for count in sorted(by_n)},
        "wall_ratio_opencv": paper["opencv_wall_s"] / ours["wall_s"],
        "n": effort.counts[0],
        "candidates": effort.candidates,
        "paper_sets": effort.sets,
        "trials": effort.trials,
        "sigma_px": effort.sigma_px,
        "seeds": [SEED],
    }


def table(result: Mapping[str, Any]) -> str:
    """Return the comparison as lines of text."""
    lines = [
        f"Lens 1, {result['candidates']} candidates, corner noise {result['sigma_px']:g} px",
        f"The paper's procedure over {result['paper_sets']} sets; {result['trials']} trials on fresh noise",
        f"{'N':>3}  {'planner':<22}{'expected px':>12}{'Monte-Carlo px':>16}{'wall s':>9}",
    ]
    for count, rows in result["by_n"].items():
        for name, row in rows.items():
            norms = f"{row['expected_px']:>12.3f}{row['monte_carlo_px']:>16.3f}"
            lines.append(f"{count:>3}  {name:<22}{norms}{row['wall_s']:>9.2f}")
    lines.append(
        f"N = {result['n']}: the paper's pick is {result['norm_ratio']:.1f} times less accurate and took "
        f"{result['wall_ratio']:.0f} times as long ({result['wall_ratio_opencv']:.0f} with OpenCV's solver)"
    )
    return "\n".join(lines)


def _compare(count: int, effort: Effort) -> dict[str, dict[str, float]]:
    """Return expected and Monte-Carlo norm and wall time of each planner for sets of `count` poses."""
    rng = np.random.default_rng((SEED, count))
    planned, ours_s = _plan_timed(count, effort)
    started = time.perf_counter()
    uniform = sample_uniform_poses(SPACE, LENS1, TARGET, effort.candidates, rng)
    pick = _paper_pick(uniform, count, effort, rng)
    paper_s = time.perf_counter() - started
    started = time.perf_counter()
    spread = sample_poses(SPACE, LENS1, TARGET, effort.candidates, SEED)
    pick_of_ours = _paper_pick(spread, count, effort, rng)
    mixed_s = time.perf_counter() - started
    sets = ((Poses(*stack_poses(planned.poses)), ours_s), (pick, paper_s), (pick_of_ours, mixed_s))
    rows = {
        name: {**_accuracy(poses, effort, rng), "wall_s": wall}
        for name, (poses, wall) in zip(ROWS, sets, strict=True)
    }
    rows["paper"]["opencv_wall_s"] = _opencv_s(uniform, count, effort, rng)
    return rows


def _paper_pick(poses: Poses, count: int, effort: Effort, rng: np.random.Generator) -> Poses:
    """Return the set that the paper's procedure picks."""
    scored = score_random_sets(LENS1, TARGET, poses, count, rng, sets=effort.sets, sigma_px=effort.sigma_px)
    return poses[max(scored, key=lambda one: one.score).indices]


def _plan_timed(count: int, effort: Effort) -> tuple[PoseSet, float]:
    """Return our set and how long it takes, the shortest of three times."""
    times_s, planned = [], []
    for _ in range(REPEATS):
        started = time.perf_counter()
        planned.append(
            plan_pose_set(
                LENS1, TARGET, SPACE, count, SEED, candidates=effort.candidates, sigma_px=effort.sigma_px
            )
        )
        times_s.append(time.perf_counter() - started)
    return planned[0], min(times_s)


def _opencv_s(poses: Poses, count: int, effort: Effort, rng: np.random.Generator) -> float:
    """Return how long OpenCV's solver takes for all sets of the paper's search, scaled up from some."""
    pixels = project(LENS1, poses.rotations, poses.translations, TARGET.object_points)
    board = [TARGET.object_points.astype(np.float32)] * count
    spent_s = 0.0
    for _ in range(effort.opencv_sets):
        noisy = pixels[rng.choice(len(poses), count, replace=False)]
        seen = list((noisy + rng.normal(0.0, effort.sigma_px, noisy.shape)).astype(np.float32))
        started = time.perf_counter()
        cv2.calibrateCamera(board, seen, LENS1.image_size, np.eye(3), np.zeros(5))
        spent_s += time.perf_counter() - started
    return spent_s * effort.sets / effort.opencv_sets


def _accuracy(poses: Poses, effort: Effort, rng: np.random.Generator) -> dict[str, float]:
    """Return the expected and the Monte-Carlo norm of a set, and how many trials could not be solved."""
    pixels = project(LENS1, poses.rotations, poses.translations, TARGET.object_points)
    results = [calibrate_noisy(LENS1, TARGET, pixels, effort.sigma_px, rng) for _ in range(effort.trials)]
    norms = np.array([np.linalg.norm(r.intrinsics.vector - LENS1.vector) for r in results if r is not None])
    return {
        "expected_px": _expected_norm(poses, effort),
        "monte_carlo_px": float(np.sqrt(np.mean(norms**2))),
        "unsolved": float(len(results) - len(norms)),
    }


def _expected_norm(poses: Poses, effort: Effort) -> float:
    """Return √E‖Ĉ − C‖² of a set, inf where it does not determine the camera."""
    zone = zone_within(LENS1.image_size, SPACE.image_margin_px)
    try:
        return predict_accuracy(LENS1, TARGET, poses, effort.sigma_px, zone).norm_px
    except PoseSetInfeasible:
        return float("inf")
