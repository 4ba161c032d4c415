"""Does a set keep what it promises? Its predicted sd against what rendered images really give.

Every trial renders the set's poses, each a little off as a hand holds it, detects them with the detector of
captures and calibrates with the service's solver; one camera per lens, many trials. Corner noise is the
planner's `FITTED_NOISE`, nothing is fitted here.
"""

from collections.abc import Mapping
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import Any

import cv2
import numpy as np

from service.core.planning.noise import FITTED_NOISE
from service.core.planning.plan import PoseSet, plan_pose_set
from service.core.planning.pose_space import PoseSpace
from service.core.vision.calibration import View, calibrate_intrinsics
from service.core.vision.detection import detect_target
from service.core.vision.target import parse_target
from service.core.vision.transforms import Array
from service.demo.skus import PAPER_SKUS
from service.demo.virtual_vehicle import HAND, nominal_camera
from service.simulator.renderer import prepare
from service.simulator.scene import production_scene
from service.simulator.vehicle import take_captures

COUNT = 8
SEED = 3
PARTS = 2


def run(quick: bool) -> dict[str, Any]:
    """Return, per lens, the predicted and the observed sd of each parameter and their ratio."""
    trials = 10 if quick else 320
    lenses = {sku["code"]: measure(sku, trials) for sku in PAPER_SKUS}
    ratios = [ratio for lens in lenses.values() for ratio in lens["ratio"].values()]
    return {
        **lenses,
        "worst_ratio": max(ratios, key=lambda ratio: abs(np.log(ratio))),
        "trials": trials,
        "poses": COUNT,
        "ratio_sd": 1.0 / np.sqrt(2.0 * (trials - 1)),
        "seeds": [SEED],
    }


def table(result: Mapping[str, Any]) -> str:
    """Return the ratios as text."""
    head = f"{result['poses']} poses, {result['trials']} trials: observed over predicted sd"
    lines = [f"{head}, each ratio known to {result['ratio_sd']:.1%}"]
    for sku in PAPER_SKUS:
        ratios = result[sku["code"]]["ratio"]
        lines.append(f"{sku['code']:<8}" + "  ".join(f"{name} {value:.2f}" for name, value in ratios.items()))
    lines.append(f"farthest from 1: {result['worst_ratio']:.2f}")
    return "\n".join(lines)


def measure(sku: Mapping[str, Any], trials: int) -> dict[str, dict[str, float]]:
    """Return the predicted and the observed sd of a SKU's parameters."""
    planned = _plan(sku)
    share = -(-trials // PARTS)
    jobs = [(sku, SEED + part, min(share, trials - part * share)) for part in range(PARTS)]
    with ProcessPoolExecutor(PARTS, mp_context=get_context("spawn")) as pool:
        found = np.concatenate(list(pool.map(_trials, jobs)))
    observed = dict(zip(planned.expected_sd, map(float, found.std(axis=0, ddof=1)), strict=True))
    return {
        "predicted": planned.expected_sd,
        "observed": observed,
        "ratio": {name: observed[name] / planned.expected_sd[name] for name in observed},
    }


def _plan(sku: Mapping[str, Any]) -> PoseSet:
    camera, target = nominal_camera(sku), parse_target(sku["target"])
    return plan_pose_set(camera, target, PoseSpace(), COUNT, SEED, sigma_px=FITTED_NOISE)


def _trials(job: tuple[Mapping[str, Any], int, int]) -> Array:
    """Return the parameters (trials, p) that so many calibrations of one camera find."""
    sku, seed, trials = job
    cv2.setNumThreads(1)
    camera, target, poses = nominal_camera(sku), parse_target(sku["target"]), _plan(sku).poses
    prepared = prepare(production_scene(camera, target, SEED))
    rng = np.random.default_rng(seed)
    found = []
    for _ in range(trials):
        detections = [detect_target(c.image, target) for c in take_captures(prepared, poses, HAND, rng)]
        views = [View(target.object_points[one.corner_ids], one.image_points) for one in detections]
        result = calibrate_intrinsics(views, camera.image_size, camera.lens, nominal=camera)
        found.append(result.intrinsics.vector)
    return np.array(found)
