"""From a captured image to the corners of the declared chessboard, or to the reason why not.

Full resolution and careful, for a capture; a live frame has another detector. Corners are looked for at
several scales, numbered, completed and proven in the full image, refined by a saddle fit and then by the
edges that cross there.
Not here: limits on sharpness, parity and contrast (`quality.gates`); poses.
"""

from collections.abc import Iterator
from dataclasses import replace

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.errors import TargetNotVisible
from service.core.vision.board import (
    is_larger,
    is_whole,
    nearest_whole,
    order_corners,
    prominent_grids,
    refuse_larger,
    refuse_partial,
)
from service.core.vision.corner_candidates import find_corners
from service.core.vision.corner_grid import CornerGrid, link_corners, number_corners
from service.core.vision.detected import SMALLEST_IMAGE_PX, Detection, check_grey_image
from service.core.vision.edge_crossing import (
    CROSSING_PX,
    EDGE_WIDTHS_OF_SIGMA,
    edges_on_board,
    refine_crossings,
)
from service.core.vision.grid_growth import complete_grid, measure_steps, room_px
from service.core.vision.light import (
    LightFall,
    check_exposure,
    even_out,
    fit_light,
    read_cells,
    saturated_share,
)
from service.core.vision.outer_lines import SHARE_OF_A_SURE_LINE, whole_lines, without_rims
from service.core.vision.parity import Parity, measure_parity
from service.core.vision.saddle import refine_saddles
from service.core.vision.sampling import FloatImage, middle_of, smooth
from service.core.vision.sharpness import Sharpness, measure_sharpness
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Array

COMFORTABLE_PX = 800  # long side at which most boards are found first
GRIDS_PER_SCALE = 3
PROVING_SIGMA_PX = 1.2
REFINING_SIGMA_PX = 0.7  # so that no edge is narrower than pixels can tell
DISC_RADII_PX = (3.0, 8.0)
DISC_PER_EDGE_WIDTH = 1.5
DISC_PER_SQUARE = 0.4
LEAST_SEPARATION = 0.2
SHARE_OF_A_RIVAL = 0.6  # of the target's corners that a second board must show at first sight


def detect_chessboard(image: NDArray[np.uint8], target: Chessboard) -> Detection:
    """Return the target's corners in a grey image (h, w), all of them, in the order of target.object_points.

    Raises TargetNotVisible when there is no board or not the whole of it (facts: corners_seen,
    corners_needed), WrongTarget when the board has more rows or columns than declared (facts: found_columns,
    found_rows), TargetOverexposed when most of its bright squares are saturated (facts: saturated_share),
    Unprocessable when the array is no grey image.
    """
    image = check_grey_image(image)
    grid = _find_board(image, smooth(image, PROVING_SIGMA_PX), target)
    corners, dark_first = order_corners(grid, target)
    sharpness = measure_sharpness(image.astype(np.float32), corners)
    blurred = smooth(image, REFINING_SIGMA_PX)
    cells = read_cells(blurred, corners, dark_first)
    light = fit_light(cells)
    parity = measure_parity(cells, light)
    _check_parity(parity, target)
    bright = cells.bright.reshape(target.rows - 1, target.columns - 1)
    saturated = check_exposure(saturated_share(image, corners, bright))
    points = _refined(blurred, corners, light, sharpness, target)
    return Detection(
        image_points=points,
        corner_ids=np.arange(len(points)),
        image_size=(image.shape[1], image.shape[0]),
        sharpness=sharpness,
        parity_separation=parity.separation,
        contrast=parity.contrast,
        saturated_share=saturated,
    )


def _find_board(image: NDArray[np.uint8], blurred: FloatImage, target: Chessboard) -> CornerGrid:
    """Return the grid that is the target. Raises TargetNotVisible or WrongTarget."""
    most_seen = 0
    for scaled, scale in _scales(image):
        grids = prominent_grids(_grids(scaled, scale, blurred, target))
        whole = nearest_whole(grids, target)
        if whole is not None:
            return whole
        sure = [whole_lines(grid, SHARE_OF_A_SURE_LINE) for grid in grids]
        larger = next((grid for grid in sure if is_larger(grid, target)), None)
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
    rounds, needed = max(target.columns, target.rows), target.columns * target.rows
    found: list[CornerGrid] = []
    for grid in number_corners(corners, link_corners(corners))[:GRIDS_PER_SCALE]:
        # After a whole board only another of its kind matters, of which the larger one is taken.
        if found and is_whole(found[0], target) and grid.known.sum() < SHARE_OF_A_RIVAL * needed:
            continue
        full = replace(grid, points=(grid.points + 0.5) / scale - 0.5)
        if not any(_lies_inside(full, stronger) for stronger in found):
            lines = whole_lines(complete_grid(blurred, full, rounds))
            found.append(without_rims(blurred, lines) if is_larger(lines, target) else lines)
    return found


def _lies_inside(grid: CornerGrid, other: CornerGrid) -> bool:
    """Whether the middle of a grid is inside another, as that of a faint grid among a board's squares is."""
    if not other.points.size:
        return False
    hull = cv2.convexHull(other.points[other.known].astype(np.float32))
    x, y = grid.points[grid.known].mean(axis=0)
    return bool(cv2.pointPolygonTest(hull, (float(x), float(y)), False) >= 0)


def _refined(
    blurred: FloatImage, corners: Array, light: LightFall, sharpness: Sharpness, target: Chessboard
) -> Array:
    """Return corners (n, 2) px fitted under even light; raises TargetNotVisible if one cannot be.

    The saddle's disc grows with the blur: a wide edge is flat near the corner, and a narrow one needs no wide
    disc. Near the border of the image there is less room.
    """
    width = sharpness.edge_width_px if np.isfinite(sharpness.edge_width_px) else 0.0
    wanted = np.clip(np.rint(DISC_PER_EDGE_WIDTH * width), *DISC_RADII_PX)
    square = measure_steps(corners).square_px.ravel()
    room = np.minimum(DISC_PER_SQUARE * square, room_px(blurred, corners.reshape(-1, 2)))
    radii = np.maximum(np.minimum(wanted, np.floor(room)), 2).astype(np.int64)
    even, origin = even_out(blurred, light, corners.reshape(-1, 2), margin_px=int(3 * DISC_RADII_PX[1]))
    saddles, proven = refine_saddles(even, corners.reshape(-1, 2) - origin, radii, iterations=20)
    if not proven.all():
        raise refuse_partial(int(proven.sum()), target)
    board = target.object_points[:, :2]
    edges = edges_on_board(board, saddles, target.square_m, middle_of(blurred) - origin)
    sigma = np.hypot(width / EDGE_WIDTHS_OF_SIGMA, REFINING_SIGMA_PX)
    points, _ = refine_crossings(even, saddles, edges, np.minimum(room, CROSSING_PX), float(sigma))
    return points + origin


def _check_parity(parity: Parity, target: Chessboard) -> None:
    if parity.separation < LEAST_SEPARATION:
        raise TargetNotVisible(
            f"What looks like a {target.columns}x{target.rows} grid does not alternate between dark and "
            "bright; show a chessboard, with no reflection or shadow edge on it.",
            parity_separation=round(parity.separation, 3),
        )
