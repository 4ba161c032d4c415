"""Our planner against the paper's procedure: Lens 1, equal N, equal numbers of candidate poses.

The paper's side draws its poses uniformly, ours by low discrepancy; a third row lets the paper's search
loose on our candidates, so that the part that sampling plays can be seen. Monte-Carlo is the root mean
square of ‖Ĉ − C‖ over calibrations from fresh noise, with the service's own solver.
"""

import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from service.core.errors import PoseSetInfeasible
from service.core.planning.paper import calibrate_noisy, sample_uniform_poses, score_random_sets
from service.core.planning.plan import plan_pose_set
from service.core.planning.pose_space import Poses, PoseSpace, sample_poses
from service.core.planning.prediction import predict_accuracy, zone_within
from service.core.vision.camera import Intrinsics, project
from service.core.vision.target import Chessboard
from service.core.vision.transforms import stack_poses

LENS1 = Intrinsics.from_parameters(
    "pinhole5",
    {"fx": 1350.1, "fy": 1352.1, "cx": 657.6, "cy": 383.8, "k1": -0.3774, "k2": 0.2425},
    (1280, 800),
)
TARGET = Chessboard(9, 6, 0.025)
SPACE = PoseSpace()
SEED = 20240
ROWS = ("ours", "paper", "paper_our_candidates")


@dataclass(frozen=True)
class Effort:
    """How much is measured: candidate poses, sets of the paper, trials; the first count is the main one."""

    candidates: int = 3000
    sets: int = 1000
    trials: int = 300
    counts: tuple[int, ...] = (20, 5, 6, 10)
    sigma_px: float = 0.1


QUICK = Effort(sets=40, trials=30, counts=(20, 6))


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
        f"{result['wall_ratio']:.0f} times as long"
    )
    return "\n".join(lines)


def _compare(count: int, effort: Effort) -> dict[str, dict[str, float]]:
    """Return expected and Monte-Carlo norm and wall time of each planner for sets of `count` poses."""
    rng = np.random.default_rng((SEED, count))
    started = time.perf_counter()
    planned = plan_pose_set(
        LENS1, TARGET, SPACE, count, SEED, candidates=effort.candidates, sigma_px=effort.sigma_px
    )
    ours_s = time.perf_counter() - started
    started = time.perf_counter()
    uniform = sample_uniform_poses(SPACE, LENS1, TARGET, effort.candidates, rng)
    pick = _paper_pick(uniform, count, effort, rng)
    paper_s = time.perf_counter() - started
    started = time.perf_counter()
    spread = sample_poses(SPACE, LENS1, TARGET, effort.candidates, SEED)
    pick_of_ours = _paper_pick(spread, count, effort, rng)
    mixed_s = time.perf_counter() - started
    sets = ((Poses(*stack_poses(planned.poses)), ours_s), (pick, paper_s), (pick_of_ours, mixed_s))
    return {
        name: {**_accuracy(poses, effort, rng), "wall_s": wall}
        for name, (poses, wall) in zip(ROWS, sets, strict=True)
    }


def _paper_pick(poses: Poses, count: int, effort: Effort, rng: np.random.Generator) -> Poses:
    """Return the set that the paper's procedure picks."""
    scored = score_random_sets(LENS1, TARGET, poses, count, rng, sets=effort.sets, sigma_px=effort.sigma_px)
    return poses[max(scored, key=lambda one: one.score).indices]


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
