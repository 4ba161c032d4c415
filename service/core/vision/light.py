"""How light falls across a board: the grey levels of its bright and its dark squares as smooth surfaces, and
how much of the bright ones is saturated.

Light that falls off across a corner tilts the grey surface and moves its saddle point (by a tenth of a pixel
under a lamp beside the lens); levels that are taken relative to both surfaces do not have that tilt.
Saturation hides how the light fell. Not here: whether the squares alternate (`parity`).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.problems import TargetOverexposed
from service.core.vision.sampling import FloatImage, sample_bilinear
from service.core.vision.transforms import Array

CELLS_FOR_CURVATURE = 10
CLIPPED = (
    254.0  # grey level; the whites of real pictures, and JPEG's ringing, reach 253 without being clipped
)
LARGEST_SATURATED_SHARE = 0.5  # above it the light on the board is not known any more
PLACES = np.linspace(0.1, 0.9, 9)  # of a square, where clipping is looked for


@dataclass(frozen=True)
class Cells:
    """A board's inner cells: centres (n, 2) px, mean grey levels (n,), and which should be bright (n,)."""

    centres: Array
    levels: Array
    bright: NDArray[np.bool_]


@dataclass(frozen=True)
class LightFall:
    """Second-order surfaces: coefficients (6,) of bright and dark over ((x, y) − middle) / scale, in px."""

    bright: Array
    dark: Array
    middle: Array
    scale: float

    def levels(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Return the grey levels of bright and dark squares at x, y px, which are broadcast."""
        x, y = (x - self.middle[0]) / self.scale, (y - self.middle[1]) / self.scale
        return _surface(self.bright, x, y), _surface(self.dark, x, y)


def read_cells(blurred: FloatImage, corners: Array, dark_first: bool = True) -> Cells:
    """Return the inner cells of a board's corners (rows, columns, 2) px; the first should be dark, or not."""
    a, b, c, d = corners[:-1, :-1], corners[:-1, 1:], corners[1:, 1:], corners[1:, :-1]
    total = np.zeros(a.shape[:2])
    for u in (0.35, 0.5, 0.65):
        for v in (0.35, 0.5, 0.65):
            spot = (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * d + u * c)
            total += sample_bilinear(blurred, spot[..., 0], spot[..., 1])
    row, column = np.indices(total.shape)
    centres = 0.25 * (a + b + c + d)
    return Cells(centres.reshape(-1, 2), total.ravel() / 9.0, ((row + column) % 2 == dark_first).ravel())


def saturated_share(
    image: NDArray[np.uint8],
    corners: Array,
    bright: NDArray[np.bool_],
    level: float = CLIPPED,
    places: Sequence[float] | Array = PLACES,
) -> float:
    """Return the share of spots in the bright squares of an image (h, w) that have at least a grey level.

    corners: (rows, columns, 2) px; bright: (rows - 1, columns - 1), which inner squares are bright; places:
    where spots lie across and down each square, from 0 to 1.
    """
    a, b, c, d = (
        part[bright] for part in (corners[:-1, :-1], corners[:-1, 1:], corners[1:, 1:], corners[1:, :-1])
    )
    across, down = (grid.reshape(-1, 1, 1) for grid in np.meshgrid(places, places))
    top = a * (1.0 - across) + b * across
    bottom = d * (1.0 - across) + c * across
    spots = top * (1.0 - down) + bottom * down
    return float(np.mean(sample_bilinear(image, spots[..., 0], spots[..., 1]) >= level))


def fit_light(cells: Cells) -> LightFall:
    """Return the surfaces through the levels of bright and dark cells: planes where the cells are few."""
    middle = cells.centres.mean(axis=0)
    scale = float(np.abs(cells.centres - middle).max())
    surfaces = []
    for part in (cells.bright, ~cells.bright):
        x, y = ((cells.centres[part] - middle) / scale).T
        used = 6 if len(x) >= CELLS_FOR_CURVATURE else 3
        coefficients = np.zeros(6)
        coefficients[:used] = np.linalg.lstsq(_terms(x, y)[:, :used], cells.levels[part], rcond=None)[0]
        surfaces.append(coefficients)
    return LightFall(surfaces[0], surfaces[1], middle, scale)


def even_out(
    blurred: FloatImage, light: LightFall, corners: Array, margin_px: int
) -> tuple[FloatImage, Array]:
    """Return the image around corners (n, 2) px in levels from 0 (dark) to 1 (bright), and its origin px.

    Where the surfaces meet or cross (far outside the board) their distance is held at a tenth of its median.
    """
    size = np.array([blurred.shape[1], blurred.shape[0]])
    low = np.maximum(np.floor(corners.min(axis=0)).astype(int) - margin_px, 0)
    high = np.minimum(np.ceil(corners.max(axis=0)).astype(int) + margin_px + 1, size)
    y, x = np.ogrid[low[1] : high[1], low[0] : high[0]]
    bright, dark = light.levels(x.astype(np.float64), y.astype(np.float64))
    gap = bright - dark
    gap = np.maximum(gap, max(0.1 * float(np.median(gap)), 1e-3))
    part = blurred[low[1] : high[1], low[0] : high[0]]
    return np.asarray((part - dark) / gap, dtype=np.float32), low.astype(np.float64)


def check_exposure(saturated: float) -> float:
    """Return the saturated share of a target's bright squares; raises TargetOverexposed where it is most."""
    if saturated > LARGEST_SATURATED_SHARE:
        raise TargetOverexposed(
            f"{saturated:.0%} of the board's bright squares are saturated. Dim the lamp, shade the window or "
            "shorten the exposure, then take the image again.",
            saturated_share=round(saturated, 3),
        )
    return saturated


def _surface(c: Array, x: Array, y: Array) -> Array:
    level: Array = c[0] + x * (c[1] + c[3] * x) + y * (c[2] + c[5] * y) + c[4] * (x * y)
    return level


def _terms(x: Array, y: Array) -> Array:
    return np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=-1)
