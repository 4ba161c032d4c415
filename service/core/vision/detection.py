"""From a captured image to the corners of the declared target, or to the reason why not.

Full resolution and careful, for a capture; a live frame has another detector. Corners are looked for at
several scales, numbered, completed and proven in the full image, and refined by a saddle fit.
Not here: limits on sharpness, parity and contrast (`quality.gates`); poses.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.errors import TargetNotVisible, Unprocessable
from service.core.vision.board import (
    is_larger,
    is_whole,
    order_corners,
    refuse_larger,
    refuse_partial,
    whole_lines,
)
from service.core.vision.corner_candidates import find_corners
from service.core.vision.corner_grid import CornerGrid, link_corners, number_corners
from service.core.vision.grid_growth import complete_grid, measure_steps
from service.core.vision.parity import Parity, measure_parity
from service.core.vision.saddle import refine_saddles
from service.core.vision.sampling import FloatImage, smooth
from service.core.vision.sharpness import Sharpness, measure_sharpness
from service.core.vision.target import Chessboard
from service.core.vision.transforms import Array

SMALLEST_IMAGE_PX = 32
COMFORTABLE_PX = 800  # long side at which most boards are found first
GRIDS_PER_SCALE = 3
PROVING_SIGMA_PX = 1.2
REFINING_SIGMA_PX = 1.5
LEAST_SEPARATION = 0.2


@dataclass(frozen=True)
class Detection:
    """A target found in an image.

    image_points: (n, 2) px. corner_ids: (n,) indices into target.object_points. image_size: (width, height)
    px. parity_separation and contrast: see `Parity`.
    """

    image_points: Array
    corner_ids: NDArray[np.int64]
    image_size: tuple[int, int]
    sharpness: Sharpness
    parity_separation: float
    contrast: float


def detect_target(image: NDArray[np.uint8], target: Chessboard) -> Detection:
    """Return the target's corners in a grey image (h, w), all of them, in the order of target.object_points.

    Raises TargetNotVisible when there is no board or not the whole of it (facts: corners_seen,
    corners_needed), WrongTarget when the board has more rows or columns than declared (facts: found_columns,
    found_rows), Unprocessable when the array is no grey image.
    """
    check_grey_image(image)
    grey = image.astype(np.float32)
    grid = _find_board(image, smooth(grey, PROVING_SIGMA_PX), target)
    blurred = smooth(grey, REFINING_SIGMA_PX)
    corners = order_corners(_refined(blurred, grid, target), target)
    on_grid = corners.reshape(target.rows, target.columns, 2)
    parity = measure_parity(blurred, on_grid)
    _check_parity(parity, target)
    return Detection(
        image_points=corners,
        corner_ids=np.arange(len(corners)),
        image_size=(image.shape[1], image.shape[0]),
        sharpness=measure_sharpness(grey, on_grid),
        parity_separation=parity.separation,
        contrast=parity.contrast,
    )


def check_grey_image(image: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return the image if it is grey (h, w), 8 bit and at least 32x32 px; raises Unprocessable otherwise."""
    if image.ndim != 2 or image.dtype != np.uint8:
        raise Unprocessable(
            f"Give a grey image of 8 bits; this array has {image.ndim} dimensions of {image.dtype}."
        )
    if min(image.shape) < SMALLEST_IMAGE_PX:
        height, width = image.shape
        raise Unprocessable(f"An image must be at least 32x32 px; this one is {width}x{height}.")
    return image


def _find_board(image: NDArray[np.uint8], blurred: FloatImage, target: Chessboard) -> CornerGrid:
    """Return the grid that is the target. Raises TargetNotVisible or WrongTarget."""
    most_seen = 0
    for scaled, scale in _scales(image):
        grids = [whole_lines(grid) for grid in _grids(scaled, scale, blurred, target)]
        whole = next((grid for grid in grids if is_whole(grid, target)), None)
        if whole is not None:
            return whole
        larger = next((grid for grid in grids if is_larger(grid, target)), None)
        if larger is not None:
            raise refuse_larger(larger, target)
        most_seen = max([most_seen, *(int(grid.known.sum()) for grid in grids)])
    raise refuse_partial(most_seen, target)


def _scales(image: NDArray[np.uint8]) -> Iterator[tuple[NDArray[np.uint8], float]]:
    """The image at halves and doubles of a comfortable size, never above its own."""
    halvings = max(0, round(np.log2(max(image.shape) / COMFORTABLE_PX)))
    order = [halvings, halvings - 1, halvings + 1, halvings - 2]
    for n in order:
        scale = 0.5**n
        if n < 0 or min(image.shape) * scale < SMALLEST_IMAGE_PX:
            continue
        yield (image if n == 0 else _shrunk(image, scale)), scale


def _shrunk(image: NDArray[np.uint8], scale: float) -> NDArray[np.uint8]:
    return np.asarray(
        cv2.resize(image, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA), dtype=np.uint8
    )


def _grids(
    scaled: NDArray[np.uint8], scale: float, blurred: FloatImage, target: Chessboard
) -> list[CornerGrid]:
    """Return the completed grids, in full-size pixels, of a scaled image."""
    corners = find_corners(scaled)
    rounds = max(target.columns, target.rows)
    found = []
    for grid in number_corners(corners, link_corners(corners))[:GRIDS_PER_SCALE]:
        full = CornerGrid((grid.points + 0.5) / scale - 0.5, grid.phase)
        found.append(complete_grid(blurred, full, rounds))
    return found


def _refined(blurred: FloatImage, grid: CornerGrid, target: Chessboard) -> CornerGrid:
    """Return the grid with corners fitted to the blurred image; raises TargetNotVisible if one cannot be."""
    square = measure_steps(grid.points).square_px.reshape(-1)
    radii = np.clip(np.floor(0.4 * square), 2, 4).astype(np.int64)
    points, proven = refine_saddles(blurred, grid.points.reshape(-1, 2), radii, iterations=20)
    if not proven.all():
        raise refuse_partial(int(proven.sum()), target)
    return CornerGrid(points.reshape(grid.points.shape), grid.phase)


def _check_parity(parity: Parity, target: Chessboard) -> None:
    if parity.separation < LEAST_SEPARATION:
        raise TargetNotVisible(
            f"What looks like a {target.columns}x{target.rows} grid does not alternate between dark and "
            "bright; show a chessboard, with no reflection or shadow edge on it.",
            parity_separation=round(parity.separation, 3),
        )
