"""Named hard conditions for a live frame, and what may be made of each: found, told as a part, or nothing.

Not here: random poses and empty frames by the thousand (`guidance_rates`).
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from bench.frame_to_state import Image, Look
from bench.guidance_rates import judge_one, random_plate
from bench.timing import Timed, spread
from service.core.vision.target import Target
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Array, Pose, rotation_matrix, rotation_vector
from service.simulator.disturbances import add_glare, occlude, put_behind, smear
from service.simulator.lighting import lens_falloff
from service.simulator.renderer import PreparedScene
from service.simulator.scene import true_corners
from service.simulator.sensor import expose

Draw = Callable[["Shot"], Image]


@dataclass(frozen=True)
class Shot:
    """One frame to draw: a scene, the board's pose and true corners (n, 2) px, and chance."""

    prepared: PreparedScene
    pose: Pose
    truth: Array
    rng: np.random.Generator

    @property
    def light(self) -> Array:
        """The picture (h, w) before anything is in its way."""
        return self.prepared.light(self.pose)

    @property
    def square_px(self) -> float:
        """Length of the first square's side."""
        return float(np.linalg.norm(self.truth[1] - self.truth[0]))

    def exposed(self, light: Array, **changes: float) -> Image:
        """Return what the sensor reads, with changes of the scene."""
        return expose(light, replace(self.prepared.scene, **changes), self.rng)  # type: ignore[arg-type]


def shot_of(prepared: PreparedScene, pose: Pose, rng: np.random.Generator) -> Shot:
    """Return the shot of a board at a pose."""
    return Shot(prepared, pose, true_corners(prepared.scene, pose), rng)


@dataclass(frozen=True)
class Condition:
    """How it is drawn, and the verdicts that are right."""

    draw: Draw
    right: tuple[str, ...] = ("found",)


def _smeared(shot: Shot) -> Image:
    turn, length = shot.rng.uniform(0.0, np.pi), min(12.0, 0.4 * shot.square_px)
    return shot.exposed(smear(shot.light, (length * np.cos(turn), length * np.sin(turn))))


def _fading(shot: Shot) -> Image:
    scene = replace(
        shot.prepared.scene, falloff=0.9, light_centre=(0.1, 0.2), shading=1.0, light_m=(0.2, 0.1, 0.0)
    )
    return replace(shot.prepared, scene=scene, falloff=lens_falloff(scene)).render(shot.pose, shot.rng)


def _glaring(sigma_px: float, level: float) -> Draw:
    def draw(shot: Shot) -> Image:
        x, y = shot.truth[shot.rng.integers(len(shot.truth))]
        return shot.exposed(add_glare(shot.light, (float(x), float(y)), sigma_px, level))

    return draw


def hide_a_part(shot: Shot) -> Image:
    """Return a frame with a hand of one to three squares over a corner."""
    angles = np.arange(6) * np.pi / 3 + shot.rng.uniform(0.0, np.pi)
    reach = shot.square_px * shot.rng.uniform(0.6, 1.6)
    corner = shot.truth[shot.rng.integers(len(shot.truth))]
    outline = corner + reach * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return shot.exposed(occlude(shot.light, outline, float(shot.rng.uniform(0.0, 220.0))))


def _before_a_plate(shot: Shot) -> Image:
    plate = random_plate(shot.prepared.scene.intrinsics.image_size, shot.rng)
    return replace(shot.prepared, background=plate).render(shot.pose, shot.rng)


def _with_another(target: Target, farther: tuple[float, float], gain: float) -> Draw:
    """Another board behind, beside the first, so many times as far away."""

    def draw(shot: Shot) -> Image:
        camera, own = shot.prepared.scene.intrinsics, shot.prepared.scene.target
        centre = shot.pose.rotation @ own.centre + shot.pose.tvec
        depth = centre[2] * shot.rng.uniform(*farther)
        width, height = camera.image_size
        x = (0.25 if shot.truth[:, 0].mean() > width / 2 else 0.75) * width
        y = shot.rng.uniform(0.35, 0.65) * height
        fx, fy, cx, cy = camera.vector[:4]
        place = depth * np.array([(x - cx) / fx, (y - cy) / fy, 1.0])
        R = rotation_matrix(shot.rng.uniform(-0.4, 0.4, 3))
        behind = Pose(rotation_vector(R), place - R @ target.centre)
        return put_behind(shot.prepared, target, behind, gain).render(shot.pose, shot.rng)

    return draw


def conditions(target: Target) -> Mapping[str, Condition]:
    """Return the conditions by name. A part of a board may be too small a part to be told."""
    part = ("partial", "absent")
    larger = Chessboard(target.columns + 2, target.rows + 2, target.square_m)
    return {
        "plain": Condition(lambda shot: shot.exposed(shot.light)),
        "motion_blurred": Condition(_smeared),
        "dark": Condition(lambda shot: shot.exposed(shot.light, exposure=0.12)),
        "over_exposed": Condition(lambda shot: shot.exposed(shot.light, exposure=2.5)),
        "light_falloff": Condition(_fading),
        "soft_glare": Condition(_glaring(30.0, 120.0), ("found", "partial")),
        "glare_that_blinds": Condition(_glaring(60.0, 2000.0), part),
        "partly_hidden": Condition(hide_a_part, part),
        "before_a_perforated_plate": Condition(_before_a_plate, ("found", "absent")),
        "equal_board_behind": Condition(_with_another(target, (1.25, 1.8), 1.2)),
        "larger_board_behind": Condition(_with_another(larger, (1.25, 1.8), 1.0)),
        "small_on_a_monitor": Condition(_with_another(target, (2.0, 3.5), 1.25)),
    }


def measure_conditions(
    prepared: PreparedScene, look: Look, poses: list[Pose], seed: int
) -> dict[str, dict[str, Any]]:
    """Return, by condition, how often it was found, what else it was called, and the times."""
    rows: dict[str, dict[str, Any]] = {}
    for name, condition in conditions(prepared.scene.target).items():
        timed, rng = Timed(), np.random.default_rng(seed)
        called: dict[str, int] = {}
        for pose in poses:
            shot = shot_of(prepared, pose, rng)
            verdict, _ = judge_one(timed.act(look, condition.draw(shot)), shot.truth)
            called[verdict] = called.get(verdict, 0) + 1
        right = sum(called.get(verdict, 0) for verdict in condition.right)
        rows[name] = {
            "frames": len(poses),
            "found": called.get("found", 0) / len(poses),
            "right": right / len(poses),
            "wrong": called.get("wrong", 0),
            "called": called,
            **spread(timed),
        }
    return rows
