"""From a captured image to the centres of a grid of dots, or to the reason why not.

A grid of equal dots is seen whole or not at all. Not here: limits (`quality.gates`).
"""

import numpy as np
from numpy.typing import NDArray

from service.core.errors import TargetNotVisible, WrongTarget
from service.core.vision.circle_centres import fit_smooth_map, refine_centres
from service.core.vision.circle_grid import apply_homography, find_grid, fit_homography
from service.core.vision.detected import Detection, check_grey_image
from service.core.vision.light import Cells, LightFall, fit_light
from service.core.vision.parity import measure_parity
from service.core.vision.sampling import FloatImage, sample_bilinear, smooth
from service.core.vision.sharpness import Sharpness, measure_edges
from service.core.vision.target_circles import Circles
from service.core.vision.transforms import Array

READING_SIGMA_PX = 1.0
RIM_ANGLES = np.arange(8) * (np.pi / 4.0)
RIM_REACH = 0.8  # of a dot's radius, or of half the gap between dots
LEAST_SEPARATION = 0.2
PLACE_AND_GAPS = np.array([[0.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]])  # in steps
SHARE_OF_A_GRID = 0.35  # that must be seen before a part is spoken of
SHARE_OF_A_LINE = 0.5  # of the dots beyond a side that must be there for a larger grid to be spoken of


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
    cells = _read_cells(blurred, first, target)
    light = fit_light(cells)
    parity = measure_parity(cells, light)
    if parity.separation < LEAST_SEPARATION:
        raise TargetNotVisible(
            f"What looks like a {target.name} is not clearly dark and bright; light it evenly, with no "
            "reflection or shadow edge on it.",
            parity_separation=round(parity.separation, 3),
        )
    _check_no_more(blurred, light, first, target)
    sharp = image.astype(np.float32)
    points = refine_centres(sharp, light, first, target)
    return Detection(
        image_points=points,
        corner_ids=np.arange(len(points)),
        image_size=(image.shape[1], image.shape[0]),
        sharpness=_measure_sharpness(sharp, points, target),
        parity_separation=parity.separation,
        contrast=parity.contrast,
    )


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


def _read_cells(blurred: FloatImage, centres: Array, target: Circles) -> Cells:
    """Return the middles of dots, which are dark, and of the gaps in their rows, which are bright."""
    grid = centres.reshape(target.rows, target.columns, 2)
    gaps = 0.5 * (grid[:, 1:] + grid[:, :-1]).reshape(-1, 2)
    places = np.concatenate([centres, gaps])
    bright = np.arange(len(places)) >= len(centres)
    return Cells(places, sample_bilinear(blurred, places[:, 0], places[:, 1]), bright)


def _check_no_more(blurred: FloatImage, light: LightFall, centres: Array, target: Circles) -> None:
    """Raise WrongTarget where dots go on beyond a side of the declared grid."""
    H = fit_homography(target, centres)
    size = np.array([blurred.shape[1], blurred.shape[0]])
    for row, column in _beyond(target):
        board = np.stack([2.0 * column + row % 2, 1.0 * row], axis=-1)[:, None] + PLACE_AND_GAPS
        places = apply_homography(H, board * target.step_m)
        places = places[np.all((places > 1.0) & (places < size - 2.0), axis=(1, 2))]
        bright, dark = light.levels(places[..., 0], places[..., 1])
        level = sample_bilinear(blurred, places[..., 0], places[..., 1])
        is_bright = level > 0.5 * (bright + dark)
        dots = ~is_bright[:, 0] & is_bright[:, 1:].all(axis=1)
        if np.count_nonzero(dots) >= max(2.0, SHARE_OF_A_LINE * len(row)):
            raise WrongTarget(
                f"The grid in the image has more dots than a {target.name}; declare the grid that is shown "
                "or show the declared one.",
                declared=target.spec,
            )


def _beyond(target: Circles) -> list[tuple[NDArray[np.int64], NDArray[np.int64]]]:
    """Return rows and columns of the dots that would be next beyond the four sides."""
    across, down = np.arange(target.columns), np.arange(target.rows)
    return [
        (np.full_like(across, -1), across),
        (np.full_like(across, target.rows), across),
        (down, np.full_like(down, -1)),
        (down, np.full_like(down, target.columns)),
    ]


def _measure_sharpness(image: FloatImage, points: Array, target: Circles) -> Sharpness:
    """Return the sharpness across the dots' rims, at eight places of each."""
    smooth_map = fit_smooth_map(target, points)
    direction = np.stack([np.cos(RIM_ANGLES), np.sin(RIM_ANGLES)], axis=-1)
    radius = 0.5 * target.diameter_m
    gap = np.sqrt(2.0) * target.step_m - target.diameter_m
    reach = RIM_REACH * min(radius, 0.5 * gap)
    centres = target.object_points[:, None, :2]
    rim = smooth_map.image_of(centres + radius * direction).reshape(-1, 2)
    outside = smooth_map.image_of(centres + (radius + reach) * direction).reshape(-1, 2)
    return measure_edges(image, rim[:, None], outside - rim)
