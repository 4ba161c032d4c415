"""How much light falls on the board and how much of it the lens lets through. Not here: what reflects it."""

import numpy as np

from service.core.vision.transforms import Array, Pose
from service.simulator.scene import Scene


def lamp_gain(scene: Scene, pose: Pose, uv: Array) -> Array:
    """Return the lamp's light on board points (n, 2), squares, as a share of what the board's centre gets.

    A small lamp's light on a plane falls with the cube of the distance: its square by spreading, the rest by
    the slant.
    """
    if scene.shading == 0.0:
        return np.ones(len(uv))
    R, square = pose.rotation, scene.target.square_m
    start = pose.tvec - np.array(scene.light_m)
    centre = start + R @ scene.target.centre
    u, v = uv[:, 0] * square, uv[:, 1] * square
    distance_sq = start @ start + u * (u + 2.0 * (R[:, 0] @ start)) + v * (v + 2.0 * (R[:, 1] @ start))
    gain: Array = (centre @ centre / np.maximum(distance_sq, 1e-6)) ** (1.5 * scene.shading)
    return gain


def lens_falloff(scene: Scene) -> Array:
    """Return the share of light (h, w) that reaches each pixel: a Gaussian about the scene's light centre."""
    width, height = scene.intrinsics.image_size
    x = np.arange(width) - scene.light_centre[0] * (width - 1)
    y = np.arange(height) - scene.light_centre[1] * (height - 1)
    distance_sq = np.square(x) + np.square(y)[:, None]
    falloff: Array = np.exp(np.log1p(-scene.falloff) * distance_sq / distance_sq.max())
    return falloff
