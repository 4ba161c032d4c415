"""Two calibrated cameras side by side: their parameters in standard deviations, and their mappings in px.

What both share, such as a bent board, is in neither covariance: two runs on one board agree better than the
camera is known. Not here: the difference of two mappings as one figure (`uncertainty`), limits
(`service.core.quality`).
"""

import math
from dataclasses import dataclass

import numpy as np

from service.core.errors import IntrinsicsInvalid, WrongImageSize
from service.core.vision.camera import Intrinsics, project, reach_share, unproject
from service.core.vision.transforms import Array
from service.core.vision.uncertainty import GRID, Region, best_turn, mapping_error


@dataclass(frozen=True)
class CalibratedCamera:
    """Intrinsics and the covariance (p, p) of their parameters, zero where fixed."""

    intrinsics: Intrinsics
    covariance: Array


@dataclass(frozen=True)
class ParameterDifference:
    """b minus a of each parameter, and the sd of that difference, both (p,); zero sd where both are fixed.

    distance_sd: √(δᵀ (Σa + Σb)⁻¹ δ / free), near one where noise alone sets the two apart; NaN where nothing
    is free.
    """

    difference: Array
    sd: Array
    distance_sd: float


@dataclass(frozen=True)
class MappingOffsets:
    """Where b sees what a sees at m pixels, minus those pixels, after the best rotation: (m, 2) px.

    angles_mdeg (m,): the angle between a's rays of the two pixels. NaN where a lens does not reach.
    """

    offsets_px: Array
    angles_mdeg: Array


def compare_parameters(a: CalibratedCamera, b: CalibratedCamera) -> ParameterDifference:
    """Return how far the parameters of two cameras of one lens model are apart.

    Raises IntrinsicsInvalid for two lens models, whose parameters mean different things.
    """
    if a.intrinsics.lens != b.intrinsics.lens:
        raise IntrinsicsInvalid(
            f"The lens models differ ({a.intrinsics.lens} and {b.intrinsics.lens}), so their parameters mean "
            "different things. Compare the mappings, or runs of one lens model."
        )
    difference = b.intrinsics.vector - a.intrinsics.vector
    covariance = a.covariance + b.covariance
    free = np.flatnonzero(np.diagonal(covariance) > 0)
    apart, both = difference[free], covariance[np.ix_(free, free)]
    squared = float(apart @ np.linalg.solve(both, apart)) if len(free) else float("nan")
    return ParameterDifference(
        difference, np.sqrt(np.diagonal(covariance)), float(np.sqrt(squared / max(len(free), 1)))
    )


def compare_mappings(a: Intrinsics, b: Intrinsics, pixels: Array, held: Region | Array) -> MappingOffsets:
    """Return where b sees what a sees at pixels (m, 2), the best rotation taken out.

    held: the region or pixels of a over which the rotation is the best one. The lens models may differ.
    Raises WrongImageSize for two image sizes, IntrinsicsInvalid where b reaches nothing of `held`.
    """
    if tuple(a.image_size) != tuple(b.image_size):
        raise WrongImageSize(
            f"The images differ in size ({_size(a)} and {_size(b)} px), so a pixel of one is none of the "
            "other. Compare runs of one image size."
        )
    R = _turn(a, b, held.grid(*GRID) if isinstance(held, Region) else held)
    turned = unproject(a, pixels) @ R.T
    reached = reach_share(b, turned) < 1.0
    seen = np.full(np.shape(pixels), np.nan)
    seen[reached] = project(b, np.eye(3), np.zeros(3), turned[reached])
    return MappingOffsets(seen - pixels, _angles_mdeg(a, pixels, seen))


def expected_difference(a: CalibratedCamera, b: CalibratedCamera, region: Region | Array) -> float:
    """Return the rms difference, px, that noise alone leads to between two such calibrations of one camera.

    As the cameras are not the same, each error is taken by its own model; inf where a lens does not reach.
    """
    errors = [mapping_error(one.intrinsics, one.covariance, region).mean_px for one in (a, b)]
    return math.hypot(*errors)


def _turn(a: Intrinsics, b: Intrinsics, pixels: Array) -> Array:
    rays = unproject(a, pixels)
    reached = reach_share(b, rays) < 1.0
    if np.count_nonzero(reached) < 2:
        raise IntrinsicsInvalid(
            "The lens of one camera reaches nothing of what the other one sees. Check that both results are "
            "of usable calibrations."
        )
    return best_turn(b, rays[reached], pixels[reached])[0]


def _angles_mdeg(camera: Intrinsics, pixels: Array, others: Array) -> Array:
    """Return the angles (m,), mdeg, between the rays of pixels (m, 2) and of others (m, 2)."""
    rays, moved = unproject(camera, pixels), unproject(camera, others)
    across = np.linalg.norm(np.cross(rays, moved), axis=-1)
    return np.asarray(1e3 * np.rad2deg(np.arctan2(across, np.sum(rays * moved, axis=-1))))


def _size(intrinsics: Intrinsics) -> str:
    return "x".join(map(str, intrinsics.image_size))
