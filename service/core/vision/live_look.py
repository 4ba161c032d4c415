"""How bright and how sharp a board looks in a live frame: estimates from a few hundred samples.

Not here: what is measured on a capture (`sharpness`, `light`).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.light import saturated_share
from service.core.vision.sampling import sample_bilinear
from service.core.vision.transforms import Array

REACH = 0.4  # of the square on either side of an edge, where it is over
SLOPE_TO_WIDTH = 1.022  # of a Gaussian edge: 10–90 % width, times its steepest slope, over its height
SATURATED = 250.0  # grey level from which a pixel says no more
SPOTS = (0.25, 0.5, 0.75)  # of a square, where glare is looked for
OWN_WIDTH_PX = 1.38  # that a perfectly sharp edge seems to have, by pixels and by sampling between them


@dataclass(frozen=True)
class Look:
    """edge_width_px: 10–90 % width of the edges; brightness: grey level of the bright squares.

    glare_share: of spots in the bright squares, those that are saturated.
    """

    edge_width_px: float
    brightness: float
    glare_share: float


def measure_look(image: NDArray[np.uint8], corners: Array, dark_first: bool) -> Look:
    """Return how a board with corners (rows, columns, 2) px looks in an image (h, w)."""
    rows, columns = corners.shape[:2]
    middle = 0.25 * (corners[:-1, :-1] + corners[1:, :-1] + corners[:-1, 1:] + corners[1:, 1:])
    levels = sample_bilinear(image, middle[..., 0], middle[..., 1])
    row, column = np.indices((rows - 1, columns - 1))
    bright = (row + column) % 2 == dark_first
    widths = np.concatenate([_edge_widths(image, corners), _edge_widths(image, np.swapaxes(corners, 0, 1))])
    width_sq = float(np.median(widths)) ** 2 - OWN_WIDTH_PX**2
    return Look(
        edge_width_px=float(np.sqrt(max(width_sq, 0.0))),
        brightness=float(levels[bright].mean()),
        glare_share=saturated_share(image, corners, bright, SATURATED, SPOTS),
    )


def look_along_edges(
    image: NDArray[np.uint8], middles: Array, across: Array, dark_px: Array, bright_px: Array
) -> Look:
    """Return how a board with edges at (k, 2) px looks in an image (h, w), where markers leave little room.

    across: (k, 2), of length one, at a right angle to the edges; dark_px, bright_px: (k,) how far an edge's
    dark and bright side are plain. Only the dark side need be wide enough for a level: an edge is even.
    """
    two = sample_bilinear(image, *_beside(middles, across, np.array([-0.5, 0.5])))
    slope, middle = two[:, 1] - two[:, 0], two.mean(axis=1)
    brighter = np.where(slope > 0, 1.0, -1.0)[:, None] * across
    far = np.stack([-REACH * dark_px, 0.5 * bright_px], axis=-1)
    dark, bright = sample_bilinear(image, *_beside(middles, brighter, far)).T
    height = np.maximum(2.0 * (middle - dark), 0.0)
    width_sq = float(np.median(SLOPE_TO_WIDTH * height / np.maximum(np.abs(slope), 1e-3))) ** 2
    return Look(
        edge_width_px=float(np.sqrt(max(width_sq - OWN_WIDTH_PX**2, 0.0))),
        brightness=float(np.mean(dark + height)),
        glare_share=float(np.mean(bright >= SATURATED)),
    )


def _beside(middles: Array, across: Array, steps: Array) -> tuple[Array, Array]:
    """Return x and y (k, s) of places at steps (s,) or (k, s), px, from the edges."""
    spots = middles[:, None] + np.broadcast_to(steps, (len(middles), 2))[..., None] * across[:, None]
    return spots[..., 0], spots[..., 1]


def _edge_widths(image: NDArray[np.uint8], corners: Array) -> Array:
    """Return the 10–90 % widths (n,) px of the edges along the inner rows, by their slope in the middle."""
    start, end = corners[1:-1, :-1], corners[1:-1, 1:]
    along = end - start
    normal = np.stack([-along[..., 1], along[..., 0]], axis=-1)
    normal /= np.maximum(np.linalg.norm(along, axis=-1, keepdims=True), 1e-9)
    reach = REACH * np.abs(np.sum((corners[2:, :-1] - start) * normal, axis=-1))
    half = np.full(reach.shape, 0.5)
    offsets = np.stack([-reach, -half, half, reach], axis=-1)
    spots = 0.5 * (start + end)[..., None, :] + offsets[..., None] * normal[..., None, :]
    values = sample_bilinear(image, spots[..., 0], spots[..., 1])
    height, slope = np.abs(values[..., 3] - values[..., 0]), np.abs(values[..., 2] - values[..., 1])
    return np.asarray(SLOPE_TO_WIDTH * height / np.maximum(slope, 1e-3), dtype=np.float64).ravel()
