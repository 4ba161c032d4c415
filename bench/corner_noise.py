"""How the noise of detected corners depends on the pose: rendered boards, the real detector, known truth.

The planner's `FITTED_NOISE` comes from here; the bench fits it again and shows both. Repetitions of a view
part what changes with the sensor's noise from what the pixel grid does to it every time.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import cv2
import numpy as np

from service.core.errors import ServiceError
from service.core.planning.noise import (
    FITTED_NOISE,
    REFERENCE_BLUR_PX,
    REFERENCE_SQUARE_PX,
    CornerNoise,
    grid_alignment,
)
from service.core.planning.pose_space import PoseSpace, sample_poses
from service.core.planning.visibility import measure_visibility
from service.core.vision.camera import Intrinsics
from service.core.vision.detection import detect_target
from service.core.vision.target import Target, parse_target
from service.core.vision.transforms import Array
from service.demo.skus import PAPER_SKUS
from service.demo.virtual_vehicle import nominal_camera
from service.simulator.renderer import PreparedScene, prepare
from service.simulator.scene import production_scene, true_corners

SEED = 5
BLURS_PX = (REFERENCE_BLUR_PX, 1.0, 1.4)
# Near boards alone as well, so that large squares are there too.
SPACES = (PoseSpace(), PoseSpace(distance_m=(0.25, 0.45)))
REPEATS = 3
WRONG_PX = 2.0
EXPONENTS = ("level_px", "by_square", "by_slant", "by_blur", "aliasing_px", "aliasing_by_blur")


@dataclass(frozen=True)
class Measured:
    """One pose in one blur: what it looks like, and its errors by repetition, rms in px."""

    log_square: float
    log_slant: float
    log_blur: float
    alignment: float
    random_px: float
    constant_px: float


def run(quick: bool) -> dict[str, Any]:
    """Return the fit over both of the paper's lenses, how well it fits, and the one that is in use."""
    cv2.setNumThreads(1)
    per_part = 3 if quick else 30
    measured = [one for sku in PAPER_SKUS for one in _measure(sku, per_part)]
    fitted = fit_noise(measured)
    total = np.hypot([one.random_px for one in measured], [one.constant_px for one in measured])
    return {
        "fit": _numbers(fitted),
        "in_use": _numbers(FITTED_NOISE),
        "scatter": {
            "of_fit": _scatter(total, _predict(fitted, measured)),
            "of_in_use": _scatter(total, _predict(FITTED_NOISE, measured)),
            "of_one_for_all": _scatter(total, np.ones(len(total))),
        },
        "bias_of_in_use": _bias(FITTED_NOISE, measured),
        "views": len(measured),
        "seeds": [SEED],
    }


def table(result: Mapping[str, Any]) -> str:
    """Return the fit as text."""
    lines = [f"{result['views']} views", f"{'':<8}" + "".join(f"{name:>18}" for name in EXPONENTS)]
    lines += [
        f"{name:<8}" + "".join(f"{result[name][key]:>18.4f}" for key in EXPONENTS)
        for name in ("fit", "in_use")
    ]
    scatter = result["scatter"]
    lines.append(
        f"scatter (log): {scatter['of_fit']:.3f} about the fit, {scatter['of_in_use']:.3f} about the one in "
        f"use, {scatter['of_one_for_all']:.3f} about one for all; the one in use is off by "
        f"{result['bias_of_in_use']:+.1%}"
    )
    return "\n".join(lines)


def fit_noise(measured: list[Measured]) -> CornerNoise:
    """Return the noise that fits measured poses: powers for the random part, a line in logs for aliasing."""
    features = np.array([(1.0, one.log_square, one.log_slant, one.log_blur) for one in measured])
    random, *_ = np.linalg.lstsq(features, np.log([one.random_px for one in measured]), rcond=None)
    levels = [_aliasing(measured, blur_px) for blur_px in BLURS_PX]
    by_blur, aliasing = np.polyfit(np.log(np.array(BLURS_PX) / REFERENCE_BLUR_PX), np.log(levels), 1)
    by_square, by_slant, random_by_blur = (float(value) for value in random[1:])
    parts = CornerNoise(
        float(np.exp(random[0])), by_square, by_slant, random_by_blur, float(np.exp(aliasing)), float(by_blur)
    )
    # What the pixel grid does to edges across it is in neither part.
    return parts.at_level(parts.level_px * (1.0 + _bias(parts, measured)))


def _aliasing(measured: list[Measured], blur_px: float) -> float:
    """Return the aliasing, px, of edges along the grid at a blur: a least-squares share of the alignment."""
    log_blur = np.log(blur_px / REFERENCE_BLUR_PX)
    some = [one for one in measured if abs(one.log_blur - log_blur) < 1e-9]
    alignment = np.array([one.alignment for one in some])
    return float(alignment @ [one.constant_px for one in some] / (alignment @ alignment))


def _numbers(noise: CornerNoise) -> dict[str, float]:
    return {name: float(getattr(noise, name)) for name in EXPONENTS}


def _predict(noise: CornerNoise, measured: list[Measured]) -> Array:
    features = np.array([(one.log_square, one.log_slant, one.log_blur) for one in measured])
    random = noise.level_px * np.exp(features @ [noise.by_square, noise.by_slant, noise.by_blur])
    aliasing = np.array([one.alignment * np.exp(one.log_blur * noise.aliasing_by_blur) for one in measured])
    total: Array = np.hypot(random, noise.aliasing_px * aliasing)
    return total


def _bias(noise: CornerNoise, measured: list[Measured]) -> float:
    """Return by which share all errors are larger than predicted, on average."""
    total = np.hypot([one.random_px for one in measured], [one.constant_px for one in measured])
    return float(np.exp(np.mean(np.log(total / _predict(noise, measured))))) - 1.0


def _scatter(total: Array, predicted: Array) -> float:
    return float(np.std(np.log(total / predicted)))


def _measure(sku: Mapping[str, Any], per_part: int) -> Iterator[Measured]:
    camera, target = nominal_camera(sku), parse_target(sku["target"])
    prepared = prepare(production_scene(camera, target, SEED))
    for blur_px in BLURS_PX:
        scene = replace(prepared, scene=replace(prepared.scene, blur_px=blur_px))
        for space in SPACES:
            yield from _measure_space(scene, camera, target, space, per_part)


def _measure_space(
    prepared: PreparedScene, camera: Intrinsics, target: Target, space: PoseSpace, count: int
) -> Iterator[Measured]:
    poses = sample_poses(space, camera, target, count, SEED)
    seen = measure_visibility(camera, target, poses.rotations, poses.translations)
    rng = np.random.default_rng(SEED)
    for i in range(count):
        truth = true_corners(prepared.scene, poses.pose(i))
        errors = []
        for _ in range(REPEATS):
            try:
                found = detect_target(prepared.render(poses.pose(i), rng), target)
            except ServiceError:
                continue
            errors.append(found.image_points - truth[found.corner_ids])
        if len(errors) < REPEATS or np.abs(errors).max() > WRONG_PX:
            continue
        variance = float(np.var(errors, axis=0, ddof=1).mean())
        constant = float(np.mean(np.mean(errors, axis=0) ** 2)) - variance / REPEATS
        yield Measured(
            log_square=min(float(np.log(seen.smallest_square_px[i] / REFERENCE_SQUARE_PX)), 0.0),
            log_slant=float(np.log(np.cos(seen.incidence_rad[i]))),
            log_blur=float(np.log(prepared.scene.blur_px / REFERENCE_BLUR_PX)),
            alignment=float(grid_alignment(seen.skew[i : i + 1])[0]),
            random_px=float(np.sqrt(variance)),
            constant_px=float(np.sqrt(max(constant, 1e-8))),
        )
