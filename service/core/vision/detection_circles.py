"""From a captured image to the centres of a grid of dots, or to the reason why not.

A grid of equal dots is seen whole or not at all. Not here: limits (`quality.gates`).
"""

import numpy as np
from numpy.typing import NDArray

from service.core.errors import TargetNotVisible, WrongTarget
from service.core.vision.board_map import fit_board_map
from service.core.vision.circle_cells import goes_on, read_dots
from service.core.vision.circle_centres import refine_centres
from service.core.vision.circle_grid import find_grid, fit_homography
from service.core.vision.detected import Detection, check_grey_image
from service.core.vision.dot_rims import refine_by_rims
from service.core.vision.edge_crossing import EDGE_WIDTHS_OF_SIGMA
from service.core.vision.light import LightFall, even_out, fit_light
from service.core.vision.parity import measure_parity
from service.core.vision.sampling import FloatImage, middle_of, smooth
from service.core.vision.sharpness import Sharpness, measure_edges
from service.core.vision.target_circles import Circles
from service.core.vision.transforms import Array

READING_SIGMA_PX = 1.0
REFINING_SIGMA_PX = 0.7
RIM_ANGLES = np.arange(8) * (np.pi / 4.0)
RIM_REACH = 0.8  # of a dot's radius, or of half the gap between dots
LEAST_SEPARATION = 0.2
SHARE_OF_A_GRID = 0.35  # that must be seen before a part is spoken of


def detect_circles(image: NDArray[np.uint8], target: Circles) -> Detection:
    """Return the centres of all dots in a grey image (h, w), in the order of target.object_points.

    Raises TargetNotVisible when there is no whole grid, WrongTarget when it has more dots than declared,
    Unprocessable when the array is no grey image.
    """
    image = check_grey_image(image)
    grid = find_grid(image, target)
    if grid.centres is None:
        raise _refuse_partial(grid.most_seen, target)
    first = grid.centres
    blurred = smooth(image, READING_SIGMA_PX)
    cells = read_dots(blurred, first, target)
    light = fit_light(cells)
    parity = measure_parity(cells, light)
    if parity.separation < LEAST_SEPARATION:
        raise TargetNotVisible(
            f"What looks like a {target.name} is not clearly dark and bright; light it evenly, with no "
            "reflection or shadow edge on it.",
            parity_separation=round(parity.separation, 3),
        )
    if goes_on(blurred, light, fit_homography(target, first), target):
        raise WrongTarget(
            f"The grid in the image has more dots than a {target.name}; declare the grid that is shown or "
            "show the declared one.",
            declared=target.spec,
        )
    sharp = image.astype(np.float32)
    rough = refine_centres(sharp, light, first, target)
    sharpness = _measure_sharpness(sharp, rough, target)
    points = _refine(image, light, rough, sharpness, target)
    return Detection(
        image_points=points,
        corner_ids=np.arange(len(points)),
        image_size=(image.shape[1], image.shape[0]),
        sharpness=sharpness,
        parity_separation=parity.separation,
        contrast=parity.contrast,
    )


def _refine(
    image: NDArray[np.uint8], light: LightFall, rough: Array, sharpness: Sharpness, target: Circles
) -> Array:
    """Return the centres (n, 2) px by the dots' rims under even light."""
    rows = rough.reshape(target.rows, target.columns, 2)
    room = int(np.ceil(np.linalg.norm(np.diff(rows, axis=1), axis=-1).max()))
    even, origin = even_out(smooth(image, REFINING_SIGMA_PX), light, rough, margin_px=room)
    width = float(np.nan_to_num(sharpness.edge_width_px))
    sigma = float(np.hypot(width / EDGE_WIDTHS_OF_SIGMA, REFINING_SIGMA_PX))
    points, _ = refine_by_rims(even, rough - origin, target, sigma, middle_of(image) - origin)
    return points + origin


def _refuse_partial(seen: int, target: Circles) -> TargetNotVisible:
    needed = len(target.object_points)
    part = f"No {target.name} was found"
    if seen > SHARE_OF_A_GRID * needed:
        part = f"Only {seen} of {needed} dots of the {target.name} were found"
    return TargetNotVisible(
        f"{part}; bring the whole of it into the picture, lit evenly, sharp, near enough and with all dots "
        "in sight.",
        corners_seen=seen,
        corners_needed=needed,
    )


def _measure_sharpness(image: FloatImage, points: Array, target: Circles) -> Sharpness:
    """Return the sharpness across the dots' rims, at eight places of each."""
    board_map = fit_board_map(target.object_points[:, :2], points, middle_of(image))
    direction = np.stack([np.cos(RIM_ANGLES), np.sin(RIM_ANGLES)], axis=-1)
    radius = 0.5 * target.diameter_m
    gap = np.sqrt(2.0) * target.step_m - target.diameter_m
    reach = RIM_REACH * min(radius, 0.5 * gap)
    centres = target.object_points[:, None, :2]
    rim = board_map.image_of(centres + radius * direction).reshape(-1, 2)
    outside = board_map.image_of(centres + (radius + reach) * direction).reshape(-1, 2)
    return measure_edges(image, rim[:, None], outside - rim)
