"""What makes a live frame hard: motion, glare, things before the board, perforated plates, a second board.

Pure pieces on light (h, w), grey levels at exposure 1, for between `PreparedScene.light` and `sensor.expose`,
or on the background of a prepared scene. Darkness, over-exposure and falloff are values of the scene itself.
Not here: which frames a test or a bench makes of them.
"""

from dataclasses import dataclass, replace

import cv2
import numpy as np

from service.core.vision.target import Target
from service.core.vision.transforms import Array, Pose
from service.simulator.board import make_plate
from service.simulator.renderer import PreparedScene

SUBPIXEL_BITS = 4
PARTS_PER_PX = 4  # of a path, so that its kernel is smooth


@dataclass(frozen=True)
class Holes:
    """A plate with round holes: pitch between them and diameter, px; staggered by half a pitch, or square."""

    pitch_px: float = 24.0
    diameter_px: float = 13.0
    staggered: bool = False
    plate_grey: float = 150.0
    hole_grey: float = 20.0
    turn_deg: float = 0.0


def smear(light: Array, path_px: tuple[float, float]) -> Array:
    """Return light (h, w) as a camera sees it that moves straight by a path (x, y), px, during exposure."""
    length = float(np.hypot(*path_px))
    if length == 0.0:
        return light
    reach = int(np.ceil(max(abs(path_px[0]), abs(path_px[1])) / 2)) + 1
    kernel = np.zeros((2 * reach + 1, 2 * reach + 1))
    parts = int(np.ceil(PARTS_PER_PX * length)) + 1
    along = (np.arange(parts) + 0.5) / parts - 0.5
    x, y = reach + along * path_px[0], reach + along * path_px[1]
    column, row = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    a, b = x - column, y - row
    for dy, dx, weight in (
        (0, 0, (1 - a) * (1 - b)),
        (0, 1, a * (1 - b)),
        (1, 0, (1 - a) * b),
        (1, 1, a * b),
    ):
        np.add.at(kernel, (row + dy, column + dx), weight / parts)
    return np.asarray(cv2.filter2D(light, -1, kernel, borderType=cv2.BORDER_REFLECT_101), dtype=np.float64)


def add_glare(light: Array, centre: tuple[float, float], sigma_px: float, level: float) -> Array:
    """Return light (h, w) with a lamp mirrored at a point, px: a Gaussian of `level` grey levels."""
    height, width = light.shape
    x = np.exp(-0.5 * np.square((np.arange(width) - centre[0]) / sigma_px))
    y = np.exp(-0.5 * np.square((np.arange(height) - centre[1]) / sigma_px))
    glaring: Array = light + level * y[:, None] * x
    return glaring


def occlude(light: Array, outline: Array, grey: float) -> Array:
    """Return light (h, w) with an even thing in front: outline (n, 2), px, convex; soft edges."""
    cover = np.zeros(light.shape, dtype=np.float32)
    points = np.rint(outline * 2**SUBPIXEL_BITS).astype(np.int32)
    cv2.fillConvexPoly(cover, points, 1.0, lineType=cv2.LINE_8, shift=SUBPIXEL_BITS)
    cover = np.asarray(cv2.GaussianBlur(cover, (0, 0), 0.7), dtype=np.float32)
    covered: Array = light + cover * (grey - light)
    return covered


def perforate(size: tuple[int, int], holes: Holes) -> Array:
    """Return the picture (h, w) of a perforated plate for size (width, height), px, grey levels."""
    width, height = size
    turn = np.radians(holes.turn_deg)
    y, x = np.mgrid[:height, :width].astype(np.float64)
    u = (np.cos(turn) * x + np.sin(turn) * y) / holes.pitch_px
    v = (np.cos(turn) * y - np.sin(turn) * x) / holes.pitch_px
    if holes.staggered:  # rows of equilateral triangles
        v = v / np.sqrt(0.75)
        u = u + 0.5 * (np.rint(v) % 2)
        down = (v - np.rint(v)) * np.sqrt(0.75)
    else:
        down = v - np.rint(v)
    distance = np.hypot(u - np.rint(u), down) * holes.pitch_px
    open_share = np.clip(0.5 * holes.diameter_px - distance + 0.5, 0.0, 1.0)
    return np.asarray(holes.plate_grey + (holes.hole_grey - holes.plate_grey) * open_share)


def put_behind(prepared: PreparedScene, target: Target, pose: Pose, gain: float = 1.0) -> PreparedScene:
    """Return the scene with another board in its background, `gain` times as bright as the first."""
    scene = prepared.scene
    other = replace(
        prepared,
        scene=replace(
            scene,
            target=target,
            white_grey=gain * scene.white_grey,
            dark_grey=gain * scene.dark_grey,
        ),
        plate=make_plate(target, scene.border_squares),
    )
    return replace(prepared, background=other.light(pose) / prepared.falloff)
