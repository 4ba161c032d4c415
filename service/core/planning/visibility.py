"""How a camera sees a target at many poses, and where in the image a target of a size and turn can be.

Not here: which bounds that must meet (`pose_space`).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.camera import Intrinsics, project, reach_share, unproject
from service.core.vision.target import Target
from service.core.vision.transforms import Array

# So many rounds place a board to a fraction of a pixel, for which the slack is left; a wide lens needs them
# all.
PLACING_ROUNDS = 4
PLACING_SLACK_PX = 0.5
# This share of the boards touches the left or right margin, and the upper or lower one: the optimum lies
# there.
BORDER_SHARE = 0.25
# A lens model is trusted up to this share of the radius where it turns back.
LENS_SHARE = 0.98
# Words such as left and closer lead a hand no farther aside than this; only a fisheye sees boards beyond.
FARTHEST_ASIDE_RAD = float(np.deg2rad(62.0))


@dataclass(frozen=True)
class Visibility:
    """What m poses look like; arrays (m,), NaN where the lens has no image; image_points (m, n, 2) px.

    clearance_px: least distance of a corner, or of a dot's rim, from the image border, negative outside.
    smallest_square_px: shortest side of a square. incidence_rad: largest angle between the board's normal and
    the line of sight to a corner. lens_share: how far out the outermost corner is, as a share of the reach of
    the lens. aside_rad: angle between the optical axis and the line of sight to the target's centre.
    nearest_m, farthest_m: smallest and largest depth of a corner. columns: of the target's corners.
    """

    clearance_px: Array
    smallest_square_px: Array
    incidence_rad: Array
    lens_share: Array
    aside_rad: Array
    nearest_m: Array
    farthest_m: Array
    image_points: Array
    columns: int

    @property
    def skew(self) -> Array:
        """Mean |sin 2θ| (m,) of the edges' angle θ to the pixel grid, of rows or columns, whichever is less.

        0 where edges run along the pixel grid, 1 where all run at 45° to it.
        """
        grid = self.image_points.reshape(len(self.image_points), -1, self.columns, 2)
        means = []
        for axis in (1, 2):
            x, y = np.moveaxis(np.diff(grid, axis=axis), -1, 0)
            means.append(np.mean(np.abs(2.0 * x * y) / (x * x + y * y), axis=(1, 2)))
        skew: Array = np.minimum(*means)
        return skew

    def part(self, index: NDArray[np.bool_] | slice) -> "Visibility":
        """Return what some of the poses look like."""
        arrays = {name: value[index] for name, value in self.__dict__.items() if name != "columns"}
        return Visibility(**arrays, columns=self.columns)

    @staticmethod
    def join(parts: "Sequence[Visibility]") -> "Visibility":
        """Return what the poses of all parts look like, in their order."""
        names = [name for name in parts[0].__dict__ if name != "columns"]
        arrays = {name: np.concatenate([getattr(part, name) for part in parts]) for name in names}
        return Visibility(**arrays, columns=parts[0].columns)


def measure_visibility(
    intrinsics: Intrinsics, target: Target, rotations: Array, translations: Array
) -> Visibility:
    """Return what poses (m, 3, 3), (m, 3) look like to a camera."""
    points = target.object_points @ np.swapaxes(rotations, -1, -2) + translations[:, None, :]
    pixels = project(intrinsics, rotations, translations, target.object_points)
    to_border = np.minimum(pixels, np.array(intrinsics.image_size) - 1.0 - pixels)
    centres = rotations @ target.centre + translations
    length = np.sqrt(points[..., 0] ** 2 + points[..., 1] ** 2 + points[..., 2] ** 2)
    cosine = (points @ rotations[:, :, 2, None])[..., 0] / length
    return Visibility(
        clearance_px=(to_border.min(axis=2) - _reach_px(intrinsics, target, points)).min(axis=1),
        smallest_square_px=_shortest_side(pixels, target),
        incidence_rad=np.arccos(np.clip(cosine.min(axis=1), -1.0, 1.0)),
        lens_share=reach_share(intrinsics, points).max(axis=1),
        aside_rad=np.arctan2(np.hypot(centres[:, 0], centres[:, 1]), centres[:, 2]),
        nearest_m=points[..., 2].min(axis=1),
        farthest_m=points[..., 2].max(axis=1),
        image_points=pixels,
        columns=target.columns,
    )


def place_targets(
    intrinsics: Intrinsics,
    target: Target,
    rotations: Array,
    distances: Array,
    *,
    places: Array,
    margin_px: float,
) -> Array:
    """Return translations (m, 3), m, that put targets at `places` (m, 2), 0…1 of where they fit.

    rotations: (m, 3, 3); distances: (m,) of the centre from the camera, m. Low places touch the left or top
    margin, high ones the right or bottom one, BORDER_SHARE in all; those between are spread evenly. Where a
    board does not fit at all its translation is NaN.
    """
    size = np.array(intrinsics.image_size, dtype=np.float64)
    shares = np.clip((places - 0.5) / (1.0 - BORDER_SHARE) + 0.5, 0.0, 1.0)
    margin_px += PLACING_SLACK_PX
    centre_px = np.tile((size - 1.0) / 2.0, (len(rotations), 1))
    outline = target.object_points[list(target.outer_corners)]
    turned = outline @ np.swapaxes(rotations, -1, -2)
    translations = _translations(intrinsics, target, rotations, distances, centre_px)
    for _ in range(PLACING_ROUNDS):
        pixels = project(intrinsics, rotations, translations, outline)
        reach = _reach_px(intrinsics, target, turned + translations[:, None])[..., None]
        low = margin_px + centre_px - (pixels - reach).min(axis=1)
        high = size - 1.0 - margin_px - ((pixels + reach).max(axis=1) - centre_px)
        centre_px = np.where(low <= high, low + shares * (high - low), np.nan)
        translations = _translations(intrinsics, target, rotations, distances, centre_px)
    return translations


def _translations(
    intrinsics: Intrinsics, target: Target, rotations: Array, distances: Array, centre_px: Array
) -> Array:
    """Return translations (m, 3) of targets whose centres lie on the rays of pixels (m, 2)."""
    rays = unproject(intrinsics, centre_px)
    centres = rays * (distances / np.linalg.norm(rays, axis=1))[:, None]
    translations: Array = centres - rotations @ target.centre
    return translations


def _reach_px(intrinsics: Intrinsics, target: Target, points: Array) -> Array:
    """Return how far, px (...), the print of features at points (..., 3) m, camera frame, reaches at most."""
    scale = float(np.diag(intrinsics.camera_matrix)[:2].max())
    with np.errstate(divide="ignore"):
        reach: Array = target.reach_m * scale * np.linalg.norm(points, axis=-1) / points[..., 2] ** 2
    return reach


def _shortest_side(pixels: Array, target: Target) -> Array:
    """Return the shortest distance (m,) between neighbouring corners of image points (m, n, 2)."""
    grid = pixels.reshape(-1, target.rows, target.columns, 2)
    along_rows = np.linalg.norm(np.diff(grid, axis=2), axis=-1).min(axis=(1, 2))
    along_columns = np.linalg.norm(np.diff(grid, axis=1), axis=-1).min(axis=(1, 2))
    shortest: Array = np.minimum(along_rows, along_columns)
    return shortest
