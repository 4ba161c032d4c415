"""From a live frame to the corners of a board with markers: the chessboard's way to grids, then the markers.

On a ChArUco board and on an AprilGrid every corner is one as on a chessboard, so that candidates, links and
numbers are found as there, in the same bounded time; markers then say which corner is which. Parts of one
board that a hand separates are put together.
Not here: plain chessboards (`live_detection`), the careful search in a capture (`detection_coded`).
"""

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.vision.coded import CodedTarget
from service.core.vision.corner_grid import CornerGrid, keep_squares, link_corners, number_corners
from service.core.vision.detection_coded import LEAST_CORNERS, LEAST_LINES
from service.core.vision.grid_codes import READABLE_PX, NamedCorners, Reading, code_book, read_grid
from service.core.vision.live_choice import may_be_a_board
from service.core.vision.live_corners import LiveWorkspace, find_live_corners, smooth_frame
from service.core.vision.live_detected import LIVE_SCALE, BoardKind, LiveDetection
from service.core.vision.live_look import Look, look_along_edges
from service.core.vision.saddle import refine_saddles
from service.core.vision.transforms import Array

GRIDS = 3  # that are read, the one with most contrast first
PARTIAL_CORNERS = 20  # fewer occur by chance on a patterned background
SURE_MARKERS = 4  # in frames, from which on a board has markers
DISC_PX = 2
TOGETHER = 0.5  # of a square: where one part of a board says that another one is
STEP = 0.1  # of an edge, over which the scale across it is taken


def detect_live_coded(
    half: NDArray[np.uint8], target: CodedTarget, workspace: LiveWorkspace
) -> LiveDetection:
    """Return what a grey frame at half size (h, w) shows of a board with markers."""
    blurred = smooth_frame(half, workspace)
    found = find_live_corners(blurred, workspace)
    links = link_corners(found, code_book(target).evenness)
    grids = number_corners(found, links, enough=target.columns * target.rows)
    squares = [keep_squares(grid) for grid in grids[:GRIDS]]
    readings = [read_grid(half, grid, target) for grid in squares if grid.points.size]
    named = [one.corners for one in readings if one.corners is not None and _spans(one.corners, target, 2)]
    if not named:
        return _unnamed(half, squares, readings, len(found), target)
    corners = _put_together(named, target)
    seen = len(corners.ids)
    if not _is_enough(corners, target):
        return LiveDetection("partial", None, seen, None, float(cv2.mean(half)[0]))
    points, _ = refine_saddles(blurred, corners.points, np.full(seen, DISC_PX), iterations=2)
    look = _look_at(half, NamedCorners(corners.ids, points), target)
    places = np.full((target.rows * target.columns, 2), np.nan)
    places[corners.ids] = points * LIVE_SCALE + 0.5 * (LIVE_SCALE - 1)
    return LiveDetection(
        kind="present",
        image_points=places,
        corners_seen=seen,
        edge_width_px=look.edge_width_px * LIVE_SCALE,
        brightness=look.brightness,
        glare_share=look.glare_share,
    )


def _unnamed(
    half: NDArray[np.uint8],
    grids: list[CornerGrid],
    readings: list[Reading],
    corners_in_all: int,
    target: CodedTarget,
) -> LiveDetection:
    """Return what a frame shows in which the board's markers were not read.

    Another board where markers of its size could have been; else perhaps a part of it, or one too far away.
    """
    grid = max(grids, key=lambda one: int(one.known.sum()), default=CornerGrid(np.zeros((0, 0, 2)), 0))
    seen = int(grid.known.sum())
    framed = any(reading.framed >= SURE_MARKERS for reading in readings)
    plain = seen >= PARTIAL_CORNERS and may_be_a_board(half, grid, corners_in_all, target)
    kind: BoardKind = "absent"
    if framed or plain:
        is_readable = any(reading.module_px >= READABLE_PX for reading in readings)
        kind = "wrong" if is_readable else "partial"
    return LiveDetection(kind, None, seen, None, float(cv2.mean(half)[0]))


def _put_together(parts: list[NamedCorners], target: CodedTarget) -> NamedCorners:
    """Return the largest part with the corners of others that lie where it says: no second board's."""
    largest = max(parts, key=lambda part: len(part.ids))
    if len(parts) == 1:
        return largest
    board = code_book(target).points
    places = np.full(board.shape, np.nan)
    places[largest.ids] = largest.points
    H = _homography(board[largest.ids], largest.points)
    square_px = _square_px(H, board[largest.ids], target.square_m)
    for part in parts:
        told = cv2.perspectiveTransform(board[None, part.ids], H)[0]
        near = np.linalg.norm(told - part.points, axis=1) < TOGETHER * square_px
        fresh = near & np.isnan(places[part.ids, 0])
        places[part.ids[fresh]] = part.points[fresh]
    ids = np.flatnonzero(~np.isnan(places[:, 0]))
    return NamedCorners(ids, places[ids])


def _is_enough(corners: NamedCorners, target: CodedTarget) -> bool:
    """Whether a capture would take so much of the board: the outermost corners follow from the rest then."""
    return len(corners.ids) >= LEAST_CORNERS and _spans(corners, target, LEAST_LINES)


def _spans(corners: NamedCorners, target: CodedTarget, lines: int) -> bool:
    """Whether corners lie in so many rows and columns, and are as many as a square of these."""
    row, column = np.divmod(corners.ids, target.columns)
    return len(corners.ids) >= lines**2 and min(len(np.unique(row)), len(np.unique(column))) >= lines


def _look_at(image: NDArray[np.uint8], corners: NamedCorners, target: CodedTarget) -> Look:
    """Return how the edges between corners that are seen look."""
    book = code_book(target)
    places = np.full(book.points.shape, np.nan)
    places[corners.ids] = corners.points
    pairs = places[book.edges]
    seen = ~np.isnan(pairs).any(axis=(1, 2))
    ends, board = pairs[seen], book.points[book.edges[seen]]
    H = _homography(book.points[corners.ids], corners.points)
    normal, px_per_m = _across(H, ends, board)
    return look_along_edges(
        image, ends.mean(axis=1), normal, target.dark_m * px_per_m, target.plain_m * px_per_m
    )


def _across(H: Array, ends: Array, board: Array) -> tuple[Array, Array]:
    """Return what is at a right angle to edges (k, 2, 2) px: ways (k, 2), and px of a metre that way (k,)."""
    along_m, along = board[:, 1] - board[:, 0], ends[:, 1] - ends[:, 0]
    length_m = np.linalg.norm(along_m, axis=1, keepdims=True)
    aside_m = STEP * np.stack([-along_m[:, 1], along_m[:, 0]], axis=-1)
    middle = board.mean(axis=1)
    moved = cv2.perspectiveTransform(np.stack([middle - aside_m, middle + aside_m], axis=1), H)
    normal = np.stack([-along[:, 1], along[:, 0]], axis=-1)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-9)
    px = np.abs(np.sum((moved[:, 1] - moved[:, 0]) * normal, axis=1))
    return normal, px / (2.0 * STEP * length_m[:, 0])


def _homography(board: Array, points: Array) -> Array:
    return np.asarray(cv2.findHomography(board, points)[0], dtype=np.float64)


def _square_px(H: Array, board: Array, square_m: float) -> float:
    """Return the side of a square, px, in the middle of board points (n, 2)."""
    middle = board.mean(axis=0)
    two = cv2.perspectiveTransform(np.array([[middle, middle + np.array([square_m, 0.0])]]), H)[0]
    return float(np.linalg.norm(two[1] - two[0]))
