"""How noisy the corners of a board are at a pose, as far as it can be known before the picture is taken.

Not here: the noise that a calibration finds (`core.vision.calibration`).
"""

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from service.core.planning.visibility import Visibility
from service.core.vision.transforms import Array

REFERENCE_SQUARE_PX: Final = 30.0
REFERENCE_BLUR_PX: Final = 0.7
# Blur is a sum of squares: at the near and far limits of the depth of field it gains so much, px (sigma).
DEFOCUS_AT_LIMIT_PX: Final = 1.0
SMALLEST_COSINE: Final = 0.05


@dataclass(frozen=True)
class CornerNoise:
    """Standard deviation of a detected corner, px per coordinate.

    level_px: of a frontal board with squares of 30 px whose picture is as sharp as the lens makes it; times
    powers of the smallest square over 30 px (by_square; beyond 30 px more of an edge is not looked at), of
    the cosine of the largest incidence (by_slant), of the blur's sigma over 0.7 px (by_blur). aliasing_px:
    what the pixel grid adds, in squares, where edges run along it and blur is 0.7 px; it changes with a power
    of the blur (aliasing_by_blur). source: where the numbers come from.
    """

    level_px: float
    by_square: float = 0.0
    by_slant: float = 0.0
    by_blur: float = 0.0
    aliasing_px: float = 0.0
    aliasing_by_blur: float = 0.0
    source: str = "one for all poses"

    def sigma_px(self, seen: Visibility, blur_px: Array) -> Array:
        """Return the noise (m,) of m poses, from what they look like and their blur (m,), sigma in px."""
        square = np.clip(seen.smallest_square_px, 1.0, REFERENCE_SQUARE_PX) / REFERENCE_SQUARE_PX
        slant = np.maximum(np.cos(seen.incidence_rad), SMALLEST_COSINE)
        blur = blur_px / REFERENCE_BLUR_PX
        random = self.level_px * square**self.by_square * slant**self.by_slant * blur**self.by_blur
        aliasing = self.aliasing_px * grid_alignment(seen.skew) * blur**self.aliasing_by_blur
        return np.hypot(random, aliasing)

    def at_level(self, level_px: float) -> "CornerNoise":
        """Return the same dependence on the pose at another level."""
        share = level_px / self.level_px
        return replace(self, level_px=level_px, aliasing_px=share * self.aliasing_px)


# By `python -m bench corner_noise`: 360 poses of the paper's lenses under a line's light, noise of 2 grey
# levels; the logarithm scatters by 0.07 about it.
FITTED_NOISE: Final = CornerNoise(
    level_px=0.0043,
    by_square=-0.4524,
    by_slant=-0.1949,
    by_blur=0.4366,
    aliasing_px=0.0023,
    aliasing_by_blur=0.4380,
    source="fit of 2026-11: rendered boards, corners where edges cross (bench corner_noise)",
)


def grid_alignment(skew: Array) -> Array:
    """Return how much aliasing edges of a skew (m,), see `Visibility`, show: 1 along the pixel grid, to 0."""
    return np.asarray((1.0 - np.clip(skew, 0.0, 1.0)) ** 1.5)


def blur_at(seen: Visibility, depth_of_field_m: tuple[float, float] | None) -> Array:
    """Return the blur (m,), sigma in px, of boards: at the middle of their depths.

    A thin lens's blur grows with the difference of the inverse depths; the plane of focus lies between the
    limits of the depth of field where their blur is equal. None: everything is in focus.
    """
    if depth_of_field_m is None:
        return np.full(len(seen.nearest_m), REFERENCE_BLUR_PX)
    near, far = (1.0 / limit for limit in depth_of_field_m)
    depths = 0.5 * (seen.nearest_m + seen.farthest_m)
    off_focus = np.abs(1.0 / depths - 0.5 * (near + far)) / max(0.5 * abs(near - far), 1e-9)
    return np.hypot(REFERENCE_BLUR_PX, DEFOCUS_AT_LIMIT_PX * off_focus)


def noise_at(
    noise: float | CornerNoise, seen: Visibility, depth_of_field_m: tuple[float, float] | None = None
) -> Array:
    """Return the corner noise (m,), px, of m poses: a number means the same for all."""
    if isinstance(noise, CornerNoise):
        return noise.sigma_px(seen, blur_at(seen, depth_of_field_m))
    return np.full(len(seen.nearest_m), float(noise))
