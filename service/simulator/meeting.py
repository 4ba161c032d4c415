"""Where a camera's rays meet the plate, and what a pixel spans there. Not here: what the plate shows."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.transforms import Array, Pose
from service.simulator.board import Plate
from service.simulator.ray_map import RayMap
from service.simulator.scene import Scene, project_points

OUTLINE_POINTS = 65  # per side of the plate


@dataclass(frozen=True)
class Meeting:
    """Where rays meet the plate, or may: pixels as (rows (n,), columns (n,)), board points (n, 2) squares.

    inverse_depth: (n,) by what a ray must be divided to end on the plate, 1/m. inverse: (3, 3), from rays
    to (u, v, 1) times that.
    """

    pixels: tuple[NDArray[np.intp], NDArray[np.intp]]
    uv: Array
    inverse_depth: Array
    inverse: Array


def meet_board(scene: Scene, plate: Plate, rays: RayMap, pose: Pose) -> Meeting | None:
    """Return the pixels whose centre sees the plate or passes it by less than a square; None if none can."""
    R, square = pose.rotation, scene.target.square_m
    if abs(R[:, 2] @ pose.tvec) < 1e-6:  # seen exactly from its edge
        return None
    inverse = np.linalg.inv(np.column_stack([R[:, 0] * square, R[:, 1] * square, pose.tvec]))
    top, bottom, left, right = board_bounds(scene, plate, pose)
    x, y, z = rays.directions[:, top:bottom, left:right]
    a, b, c = (row[0] * x + row[1] * y + row[2] * z for row in inverse)
    (low_u, high_u), (low_v, high_v) = plate.reach
    # Multiplied by the inverse depth c, so that nothing is divided before it is known to be seen.
    seen = (c > 1e-3) & (a > low_u * c) & (a < high_u * c) & (b > low_v * c) & (b < high_v * c)
    rows, columns = np.nonzero(seen)
    if rows.size == 0:
        return None
    c = c[seen]
    uv = np.stack([a[seen], b[seen]], axis=1) / c[:, None]
    return Meeting((rows + top, columns + left), uv, c, inverse)


def board_bounds(scene: Scene, plate: Plate, pose: Pose) -> tuple[int, int, int, int]:
    """Return top, bottom, left, right of the pixels that may see the plate; the whole picture in doubt."""
    width, height = scene.intrinsics.image_size
    (low_u, high_u), (low_v, high_v) = plate.reach
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


def may_meet_edge(meeting: Meeting, plate: Plate, rays: RayMap, size_px: float) -> NDArray[np.bool_]:
    """Return around which pixels (n,) an edge may cross a square of a size, px.

    By a bound that needs no Jacobian per pixel.
    """
    spread = size_px * rays.spread[meeting.pixels] / meeting.inverse_depth
    half = np.empty_like(meeting.uv)
    for axis in range(2):
        x, row, last = meeting.uv[:, axis], meeting.inverse[axis], meeting.inverse[2]
        half[:, axis] = np.sqrt(row @ row + x * (x * (last @ last) - 2.0 * (row @ last))) * spread
    return plate.near_edge(meeting.uv, half)


def board_jacobian(meeting: Meeting, rays: RayMap, at: NDArray[np.intp]) -> Array:
    """Return d(u, v)/d(pixel) (m, 2, 2) at some of the pixels where rays meet the board."""
    rows, columns = (indices[at] for indices in meeting.pixels)
    inverse = meeting.inverse
    by_ray = inverse[None, :2] - meeting.uv[at][:, :, None] * inverse[None, 2:]
    by_pixel = rays.jacobian(rays.directions[:, rows, columns].T)
    jacobian: Array = by_ray / meeting.inverse_depth[at][:, None, None] @ by_pixel
    return jacobian
