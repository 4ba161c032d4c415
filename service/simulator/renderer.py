"""Draws a scene: each pixel's ray is traced through the lens to the board, whose share of the pixel is exact.

Within a pixel the board's coordinates are taken as affine, which costs less than a tenth of a grey level. A
little of the lens's blur comes before the pixels, as all of it does in a camera; the rest and noise follow on
unrounded values. Not here: areas (`coverage`), pattern (`board`), sensor (`sensor`).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.transforms import Array, Pose
from service.simulator.background import paint_background
from service.simulator.board import Plate, make_plate
from service.simulator.lighting import lamp_gain, lens_falloff
from service.simulator.meeting import Meeting, board_jacobian, may_meet_edge, meet_board
from service.simulator.ray_map import RayMap, trace_rays
from service.simulator.scene import Scene
from service.simulator.sensor import expose, first_blur


@dataclass(frozen=True)
class PreparedScene:
    """A scene with what does not change from picture to picture: rays, background (h, w), falloff (h, w)."""

    scene: Scene
    rays: RayMap
    plate: Plate
    background: Array
    falloff: Array

    def render(self, pose: Pose, rng: np.random.Generator) -> NDArray[np.uint8]:
        """Return the picture (h, w) of the board at a pose; the same for the same scene, pose and rng."""
        return expose(self.light(pose), self.scene, rng)

    def light(self, pose: Pose) -> Array:
        """Return the light (h, w) before the sensor, in unrounded grey levels at exposure 1."""
        light = self.background.copy()
        meeting = meet_board(self.scene, self.plate, self.rays, pose)
        if meeting is not None:
            _draw_board(self, pose, meeting, light)
        return light * self.falloff


def prepare(scene: Scene) -> PreparedScene:
    """Return the scene ready for many pictures; takes a second, so that each takes a fraction of one."""
    size = scene.intrinsics.image_size
    return PreparedScene(
        scene=scene,
        rays=trace_rays(scene.intrinsics),
        plate=make_plate(scene.target, scene.border_squares),
        background=paint_background(size, scene.clutter, scene.seed),
        falloff=lens_falloff(scene),
    )


def render(scene: Scene, pose: Pose, rng: np.random.Generator) -> NDArray[np.uint8]:
    """Return one picture (h, w) of a scene; for many, `prepare` it once."""
    return prepare(scene).render(pose, rng)


def _draw_board(prepared: PreparedScene, pose: Pose, meeting: Meeting, light: Array) -> None:
    """Put the plate's light into `light` (h, w): sampled at pixel centres, exact where edges are near."""
    scene, rays = prepared.scene, prepared.rays
    plate, dark = prepared.plate.sample(meeting.uv)
    offsets = first_blur(scene.blur_px)
    size_px = 1.0 + 2.0 * float(np.abs(offsets).max())
    near = np.flatnonzero(may_meet_edge(meeting, prepared.plate, rays, size_px))
    uv, jacobian = meeting.uv[near], board_jacobian(meeting, rays, near)
    parts = [prepared.plate.shares(uv + jacobian @ offset, jacobian) for offset in offsets]
    plate[near], dark[near] = np.mean(parts, axis=0)
    if pose.rotation[:, 2] @ pose.tvec < 0:  # the back of the plate has no pattern
        dark[:] = 0.0
    reflected = scene.white_grey * plate + (scene.dark_grey - scene.white_grey) * dark
    reflected *= lamp_gain(scene, pose, meeting.uv)
    light[meeting.pixels] = light[meeting.pixels] * (1.0 - plate) + reflected
