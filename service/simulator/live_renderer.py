"""Draws live frames: half size, soft edges instead of exact shares, a fraction of the exact renderer's time.

An edge is a ramp as wide as the pixel's footprint across it, so that corners stay where they are; lamp, lens
and sensor are those of the scene, halved. What is measured on is drawn by the exact renderer.
"""

from dataclasses import replace

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.vision.camera import Intrinsics
from service.core.vision.transforms import Array, Pose
from service.simulator.background import paint_background
from service.simulator.board import make_plate
from service.simulator.lighting import lens_falloff
from service.simulator.meeting import board_bounds
from service.simulator.ray_map import trace_rays
from service.simulator.scene import Scene
from service.simulator.sensor import expose
from service.simulator.soft_edges import Levels

SCALE = 2  # full-size pixels per pixel of a live frame
FINEST_GAUSSIAN_PX = 0.7


class LiveRenderer:
    """A scene ready for live frames at half size (a pixel is the mean of 2x2 of the camera's)."""

    scale = SCALE

    def __init__(self, scene: Scene) -> None:
        """Trace the rays of the half-size picture; takes a third of a second."""
        self._scene = halve_scene(scene)
        self._sensor = replace(self._scene, blur_px=0.0)
        self._kernel = _blur_kernel(self._scene.blur_px)
        self._plate = make_plate(scene.target, scene.border_squares)
        rays = trace_rays(self._scene.intrinsics).directions
        self._rays = np.nan_to_num(rays).astype(np.float32)
        self._reached = np.isfinite(rays[0])
        self._falloff = lens_falloff(self._scene).astype(np.float32)
        background = paint_background(scene.intrinsics.image_size, scene.clutter, scene.seed)
        self._background = _half(background) * self._falloff

    def frame(self, pose: Pose, rng: np.random.Generator) -> NDArray[np.uint8]:
        """Return a frame (h, w) of half the camera's width and height, with the board at a pose."""
        light = self._light(pose)
        if self._scene.blur_px > 0:
            light = np.asarray(cv2.sepFilter2D(light, -1, self._kernel, self._kernel), dtype=np.float32)
        return expose(light, self._sensor, rng)

    def _light(self, pose: Pose) -> Levels:
        light = self._background.copy()
        top, bottom, left, right = board_bounds(self._scene, self._plate, pose)
        R, square = pose.rotation, self._scene.target.square_m
        if min(bottom - top, right - left) < 3 or abs(R[:, 2] @ pose.tvec) < 1e-6:
            return light
        part = np.s_[top:bottom, left:right]
        inverse = np.linalg.inv(np.column_stack([R[:, 0] * square, R[:, 1] * square, pose.tvec]))
        x, y, z = (plane[part] for plane in self._rays)
        a, b, c = (row[0] * x + row[1] * y + row[2] * z for row in inverse.astype(np.float32))
        ahead = (c > 1e-3) & self._reached[part]
        c = np.maximum(c, np.float32(1e-3))
        u, v = a / c, b / c
        plate, dark = self._plate.soft_shares(u, v)
        plate *= ahead
        if R[:, 2] @ pose.tvec < 0:  # the back of the plate has no pattern
            dark[:] = 0.0
        grey = (
            self._scene.white_grey * plate + (self._scene.dark_grey - self._scene.white_grey) * dark * plate
        )
        grey *= self._lamp_gain(pose, u, v) * self._falloff[part]
        light[part] += grey - plate * light[part]
        return light

    def _lamp_gain(self, pose: Pose, u: Levels, v: Levels) -> Levels:
        """Return the lamp's light on the board (h, w), as `lighting.lamp_gain`, in single precision."""
        scene = self._scene
        if scene.shading == 0.0:
            return np.ones_like(u)
        R, square = pose.rotation, scene.target.square_m
        start = pose.tvec - np.array(scene.light_m)
        centre = start + R @ scene.target.centre
        by_u, by_v = 2.0 * square * (start @ R[:, :2])
        distance_sq = u * (np.float32(square**2) * u + np.float32(by_u))
        distance_sq += v * (np.float32(square**2) * v + np.float32(by_v)) + np.float32(start @ start)
        nearness = np.float32(centre @ centre) / np.maximum(distance_sq, np.float32(1e-6))
        return np.asarray(cv2.pow(nearness, 1.5 * scene.shading), dtype=np.float32)


def halve_scene(scene: Scene) -> Scene:
    """Return the scene as a camera with pixels of 2x2 of this one's sees it."""
    full = scene.intrinsics
    vector = full.vector / np.where(np.arange(len(full.vector)) < 4, SCALE, 1)
    vector[2:4] += 0.5 / SCALE - 0.5
    size = (full.image_size[0] // SCALE, full.image_size[1] // SCALE)
    return replace(
        scene,
        intrinsics=Intrinsics.from_vector(full.lens, vector, size),
        blur_px=scene.blur_px / SCALE,
        noise_grey=scene.noise_grey / SCALE,
    )


def _blur_kernel(sigma_px: float) -> Levels:
    """Return a Gaussian's kernel (k,), or three values of its variance where pixels are too coarse for it."""
    if sigma_px < FINEST_GAUSSIAN_PX:
        side = 0.5 * sigma_px**2
        return np.array([side, 1.0 - 2.0 * side, side], dtype=np.float32)
    kernel = cv2.getGaussianKernel(2 * int(np.ceil(4.0 * sigma_px)) + 1, sigma_px, cv2.CV_32F)
    return np.asarray(kernel, dtype=np.float32).ravel()


def _half(picture: Array) -> Levels:
    height, width = (size // SCALE * SCALE for size in picture.shape)
    even = picture[:height, :width].astype(np.float32)
    return np.asarray(cv2.resize(even, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA), dtype=np.float32)
