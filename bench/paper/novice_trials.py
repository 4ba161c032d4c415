"""Ten simulated novices calibrate the paper's two lenses, freehand with OpenCV and guided: the trials.

One true camera per lens, that of the paper's Table 2, as the paper's ten people calibrated one camera; the
guidance knows a nominal that is off by the SKU's tolerance. Each novice has one hand, exposure, light and
blur in both arms. Arms beside the two of the paper: guided with fewer poses, the freehand pictures through
our detector and solver, and the guided pictures through OpenCV's. Not here: tables and pictures of it.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bench.freehand_run import FreehandRun, take_freehand
from bench.guided_run import (
    Guidance,
    GuidedRun,
    guide_vehicle,
    judge_run,
    make_vehicle,
    missed_gates,
)
from bench.opencv_flow import calibrate_with_opencv, find_with_opencv
from bench.paper.lenses import CODES, paper_lens
from bench.processes import map_trials
from service.core.errors import ServiceError
from service.core.vision.calibration import View, calibrate_intrinsics
from service.core.vision.camera import Intrinsics
from service.core.vision.detection import detect_target
from service.core.vision.residuals import mean_reprojection_error
from service.core.vision.target import Target
from service.core.vision.tolerance import draw_camera
from service.core.vision.transforms import Array
from service.simulator.novice import draw_novice
from service.simulator.operator import Hand
from service.simulator.scene import Scene, production_scene
from service.usecases.planning import PlanRequest, plan_for

SEED = 500
PLAN_SEED = 1
NOISE_GREY, BLUR_PX, EXPOSURE_S = 3.0, 0.8, 0.01
FREEHAND, FREEHAND_OURS, GUIDED_OPENCV = "freehand", "freehand_ours", "guided_opencv"
GUIDED = ("guided", "guided_10", "guided_6")
ARMS = (FREEHAND, *GUIDED, FREEHAND_OURS, GUIDED_OPENCV)


Solved = tuple[Intrinsics, tuple[Array, ...]]


@dataclass(frozen=True)
class Effort:
    """How much is tried: people, views of a freehand run, poses of the three guided runs, processes."""

    novices: int = 10
    views: int = 20
    poses: tuple[int, ...] = (20, 10, 6)
    candidates: int = 3000
    processes: int = 2
    lenses: tuple[str, ...] = CODES


# Arms with as many poses as each other share their runs: quick has only one guided run per person and lens.
QUICK = Effort(novices=2, views=4, poses=(3, 3, 3), candidates=1000)


@dataclass(frozen=True)
class Task:
    """A person before a lens: what guides them in each guided arm, and how many views they take freehand."""

    lens: str
    novice: int
    guidances: tuple[Guidance, ...]
    views: int


def run_trials(effort: Effort) -> list[dict[str, Any]]:
    """Return one row per lens, novice and arm; see `_row`."""
    return [row for rows in map_trials(_try, make_tasks(effort), effort.processes) for row in rows]


def make_tasks(effort: Effort) -> list[Task]:
    """Return the people before the lenses, as they are sent to other processes."""
    guidances = {lens: _plan(lens, effort) for lens in effort.lenses}
    return [
        Task(lens, novice, guidances[lens], effort.views)
        for lens in effort.lenses
        for novice in range(effort.novices)
    ]


def true_camera(lens: str) -> Intrinsics:
    """Return the camera that everybody calibrates."""
    return paper_lens(lens).intrinsics


def nominal_camera(lens: str) -> Intrinsics:
    """Return what the guidance takes the camera for."""
    rng = np.random.default_rng([SEED, CODES.index(lens)])
    return draw_camera(true_camera(lens), paper_lens(lens).tolerance, rng)


def trial_scene(lens: str, seed: int) -> Scene:
    """Return what stands before the camera in both arms."""
    scene = production_scene(true_camera(lens), paper_lens(lens).target, seed)
    return replace(scene, noise_grey=NOISE_GREY, blur_px=BLUR_PX)


def _plan(lens: str, effort: Effort) -> tuple[Guidance, ...]:
    """Return the guidance of each guided arm, planned for the nominal camera."""
    sku = replace(paper_lens(lens), intrinsics=nominal_camera(lens))
    wish = PlanRequest(seed=PLAN_SEED, candidates=effort.candidates)
    sets = [plan_for(sku, wish, count=count) for count in effort.poses]
    return tuple(Guidance(sku.intrinsics, sku.target, planned.poses) for planned in sets)


def _try(task: Task) -> list[dict[str, Any]]:
    """Return the rows of one person before one lens."""
    person_rng, freehand_rng, *guided_rngs = np.random.default_rng([SEED, task.novice]).spawn(5)
    novice = draw_novice(person_rng)
    vehicle = make_vehicle(trial_scene(task.lens, task.novice), EXPOSURE_S)
    target = task.guidances[0].target
    freehand = take_freehand(vehicle, target, novice, task.views, rng=freehand_rng)
    rows = [_freehand_row(task, freehand, target), _ours_of(task, freehand.images, target)]
    runs: dict[int, GuidedRun] = {}
    for arm, guidance, rng in zip(GUIDED, task.guidances, guided_rngs, strict=True):
        count = len(guidance.poses)
        if count not in runs:
            runs[count] = guide_vehicle(vehicle, guidance, Hand(target, None, novice.habits), rng)
        rows.append(_guided_row(task, arm, runs[count], guidance))
    first = runs[len(task.guidances[0].poses)]
    return [*rows, _opencv_of(task, first.images, target)]


def _freehand_row(task: Task, done: FreehandRun, target: Target) -> dict[str, Any]:
    extra = {"elapsed_s": done.elapsed_s, "missed": done.missed, "views": len(done.images)}
    return _row(task, FREEHAND, _by_opencv(task, done.corners, target), extra)


def _ours_of(task: Task, images: Sequence[NDArray[np.uint8]], target: Target) -> dict[str, Any]:
    """Return the row of freehand pictures through our detector and solver."""
    views = [view for image in images if (view := _our_view(image, target)) is not None]
    extra = {"views": len(views)}
    nominal = nominal_camera(task.lens)
    try:
        solved = calibrate_intrinsics(views, nominal.image_size, nominal.lens, nominal)
    except ServiceError:
        return _row(task, FREEHAND_OURS, None, extra)
    return _row(task, FREEHAND_OURS, (solved.intrinsics, solved.residuals), extra)


def _our_view(image: NDArray[np.uint8], target: Target) -> View | None:
    try:
        return View(target.object_points, detect_target(image, target).image_points)
    except ServiceError:
        return None


def _guided_row(task: Task, arm: str, done: GuidedRun, guidance: Guidance) -> dict[str, Any]:
    extra: dict[str, Any] = {
        "elapsed_s": done.elapsed_s,
        "missed": len(done.refused),
        "views": len(done.images),
        "complete": done.complete,
    }
    judged = judge_run(done, guidance)
    if judged is None:
        return _row(task, arm, None, extra)
    extra |= {
        "verdict": judged.verdict.value,
        "not_passed": missed_gates(judged),
        "sd": judged.result.sd,
        "sigma_px": judged.result.sigma_px,
    }
    return _row(task, arm, (judged.result.intrinsics, judged.result.residuals), extra)


def _opencv_of(task: Task, images: Sequence[NDArray[np.uint8]], target: Target) -> dict[str, Any]:
    """Return the row of guided pictures through OpenCV's detector and solver."""
    corners = [found for image in images if (found := find_with_opencv(image, target)) is not None]
    return _row(task, GUIDED_OPENCV, _by_opencv(task, corners, target), {"views": len(corners)})


def _by_opencv(task: Task, corners: Sequence[Array], target: Target) -> Solved | None:
    solved = calibrate_with_opencv(corners, target, true_camera(task.lens).image_size)
    return None if solved is None else (solved.intrinsics, solved.residuals)


def _row(
    task: Task,
    arm: str,
    found: Solved | None,
    extra: dict[str, Any],
) -> dict[str, Any]:
    """Return a trial's row; found: intrinsics and residuals, None where there was no calibration."""
    return {
        "lens": task.lens,
        "novice": task.novice,
        "arm": arm,
        "parameters": None if found is None else found[0].parameters,
        "mre_px": None if found is None else mean_reprojection_error(found[1]),
        **extra,
    }
