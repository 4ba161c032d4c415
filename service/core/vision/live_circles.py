"""From a live frame to the dots of a grid: one threshold, lattices of dots, and the target's order.

Lattices are grown where dots hang together, as many as a board may have. Centroids keep their bias under
perspective, of which a capture is freed (`circle_centres`).
Not here: other targets (`live_detection`), the careful search in a capture (`detection_circles`).
"""

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.vision.circle_cells import goes_on, read_dots
from service.core.vision.circle_grid import fit_homography
from service.core.vision.detection_circles import LEAST_SEPARATION
from service.core.vision.dot_groups import group_dots
from service.core.vision.dot_lattice import Dots, Lattice, gather_dots, grow_lattice, order_dots
from service.core.vision.dot_parts import LEAST_DOTS, area_px, is_larger, kind_of_part, largest_grid
from service.core.vision.light import fit_light
from service.core.vision.live_detected import LIVE_SCALE, LiveDetection
from service.core.vision.live_dot_rims import measure_rims, refine_dots, rim_axes
from service.core.vision.live_dots import find_live_dots
from service.core.vision.parity import measure_parity
from service.core.vision.sampling import middle_of
from service.core.vision.target_circles import Circles
from service.core.vision.transforms import Array


def detect_live_circles(half: NDArray[np.uint8], target: Circles) -> LiveDetection:
    """Return what a grey frame at half size (h, w) shows of a grid of dots."""
    dots = gather_dots(*find_live_dots(half))
    lattices = _grow(dots, target)
    boards = [one for one in lattices if not is_larger(one, target)]
    whole = [found for one in boards if (found := order_dots(one, dots.points, target)) is not None]
    # Of two equal boards the larger in the picture counts.
    for points in sorted(whole, key=area_px, reverse=True):
        present = _look_at(half, points, target)
        if present is not None:
            return present
    most = max(lattices, key=len, default=None)
    brightness = float(cv2.mean(half)[0])
    if most is None:
        return LiveDetection("absent", None, 0, None, brightness)
    kind = kind_of_part(most, dots, half.size, target)
    return LiveDetection(kind, None, len(most), None, brightness)


def _grow(dots: Dots, target: Circles) -> list[Lattice]:
    """Return the lattices of likely groups of dots, those as large as the target first.

    A bounded number of dots in all: growing is what takes time.
    """
    needed, most = len(target.object_points), largest_grid(target)
    groups = [group for group in group_dots(dots) if group.size >= LEAST_DOTS]
    lattices, left = list[Lattice](), most
    for group in sorted(groups, key=lambda one: (one.size < needed, abs(one.size - needed))):
        if group.size <= left:
            lattices.append(grow_lattice(dots, group.seed, left))
            left -= len(lattices[-1])
    return lattices


def _look_at(half: NDArray[np.uint8], rough: Array, target: Circles) -> LiveDetection | None:
    """Return the grid with dots near (n, 2) px; None where it goes on, or is not clearly dark and bright."""
    H, cells = fit_homography(target, rough), read_dots(half, rough, target)
    light = fit_light(cells)
    if goes_on(half, light, H, target) or measure_parity(cells, light).separation < LEAST_SEPARATION:
        return None
    axes = rim_axes(rough, target, middle_of(half))
    points = refine_dots(half, light, rough, axes, target)
    look = measure_rims(half, points, axes, target)
    return LiveDetection(
        kind="present",
        image_points=points * LIVE_SCALE + 0.5 * (LIVE_SCALE - 1),
        corners_seen=len(points),
        edge_width_px=look.edge_width_px * LIVE_SCALE,
        brightness=look.brightness,
        glare_share=look.glare_share,
    )
