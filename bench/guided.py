"""Whole guided runs of the paper's two lenses, no two vehicles alike: do all PASS, and how near the truth?

Each vehicle's camera is drawn from its SKU's tolerance; the poses are planned for, and the guidance judges
by, the nominal camera alone. Pictures are rendered, detectors, session, solver and verdict are those of the
service (`guided_run`).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from bench.guided_run import Guidance, errors_px, guide_vehicle, judge_run, make_vehicle, missed_gates
from bench.paper.lenses import CODES, paper_lens
from bench.processes import map_trials
from service.core.vision.camera import PINHOLE
from service.core.vision.tolerance import draw_camera
from service.simulator.operator import Hand
from service.simulator.scene import production_scene
from service.usecases.planning import PlanRequest, plan_for

PLAN_SEED = 1
LARGEST_ERROR_PX, LARGEST_ERROR_SD = 0.5, 3.5


@dataclass(frozen=True)
class Effort:
    """How much is tried."""

    seeds: int = 10
    poses: int = 12
    candidates: int = 3000
    processes: int = 2
    lenses: tuple[str, ...] = CODES


QUICK = Effort(seeds=1, poses=4, candidates=1000)


@dataclass(frozen=True)
class Task:
    """A vehicle to be guided: its SKU, what guidance knows, and the seed of its camera and hand."""

    lens: str
    guidance: Guidance
    seed: int


def run(quick: bool) -> dict[str, Any]:
    """Return the figures of each lens, `passed` of `runs` first."""
    return measure(QUICK if quick else Effort())


def measure(effort: Effort) -> dict[str, Any]:
    """Return the figures of an effort."""
    rows = map_trials(_guide, make_tasks(effort), effort.processes)
    return {
        **{lens: _summary([row for row in rows if row["lens"] == lens]) for lens in effort.lenses},
        "poses": effort.poses,
        "required": {"share_pass": 1.0, "error_px": LARGEST_ERROR_PX, "error_sd": LARGEST_ERROR_SD},
        "seeds": list(range(effort.seeds)),
    }


def make_tasks(effort: Effort) -> list[Task]:
    """Return the vehicles to be guided, as they are sent to other processes."""
    return [
        Task(lens, guidance, seed)
        for lens in effort.lenses
        for guidance in [_plan(lens, effort)]
        for seed in range(effort.seeds)
    ]


def table(result: Mapping[str, Any]) -> str:
    """Return the figures as text."""
    lines = [
        f"guided runs of {result['poses']} poses; largest error over the runs, px and (predicted sd)",
        f"{'lens':<7}{'PASS':>8}"
        + "".join(f"{name:>15}" for name in PINHOLE)
        + f"{'median s':>11}{'refused':>9}",
    ]
    for code in (code for code in CODES if code in result):
        part = result[code]
        errors = "".join(
            f"{part['worst_error_px'][name]:>8.3f} ({part['worst_error_sd'][name]:.1f})" for name in PINHOLE
        )
        passed = f"{part['passed']}/{part['runs']}"
        lines.append(
            f"{code:<7}{passed:>8}{errors}{part['run_median_s']:>11.1f}{part['captures_refused']:>9}"
        )
        lines += [
            f"  seed {row['seed']}: {row['verdict']}: {', '.join(row['missed'])}"
            for row in part["by_seed"]
            if row["verdict"] != "PASS"
        ]
    return "\n".join(lines)


def _plan(lens: str, effort: Effort) -> Guidance:
    """Return the guidance of a SKU with its poses, planned as the service plans them."""
    revision = paper_lens(lens)
    wish = PlanRequest(seed=PLAN_SEED, candidates=effort.candidates)
    planned = plan_for(revision, wish, count=effort.poses)
    return Guidance(revision.intrinsics, revision.target, planned.poses)


def _guide(task: Task) -> dict[str, Any]:
    """Return what became of one vehicle."""
    guidance, rng = task.guidance, np.random.default_rng([task.seed, 1])
    camera = draw_camera(guidance.nominal, paper_lens(task.lens).tolerance, rng)
    vehicle = make_vehicle(production_scene(camera, guidance.target, task.seed))
    done = guide_vehicle(vehicle, guidance, Hand(guidance.target), rng)
    judged = judge_run(done, guidance)
    row: dict[str, Any] = {
        "lens": task.lens,
        "seed": task.seed,
        "complete": done.complete,
        "elapsed_s": done.elapsed_s,
        "refused": done.refused,
    }
    if judged is None:
        return {**row, "verdict": "NONE", "missed": ["no calibration"], "error_px": {}, "error_sd": {}}
    errors = errors_px(judged, camera, PINHOLE)
    return {
        **row,
        "verdict": judged.verdict.value,
        "missed": missed_gates(judged),
        "error_px": errors,
        "error_sd": {name: errors[name] / judged.result.sd[name] for name in PINHOLE},
        "sigma_px": judged.result.sigma_px,
    }


def _summary(rows: list[dict[str, Any]]) -> dict[str, Any]:
    """Return the figures of one lens from its runs."""
    passed = sum(row["verdict"] == "PASS" for row in rows)
    solved = [row for row in rows if row["error_px"]]
    worst = {
        key: {name: max((abs(row[key][name]) for row in solved), default=float("inf")) for name in PINHOLE}
        for key in ("error_px", "error_sd")
    }
    return {
        "passed": passed,
        "runs": len(rows),
        "share_pass": passed / len(rows),
        "worst_error_px": worst["error_px"],
        "worst_error_sd": worst["error_sd"],
        "run_median_s": float(np.median([row["elapsed_s"] for row in rows])),
        "run_max_s": float(np.max([row["elapsed_s"] for row in rows])),
        "captures_refused": sum(len(row["refused"]) for row in rows),
        "complete": sum(row["complete"] for row in rows),
        "by_seed": rows,
    }
