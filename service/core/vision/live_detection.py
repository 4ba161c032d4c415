"""From a live frame to the corners of the declared target, within a bounded time and without errors.

At half size, from a bounded number of candidates, and refined only as far as guidance needs; what is captured
is detected again, carefully (`detection`). A frame without a board costs no more than one with a board.
Not here: poses, hints, and limits on sharpness or light.
"""

from dataclasses import dataclass
from typing import Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.vision.board import is_larger, is_whole, order_corners
from service.core.vision.corner_grid import CornerGrid, keep_squares, link_corners, number_corners
from service.core.vision.detection import check_grey_image
from service.core.vision.grid_growth import grow_grid
from service.core.vision.live_corners import LiveWorkspace, find_live_corners, refine_on_pixels, smooth_frame
from service.core.vision.live_look import measure_look
from service.core.vision.outer_lines import SHARE_OF_A_SURE_LINE, whole_lines, without_rims
from service.core.vision.saddle import refine_saddles
from service.core.vision.sampling import FloatImage
from service.core.vision.target import Chessboard
from service.core.vision.transforms import Array

__all__ = ["BoardKind", "LiveDetection", "LiveWorkspace", "detect_live"]

LIVE_SCALE = 2  # full-size pixels per pixel in which a live frame is looked at
GRIDS = 2  # linked grids that are looked into, the one with most contrast first
ROUNDS = 1  # of growth, by a line on each side
DISC_PX = 2  # of the last saddle fit
NO_GRID = CornerGrid(np.zeros((0, 0, 2)), 0)
PARTIAL_CORNERS = 20  # fewer occur by chance on a patterned background

BoardKind = Literal["present", "partial", "absent", "wrong"]


@dataclass(frozen=True)
class LiveDetection:
    """What a live frame shows.

    kind: "present" (the whole target), "partial" (a part of a board, or one that is covered), "wrong" (a
    larger board) or "absent".
    image_points: (n, 2) in full-size px and the target's order; None unless present.
    corners_seen: on the board or on the part of it.
    edge_width_px: 10–90 %, full-size px, a cheap estimate; None unless present.
    brightness: grey level of the bright squares of the board; without one, mean of the frame.
    glare_share: saturated share of the bright squares; None unless present.
    """

    kind: BoardKind
    image_points: Array | None
    corners_seen: int
    edge_width_px: float | None
    brightness: float
    glare_share: float | None = None


def detect_live(
    image: NDArray[np.uint8], target: Chessboard, workspace: LiveWorkspace | None = None, *, scale: int = 1
) -> LiveDetection:
    """Return what a grey frame (h, w) shows of a target.

    scale: full-size pixels per pixel of the frame, 1 or 2: a frame that is sent at half size (means of 2x2)
    has 2. Corners are in full-size pixels either way. workspace: None to work without buffers.
    Raises Unprocessable when the array is no grey image.
    """
    image = check_grey_image(image)
    workspace = LiveWorkspace() if workspace is None else workspace
    half = image if scale == LIVE_SCALE else halve(image)
    blurred = smooth_frame(half, workspace)
    grid = _find_grid(blurred, target, workspace)
    seen = int(grid.known.sum())
    if not is_whole(grid, target):
        return LiveDetection(_kind_of_rest(grid, seen, target), None, seen, None, float(cv2.mean(half)[0]))
    corners, dark_first = order_corners(grid, target)
    look = measure_look(half, corners, dark_first)
    refined, _ = refine_saddles(blurred, corners.reshape(-1, 2), np.full(seen, DISC_PX), iterations=2)
    points = refined * LIVE_SCALE + 0.5 * (LIVE_SCALE - 1)
    return LiveDetection(
        kind="present",
        image_points=points,
        corners_seen=seen,
        edge_width_px=look.edge_width_px * LIVE_SCALE,
        brightness=look.brightness,
        glare_share=look.glare_share,
    )


def halve(image: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return the means of 2x2 pixels of an image (h, w)."""
    height, width = (size // 2 * 2 for size in image.shape)
    half = cv2.resize(image[:height, :width], (width // 2, height // 2), interpolation=cv2.INTER_AREA)
    return np.asarray(half, dtype=np.uint8)


def _find_grid(blurred: FloatImage, target: Chessboard, workspace: LiveWorkspace) -> CornerGrid:
    """Return the grid that is most likely the target, in half-size px; an empty one where there is none."""
    corners = find_live_corners(blurred, workspace)
    best = NO_GRID
    for grid in number_corners(corners, link_corners(corners))[:GRIDS]:
        grown = grow_grid(blurred, keep_squares(grid), ROUNDS, refine_on_pixels)
        lines = whole_lines(keep_squares(grown))
        if is_larger(lines, target):
            lines = without_rims(blurred, lines)
        if is_whole(lines, target):
            return lines
        best = max(best, lines, key=lambda grid: int(grid.known.sum()))
    return best


def _kind_of_rest(grid: CornerGrid, seen: int, target: Chessboard) -> BoardKind:
    if is_larger(whole_lines(grid, SHARE_OF_A_SURE_LINE), target):
        return "wrong"
    return "partial" if seen >= PARTIAL_CORNERS else "absent"
