"""From a live frame to the corners of the declared target, within a bounded time and without errors.

At half size, from a bounded number of candidates, and refined only as far as guidance needs; what is captured
is detected again, carefully (`detection`). A frame without a board costs no more than one with a board.
Boards with markers go another way from the grids on (`live_coded`), dots their own (`live_circles`).
Not here: poses, hints, and limits on sharpness or light.
"""

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.errors import TargetSpecInvalid
from service.core.vision.board import has_size, is_larger, is_whole, order_corners
from service.core.vision.corner_candidates import Corners
from service.core.vision.corner_grid import CornerGrid, keep_squares, link_corners, number_corners
from service.core.vision.detection import check_grey_image
from service.core.vision.grid_growth import fill_grid, grow_grid
from service.core.vision.live_choice import choose_grid, is_sure_and_larger, may_be_a_board
from service.core.vision.live_circles import detect_live_circles
from service.core.vision.live_coded import detect_live_coded
from service.core.vision.live_corners import LiveWorkspace, find_live_corners, refine_on_pixels, smooth_frame
from service.core.vision.live_detected import LIVE_SCALE, BoardKind, LiveDetection
from service.core.vision.live_look import measure_look
from service.core.vision.outer_lines import whole_lines, without_rims
from service.core.vision.saddle import refine_saddles
from service.core.vision.sampling import FloatImage
from service.core.vision.target import Target
from service.core.vision.target_aprilgrid import AprilGrid
from service.core.vision.target_charuco import Charuco
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.target_circles import Circles

__all__ = ["BoardKind", "LiveDetection", "LiveWorkspace", "detect_live"]

GRIDS = 3  # linked grids that are looked into, the one with most contrast first
SHARE_OF_A_RIVAL = 0.6  # of the target's corners that a second board must show before it is grown
ROUNDS = 1  # of growth, by a line on each side
GAP_ROUNDS = 3  # of filling gaps, by a corner from each side
DISC_PX = 2  # of the last saddle fit
PARTIAL_CORNERS = 20  # fewer occur by chance on a patterned background


def detect_live(
    image: NDArray[np.uint8], target: Target, workspace: LiveWorkspace | None = None, *, scale: int = 1
) -> LiveDetection:
    """Return what a grey frame (h, w) shows of a target.

    scale: full-size pixels per pixel of the frame, 1 or 2: a frame that is sent at half size (means of 2x2)
    has 2. Corners are in full-size pixels either way. workspace: None to work without buffers.
    Raises Unprocessable when the array is no grey image, TargetSpecInvalid for a kind that is not known here.
    """
    image = check_grey_image(image)
    workspace = LiveWorkspace() if workspace is None else workspace
    half = image if scale == LIVE_SCALE else halve(image)
    if isinstance(target, Chessboard):
        return _detect_chessboard(half, target, workspace)
    if isinstance(target, Circles):
        return detect_live_circles(half, target)
    if isinstance(target, Charuco | AprilGrid):
        return detect_live_coded(half, target, workspace)
    raise TargetSpecInvalid(f"A {target.name} cannot be detected in live frames.", spec=target.spec)


def _detect_chessboard(
    half: NDArray[np.uint8], target: Chessboard, workspace: LiveWorkspace
) -> LiveDetection:
    blurred = smooth_frame(half, workspace)
    found = find_live_corners(blurred, workspace)
    grid = choose_grid(_grow_grids(blurred, found, target), target)
    seen = int(grid.known.sum())
    if not is_whole(grid, target):
        likely = seen >= PARTIAL_CORNERS and may_be_a_board(half, grid, len(found), target)
        kind: BoardKind = _kind_of_part(grid, target) if likely else "absent"
        return LiveDetection(kind, None, seen, None, float(cv2.mean(half)[0]))
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


def _grow_grids(blurred: FloatImage, corners: Corners, target: Chessboard) -> list[CornerGrid]:
    """Return the most likely grids with their gaps filled, in half-size px, a bounded number of them."""
    needed = target.columns * target.rows
    grown: list[CornerGrid] = []
    for grid in number_corners(corners, link_corners(corners), enough=needed)[:GRIDS]:
        if any(is_whole(other, target) for other in grown) and grid.known.sum() < SHARE_OF_A_RIVAL * needed:
            continue
        lines = whole_lines(keep_squares(grow_grid(blurred, keep_squares(grid), ROUNDS, refine_on_pixels)))
        if has_size(lines, target) and not is_whole(lines, target):
            # A corner of the board that glare has washed out may be several corners deep.
            lines = keep_squares(fill_grid(blurred, lines, GAP_ROUNDS, refine_on_pixels))
        grown.append(without_rims(blurred, lines) if is_larger(lines, target) else lines)
    return grown


def _kind_of_part(grid: CornerGrid, target: Chessboard) -> BoardKind:
    return "wrong" if is_sure_and_larger(grid, target) else "partial"
