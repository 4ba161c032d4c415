"""Which dots of a captured image are the grid, in the target's order: OpenCV's blobs, on a lattice.

Not here: how a lattice grows (`dot_lattice`), and where exactly each dot is (`circle_centres`).
"""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.vision.dot_lattice import gather_dots, grow_lattice, order_dots
from service.core.vision.target_circles import Circles
from service.core.vision.transforms import Array

SMALLEST_AREA_PX = 20.0
LARGEST_AREA_SHARE = 0.02  # of the image
CLOSEST_PX = 4.0
LEAST_CONVEXITY = 0.8
LEAST_INERTIA = 0.1  # a dot seen at 70 degrees
MOST_TRIED = 480  # dots, in lattices that are not the grid


@dataclass(frozen=True)
class FoundGrid:
    """Centres (n, 2) px to about a pixel, in the target's order, None without a grid; dots seen at most."""

    centres: Array | None
    most_seen: int


def find_grid(image: NDArray[np.uint8], target: Circles) -> FoundGrid:
    """Return the dots of the grid in a grey image (h, w)."""
    blobs = _blob_detector(image).detect(image)
    points = np.array([blob.pt for blob in blobs], dtype=np.float64).reshape(-1, 2)
    dots = gather_dots(points, np.array([blob.size**2 for blob in blobs]))
    needed, most_seen = len(target.object_points), 0
    tried: set[int] = set()
    for seed in range(len(blobs)):
        if seed in tried or len(tried) > MOST_TRIED:
            continue
        lattice = grow_lattice(dots, seed, len(blobs))
        tried |= {seed, *lattice.dots.tolist()}
        most_seen = max(most_seen, min(len(lattice), needed - 1))
        ordered = order_dots(lattice, dots.points, target) if len(lattice) >= needed else None
        if ordered is not None:
            return FoundGrid(ordered, needed)
    return FoundGrid(None, most_seen)


def fit_homography(target: Circles, centres: Array) -> Array:
    """Return the homography (3, 3) from the board, m, to dots' centres (n, 2), px."""
    H, _ = cv2.findHomography(target.object_points[:, :2], centres)
    return np.asarray(H, dtype=np.float64)


def apply_homography(H: Array, points: Array) -> Array:
    """Return points (..., 2) taken by a homography (3, 3)."""
    mapped = points @ H[:, :2].T + H[:, 2]
    return np.asarray(mapped[..., :2] / mapped[..., 2:])


def _blob_detector(image: NDArray[np.uint8]) -> cv2.SimpleBlobDetector:
    parameters = cv2.SimpleBlobDetector.Params()
    parameters.minDistBetweenBlobs = CLOSEST_PX
    parameters.filterByArea = True
    parameters.minArea = SMALLEST_AREA_PX
    parameters.maxArea = LARGEST_AREA_SHARE * image.size
    parameters.filterByColor = True
    parameters.blobColor = 0
    parameters.filterByCircularity = False
    parameters.filterByInertia = True
    parameters.minInertiaRatio = LEAST_INERTIA
    parameters.filterByConvexity = True
    parameters.minConvexity = LEAST_CONVEXITY
    return cv2.SimpleBlobDetector.create(parameters)
