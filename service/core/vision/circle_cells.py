"""Where a grid of dots must be dark and where bright, and whether dots go on beyond its sides.

Not here: finding the grid (`dot_lattice`), and limits.
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from service.core.vision.circle_grid import apply_homography
from service.core.vision.light import Cells, LightFall
from service.core.vision.sampling import FloatImage, sample_bilinear
from service.core.vision.target_circles import Circles
from service.core.vision.transforms import Array

PLACE_AND_GAPS: Final = np.array([[0.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]])  # in steps
SHARE_OF_A_LINE: Final = 0.5  # of the dots beyond a side that must be there for a larger grid to be spoken of

Image = FloatImage | NDArray[np.uint8]


def read_dots(image: Image, centres: Array, target: Circles) -> Cells:
    """Return the middles of dots, which are dark, and of the gaps in their rows, which are bright."""
    grid = centres.reshape(target.rows, target.columns, 2)
    gaps = 0.5 * (grid[:, 1:] + grid[:, :-1]).reshape(-1, 2)
    places = np.concatenate([centres, gaps])
    bright = np.arange(len(places)) >= len(centres)
    return Cells(places, sample_bilinear(image, places[:, 0], places[:, 1]), bright)


def goes_on(image: Image, light: LightFall, H: Array, target: Circles) -> bool:
    """Whether dots go on beyond a side of the declared grid, which a homography takes into the image, px."""
    row, column, side = _beyond(target)
    board = np.stack([2.0 * column + row % 2, 1.0 * row], axis=-1)[:, None] + PLACE_AND_GAPS
    places = apply_homography(H, board * target.step_m)
    size = np.array([image.shape[1], image.shape[0]])
    shown = np.all((places > 1.0) & (places < size - 2.0), axis=(1, 2))
    bright, dark = light.levels(places[..., 0], places[..., 1])
    is_bright = sample_bilinear(image, places[..., 0], places[..., 1]) > 0.5 * (bright + dark)
    dots = shown & ~is_bright[:, 0] & is_bright[:, 1:].all(axis=1)
    found, length = np.bincount(side[dots], minlength=4), np.bincount(side)
    return bool(np.any(found >= np.maximum(2.0, SHARE_OF_A_LINE * length)))


def _beyond(target: Circles) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Return rows, columns and sides (0 to 3) of the dots that would be next beyond the four sides."""
    across, down = np.arange(target.columns), np.arange(target.rows)
    rows = [np.full_like(across, -1), np.full_like(across, target.rows), down, down]
    columns = [across, across, np.full_like(down, -1), np.full_like(down, target.columns)]
    side = np.repeat(np.arange(4), [len(row) for row in rows])
    return np.concatenate(rows), np.concatenate(columns), side
