"""Draws a scene: each pixel's ray is traced through the lens to the board, whose share of the pixel is exact.

Within a pixel the board's coordinates are taken as affine, which costs less than a tenth of a grey level;
blur and noise follow on unrounded values. Not here: areas (`coverage`), pattern (`board`), sensor (`sensor`).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.transforms import Array, Pose
from service.simulator.background import paint_background
from service.simulator.board import Plate, make_plate
from service.simulator.ray_map import RayMap, trace_rays
from service.simulator.scene import Scene, project_points
from service.simulator.sensor import expose

OUTLINE_POINTS = 65  # per side of the plate


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
        meeting = _meet_board(self, pose)
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
        falloff=_falloff(scene),
    )


def render(scene: Scene, pose: Pose, rng: np.random.Generator) -> NDArray[np.uint8]:
    """Return one picture (h, w) of a scene; for many, `prepare` it once."""
    return prepare(scene).render(pose, rng)


@dataclass(frozen=True)
class _Meeting:
    """Where rays meet the plate, or may: pixels as (rows (n,), columns (n,)), board points (n, 2) squares.

    inverse_depth: (n,) 1/m. inverse: (3, 3), from (x, y, 1) of the ideal plane to (u, v, 1) / depth.
    """

    pixels: tuple[NDArray[np.intp], NDArray[np.intp]]
    uv: Array
    inverse_depth: Array
    inverse: Array


def _meet_board(prepared: PreparedScene, pose: Pose) -> _Meeting | None:
    """Return the pixels whose centre sees the plate or passes it by less than a square; None if none can."""
    R, square = pose.rotation, prepared.scene.target.square_m
    if abs(R[:, 2] @ pose.tvec) < 1e-6:  # seen exactly from its edge
        return None
    inverse = np.linalg.inv(np.column_stack([R[:, 0] * square, R[:, 1] * square, pose.tvec]))
    top, bottom, left, right = _bounds(prepared, pose)
    x, y = prepared.rays.ideal[:, top:bottom, left:right]
    a, b, c = (row[0] * x + row[1] * y + row[2] for row in inverse)
    (low_u, high_u), (low_v, high_v) = (
        steps.edges + np.array([-1.0, 1.0]) for steps in prepared.plate.outline
    )
    # Multiplied by the inverse depth c, so that nothing is divided before it is known to be seen.
    seen = (c > 1e-3) & (a > low_u * c) & (a < high_u * c) & (b > low_v * c) & (b < high_v * c)
    rows, columns = np.nonzero(seen)
    if rows.size == 0:
        return None
    c = c[seen]
    uv = np.stack([a[seen], b[seen]], axis=1) / c[:, None]
    return _Meeting((rows + top, columns + left), uv, c, inverse)


def _bounds(prepared: PreparedScene, pose: Pose) -> tuple[int, int, int, int]:
    """Return top, bottom, left, right of the pixels that may see the plate; the whole picture in doubt."""
    scene = prepared.scene
    width, height = scene.intrinsics.image_size
    (low_u, high_u), (low_v, high_v) = (
        steps.edges + np.array([-1.0, 1.0]) for steps in prepared.plate.outline
    )
    along = np.linspace(0.0, 1.0, OUTLINE_POINTS)[:, None]
    tips = np.array([[low_u, low_v], [high_u, low_v], [high_u, high_v], [low_u, high_v]])
    outline = np.concatenate([tips[i] + along * (tips[(i + 1) % 4] - tips[i]) for i in range(4)])
    points = project_points(
        scene, pose, np.column_stack([outline, np.zeros(len(outline))]) * scene.target.square_m
    )
    if not np.all(np.isfinite(points)):
        return 0, height, 0, width
    # One pixel more, for the little by which a curved side leaves the chords between its points.
    first = np.clip(np.floor(points.min(axis=0)) - 1, 0, (width, height)).astype(int)
    last = np.clip(np.ceil(points.max(axis=0)) + 2, 0, (width, height)).astype(int)
    return int(first[1]), int(last[1]), int(first[0]), int(last[0])


def _draw_board(prepared: PreparedScene, pose: Pose, meeting: _Meeting, light: Array) -> None:
    """Put the plate's light into `light` (h, w): sampled at pixel centres, exact where edges are near."""
    scene = prepared.scene
    plate, dark = prepared.plate.sample(meeting.uv)
    near = np.flatnonzero(_may_meet_edge(prepared, meeting))
    plate[near], dark[near] = prepared.plate.shares(
        meeting.uv[near], _board_jacobian(prepared, meeting, near)
    )
    if pose.rotation[:, 2] @ pose.tvec < 0:  # the back of the plate has no pattern
        dark[:] = 0.0
    reflected = (scene.white_grey * plate + (scene.dark_grey - scene.white_grey) * dark) * _lamp(
        scene, pose, meeting.uv
    )
    light[meeting.pixels] = light[meeting.pixels] * (1.0 - plate) + reflected


def _may_meet_edge(prepared: PreparedScene, meeting: _Meeting) -> NDArray[np.bool_]:
    """Return which pixels (n,) an edge may cross, by a bound that needs no Jacobian per pixel."""
    spread = prepared.rays.spread[meeting.pixels] / meeting.inverse_depth
    near = np.zeros(len(spread), dtype=bool)
    for axis in range(2):
        x, outline = meeting.uv[:, axis], prepared.plate.outline[axis].edges
        row, last = meeting.inverse[axis], meeting.inverse[2]
        half = (np.abs(row[0] - x * last[0]) + np.abs(row[1] - x * last[1])) * spread
        near |= np.abs(x - np.rint(x)) < half
        near |= np.abs(np.abs(x - outline.mean()) - 0.5 * np.ptp(outline)) < half
    return near


def _board_jacobian(prepared: PreparedScene, meeting: _Meeting, at: NDArray[np.intp]) -> Array:
    """Return d(u, v)/d(pixel) (m, 2, 2) at some of the pixels where rays meet the board."""
    rows, columns = (indices[at] for indices in meeting.pixels)
    ideal = prepared.rays.ideal[:, rows, columns].T
    inverse = meeting.inverse
    by_ideal = inverse[None, :2, :2] - meeting.uv[at][:, :, None] * inverse[None, 2:, :2]
    jacobian: Array = by_ideal / meeting.inverse_depth[at][:, None, None] @ prepared.rays.jacobian(ideal)
    return jacobian


def _lamp(scene: Scene, pose: Pose, uv: Array) -> Array | float:
    """Return the lamp's light on board points (n, 2), squares, as a share of what the board's centre gets.

    A small lamp's light on a plane falls with the cube of the distance: its square by spreading, the rest by
    the slant.
    """
    if scene.shading == 0.0:
        return 1.0
    R, square = pose.rotation, scene.target.square_m
    start = pose.tvec - np.array(scene.light_m)
    centre = start + R @ scene.target.centre
    u, v = uv[:, 0] * square, uv[:, 1] * square
    distance_sq = start @ start + u * (u + 2.0 * (R[:, 0] @ start)) + v * (v + 2.0 * (R[:, 1] @ start))
    gain: Array = (centre @ centre / np.maximum(distance_sq, 1e-6)) ** (1.5 * scene.shading)
    return gain


def _falloff(scene: Scene) -> Array:
    """Return the share of light (h, w) that reaches each pixel: a Gaussian about the scene's light centre."""
    width, height = scene.intrinsics.image_size
    x = np.arange(width) - scene.light_centre[0] * (width - 1)
    y = np.arange(height) - scene.light_centre[1] * (height - 1)
    distance_sq = np.square(x) + np.square(y)[:, None]
    falloff: Array = np.exp(np.log1p(-scene.falloff) * distance_sq / distance_sq.max())
    return falloff
