"""From a captured image to the corners of a board with markers, as many as can be seen.

Markers say which corner is where, to a pixel or two; each is then refined by a saddle fit under even light
and by the edges that cross there, and kept where the surface around it is dark and bright as it must be.
Not here: finding markers (`marker_detection`), limits (`quality.gates`).
"""

import numpy as np
from numpy.typing import NDArray

from service.core.errors import TargetNotVisible
from service.core.vision.coded import CodedTarget
from service.core.vision.coded_corners import (
    DISC_RADII_PX,
    Corners,
    cross_edges,
    find_corners_of,
    first_corners,
    refine_corners,
)
from service.core.vision.detected import Detection, check_grey_image
from service.core.vision.edge_crossing import EDGE_WIDTHS_OF_SIGMA
from service.core.vision.light import CLIPPED, Cells, check_exposure, even_out, fit_light
from service.core.vision.marker_detection import (
    Markers,
    board_to_image,
    compare_layout,
    find_markers,
    map_points,
)
from service.core.vision.marker_refusal import check_ids, check_layout, refuse_few, refuse_markers
from service.core.vision.parity import measure_parity
from service.core.vision.sampling import FloatImage, middle_of, sample_bilinear, smooth
from service.core.vision.sharpness import PLACES, Sharpness, measure_edges
from service.core.vision.transforms import Array

LEAST_MARKERS = 2
LEAST_CORNERS = 12
LEAST_LINES = 3
REFINING_SIGMA_PX = 0.7
DISC_PER_EDGE_WIDTH = 1.5
REACH = 0.9  # of what is plain beside an edge
LEAST_SEPARATION = 0.2
LEAST_CELLS = 4  # dark or bright ones, to tell the fall of light from
SAME_DISTANCE = 1.05
SIDES = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])


def detect_coded(image: NDArray[np.uint8], target: CodedTarget) -> Detection:
    """Return the corners of a board that a grey image (h, w) shows, in ascending order.

    Raises TargetNotVisible (no markers, or fewer than 12 corners in three rows and columns), WrongTarget
    (markers of another board or dictionary, or mirrored), TargetOverexposed when most bright places are
    saturated, Unprocessable when the array is no grey image.
    """
    image = check_grey_image(image)
    markers = _find_board(image, target)
    blurred = smooth(image, REFINING_SIGMA_PX)
    H = board_to_image(target.marker_corners[markers.ids], markers.corners)
    corners = find_corners_of(blurred, first_corners(H, markers, target), target)
    _check_enough(corners, target)
    sharpness = _measure_sharpness(image.astype(np.float32), corners, target)
    cells = _read_cells(blurred, H, markers, corners, target)
    light = fit_light(cells)
    parity = measure_parity(cells, light)
    if parity.separation < LEAST_SEPARATION:
        raise TargetNotVisible(
            f"What looks like a {target.name} is not clearly dark and bright; light it evenly, with no "
            "reflection or shadow edge on it.",
            parity_separation=round(parity.separation, 3),
        )
    saturated = check_exposure(float(np.mean(cells.levels[cells.bright] >= CLIPPED)))
    even, origin = even_out(blurred, light, corners.points, margin_px=3 * DISC_RADII_PX[1])
    moved = Corners(corners.ids, corners.points - origin, corners.scale)
    width = float(np.nan_to_num(sharpness.edge_width_px))
    saddles = refine_corners(even, moved, DISC_PER_EDGE_WIDTH * width, target)
    _check_enough(saddles, target)
    sigma = float(np.hypot(width / EDGE_WIDTHS_OF_SIGMA, REFINING_SIGMA_PX))
    final = cross_edges(even, saddles, sigma, middle_of(image) - origin, target)
    return Detection(
        image_points=final.points + origin,
        corner_ids=final.ids,
        image_size=(image.shape[1], image.shape[0]),
        sharpness=sharpness,
        parity_separation=parity.separation,
        contrast=parity.contrast,
        saturated_share=saturated,
    )


def _find_board(image: NDArray[np.uint8], target: CodedTarget) -> Markers:
    """Return the board's markers; raises TargetNotVisible or WrongTarget."""
    found = check_ids(find_markers(image, target.dictionary, target.marker_border), target)
    markers = check_layout(compare_layout(found, target), found, target)
    if len(markers) < LEAST_MARKERS:
        raise refuse_markers(image, target)
    return markers


def _check_enough(corners: Corners, target: CodedTarget) -> None:
    row, column = np.divmod(corners.ids, target.columns)
    lines = min(len(np.unique(row)), len(np.unique(column)))
    if len(corners.ids) < LEAST_CORNERS or lines < LEAST_LINES:
        raise refuse_few(len(corners.ids), LEAST_CORNERS, target)


def _measure_sharpness(image: FloatImage, corners: Corners, target: CodedTarget) -> Sharpness:
    """Return the sharpness along the edges between corners that are seen."""
    places = np.full(len(target.object_points), -1)
    places[corners.ids] = np.arange(len(corners.ids))
    edges = places[target.edges]
    start, end = edges[np.all(edges >= 0, axis=1)].T
    along = corners.points[end] - corners.points[start]
    normal = np.stack([-along[:, 1], along[:, 0]], axis=-1) / np.linalg.norm(along, axis=-1, keepdims=True)
    # What a metre of the board at a right angle to the edge is in the image, along the edge's normal there.
    to_board = np.linalg.inv(0.5 * (corners.scale[start] + corners.scale[end]))
    direction = np.einsum("nij,nj->ni", to_board, along)
    across = np.stack([-direction[:, 1], direction[:, 0]], axis=-1)
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    height = np.abs(np.einsum("ni,nij,nj->n", normal, np.linalg.inv(to_board), across))
    spots = corners.points[start][:, None] + along[:, None] * PLACES[:, None]
    return measure_edges(image, spots, normal * (REACH * target.plain_m * height)[:, None])


def _read_cells(
    blurred: FloatImage, H: Array, markers: Markers, corners: Corners, target: CodedTarget
) -> Cells:
    """Return places beside markers that must be dark or bright, where the nearest corners are in sight."""
    middles = target.marker_corners[markers.ids].mean(axis=1)
    probes = [middles[:, None] + away * SIDES for away in target.probes]
    board = np.concatenate(probes, axis=1)
    bright = np.broadcast_to(np.arange(board.shape[1]) >= len(SIDES), board.shape[:2]).ravel()
    pixels, board = map_points(H, board).reshape(-1, 2), board.reshape(-1, 2)
    used = _are_in_sight(board, corners, target) & _are_inside(pixels, blurred)
    if min(np.count_nonzero(used & bright), np.count_nonzero(used & ~bright)) < LEAST_CELLS:
        raise refuse_few(len(corners.ids), LEAST_CORNERS, target)
    levels = sample_bilinear(blurred, pixels[used, 0], pixels[used, 1])
    return Cells(pixels[used], levels, bright[used])


def _are_in_sight(board: Array, corners: Corners, target: CodedTarget) -> NDArray[np.bool_]:
    """Return which board points (n, 2), m, are on the print and have all their nearest corners seen."""
    unseen = np.ones(len(target.object_points), dtype=bool)
    unseen[corners.ids] = False
    away = np.linalg.norm(board[:, None] - target.object_points[:, :2], axis=-1)
    near = away < SAME_DISTANCE * away.min(axis=1, keepdims=True)
    on_print = np.all((board > target.outline[0, :2]) & (board < target.outline[2, :2]), axis=1)
    return np.asarray(on_print & ~np.any(near & unseen, axis=1))


def _are_inside(pixels: Array, image: FloatImage) -> NDArray[np.bool_]:
    size = np.array([image.shape[1], image.shape[0]])
    return np.asarray(np.all((pixels >= 1.0) & (pixels <= size - 2.0), axis=1))
