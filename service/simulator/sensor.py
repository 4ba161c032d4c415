"""From light to grey levels: blur, noise, saturation, quantisation. Not here: what the light shows."""

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.vision.transforms import Array
from service.simulator.scene import Scene

Levels = NDArray[np.float32]

NOISE_LEVEL = 128.0
FIRST_BLUR_PX = 0.25
LEAST_BLUR_PX = 0.65  # with less, too little would be left for whole pixels to carry


def expose(light: Array | Levels, scene: Scene, rng: np.random.Generator) -> NDArray[np.uint8]:
    """Return the picture (h, w) that a scene's sensor reads from light (h, w), grey levels at exposure 1."""
    levels = (light * scene.exposure).astype(np.float32)  # 24 bits: a millionth of a grey level is kept
    if scene.blur_px > 0:
        levels = _blur(levels, scene.blur_px)
    if scene.noise_grey > 0:
        levels = levels + _noise(levels, scene, rng)
    return np.clip(np.rint(levels), 0, 255).astype(np.uint8)


def first_blur(blur_px: float) -> Array:
    """Return the offsets (m, 2) px over which light is averaged before pixels divide it, of a lens's blur.

    A step that pixels alone divide is skewed by where it falls in its pixel, which no blur afterwards takes
    away: corners of edges along the pixel grid would be off by a hundredth of a pixel, as in no camera. Two
    offsets cancel what is as fine as the pixels, along rows and columns both.
    """
    if blur_px < LEAST_BLUR_PX:
        return np.zeros((1, 2))
    return FIRST_BLUR_PX * np.array([[-1.0, -1.0], [1.0, 1.0]])


def _blur(levels: Levels, sigma_px: float) -> Levels:
    """Return levels (h, w) blurred by what the first blur has left of a round Gaussian."""
    first = first_blur(sigma_px)
    spread = np.linalg.inv(sigma_px**2 * np.eye(2) - first.T @ first / len(first))
    reach = int(np.ceil(4.0 * sigma_px))
    y, x = np.mgrid[-reach : reach + 1, -reach : reach + 1]
    kernel = np.exp(-0.5 * (spread[0, 0] * x * x + 2.0 * spread[0, 1] * x * y + spread[1, 1] * y * y))
    blurred = cv2.filter2D(levels, -1, kernel / kernel.sum(), borderType=cv2.BORDER_REFLECT_101)
    return blurred.astype(np.float32, copy=False)


def _noise(levels: Levels, scene: Scene, rng: np.random.Generator) -> Levels:
    """Return noise (h, w): read noise, the same everywhere, and shot noise that follows the level."""
    read, shot = scene.noise_grey**2 * np.array([1.0 - scene.shot_share, scene.shot_share / NOISE_LEVEL])
    sd = np.sqrt(np.float32(read) + np.float32(shot) * np.maximum(levels, 0.0))
    noise: Levels = sd * rng.standard_normal(levels.shape, dtype=np.float32)
    return noise
