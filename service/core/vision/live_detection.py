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
from service.core.vision.corner_candidates import find_corners
from service.core.vision.corner_grid import CornerGrid, link_corners, number_corners
from service.core.vision.detection import check_grey_image
from service.core.vision.grid_growth import complete_grid
from service.core.vision.outer_lines import SHARE_OF_A_SURE_LINE, whole_lines
from service.core.vision.sampling import smooth
from service.core.vision.target import Chessboard
from service.core.vision.transforms import Array

CANDIDATES = 400
ROUNDS = 2
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
    """

    kind: BoardKind
    image_points: Array | None
    corners_seen: int
    edge_width_px: float | None
    brightness: float


class LiveWorkspace:
    """Buffers that the detector of one stream uses again from frame to frame; not for two threads at once."""


def detect_live(
    image: NDArray[np.uint8], target: Chessboard, workspace: LiveWorkspace | None = None, *, scale: int = 1
) -> LiveDetection:
    """Return what a grey frame (h, w) shows of a target.

    scale: full-size pixels per pixel of the frame, 1 or 2: a frame that is sent at half size (means of 2x2)
    has 2. Corners are in full-size pixels either way. workspace: None to work without buffers.
    Raises Unprocessable when the array is no grey image.
    """
    image = check_grey_image(image)
    half = image if scale == 2 else cv2.resize(image, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)
    corners = find_corners(np.asarray(half, dtype=np.uint8), CANDIDATES)
    grids = number_corners(corners, link_corners(corners))
    brightness = float(half.mean())
    if not grids:
        return LiveDetection("absent", None, 0, None, brightness)
    grid = whole_lines(complete_grid(smooth(np.asarray(half, dtype=np.uint8), 1.1), grids[0], ROUNDS))
    seen = int(grid.known.sum())
    if is_whole(grid, target):
        points = order_corners(grid, target)[0].reshape(-1, 2) * 2.0 + 0.5
        return LiveDetection("present", points, seen, None, brightness)
    return LiveDetection(_kind_of_rest(grid, seen, target), None, seen, None, brightness)


def _kind_of_rest(grid: CornerGrid, seen: int, target: Chessboard) -> BoardKind:
    if is_larger(whole_lines(grid, SHARE_OF_A_SURE_LINE), target):
        return "wrong"
    return "partial" if seen >= PARTIAL_CORNERS else "absent"
