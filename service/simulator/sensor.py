"""From light to grey levels: blur, noise, saturation, quantisation. Not here: what the light shows."""

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.vision.transforms import Array
from service.simulator.scene import Scene

Levels = NDArray[np.float32]

NOISE_LEVEL = 128.0


def expose(light: Array | Levels, scene: Scene, rng: np.random.Generator) -> NDArray[np.uint8]:
    """Return the picture (h, w) that a scene's sensor reads from light (h, w), grey levels at exposure 1."""
    levels = (light * scene.exposure).astype(np.float32)  # 24 bits: a millionth of a grey level is kept
    if scene.blur_px > 0:
        levels = _blur(levels, scene.blur_px)
    if scene.noise_grey > 0:
        levels = levels + _noise(levels, scene, rng)
    return np.clip(np.rint(levels), 0, 255).astype(np.uint8)


def _blur(levels: Levels, sigma_px: float) -> Levels:
    size = 2 * int(np.ceil(4.0 * sigma_px)) + 1
    blurred = cv2.GaussianBlur(levels, (size, size), sigma_px, borderType=cv2.BORDER_REFLECT_101)
    return blurred.astype(np.float32, copy=False)


def _noise(levels: Levels, scene: Scene, rng: np.random.Generator) -> Levels:
    """Return noise (h, w): read noise, the same everywhere, and shot noise that follows the level."""
    read, shot = scene.noise_grey**2 * np.array([1.0 - scene.shot_share, scene.shot_share / NOISE_LEVEL])
    sd = np.sqrt(np.float32(read) + np.float32(shot) * np.maximum(levels, 0.0))
    noise: Levels = sd * rng.standard_normal(levels.shape, dtype=np.float32)
    return noise
