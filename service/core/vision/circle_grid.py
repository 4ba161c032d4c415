"""Which dots of an image are the grid, in the target's order. Not here: where exactly each of them is.

Blobs are OpenCV's; the grid is grown from one blob to the next, as dots lie on a lattice whatever the
perspective. The order is never mirrored, and where a symmetric grid leaves a choice, x points as far to the
right in the image as it can.
"""

from collections import deque
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from service.core.vision.target_circles import Circles
from service.core.vision.transforms import Array

SMALLEST_AREA_PX = 20.0
LARGEST_AREA_SHARE = 0.02  # of the image
CLOSEST_PX = 4.0
LEAST_CONVEXITY = 0.8
LEAST_INERTIA = 0.1  # a dot seen at 70 degrees
MOST_SEEDS = 60
NEAREST = 8
LEAST_SINE = 0.4  # of the angle between the two ways from a dot to the next
OFF_SHARE = 0.3  # of a way: how far the next dot may be from where it is looked for
# Ways between neighbouring dots, in steps; two of them that span an area of two make the lattice.
WAYS = ((1, 1), (1, -1), (-1, 1), (-1, -1), (2, 0), (-2, 0), (0, 2), (0, -2))
AREA = 2

Place = tuple[int, int]


@dataclass(frozen=True)
class FoundGrid:
    """Centres (n, 2) px to about a pixel, in the target's order, None without a grid; dots seen at most."""

    centres: Array | None
    most_seen: int


def find_grid(image: NDArray[np.uint8], target: Circles) -> FoundGrid:
    """Return the dots of the grid in a grey image (h, w)."""
    blobs = np.array([blob.pt for blob in _blob_detector(image).detect(image)], dtype=np.float64).reshape(
        -1, 2
    )
    needed, most_seen = len(target.object_points), 0
    tried: set[int] = set()
    for seed in range(len(blobs)):
        if seed in tried or len(tried) > MOST_SEEDS * NEAREST:
            continue
        lattice = _grow(blobs, seed)
        tried |= {seed, *lattice.places.values()}
        most_seen = max(most_seen, min(len(lattice.places), needed - 1))
        ordered = _in_order(lattice, blobs, target) if len(lattice.places) >= needed else None
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


@dataclass(frozen=True)
class _Lattice:
    """Blobs by how many times each of two ways leads to them, and whether the ways turn clockwise."""

    places: dict[Place, int]
    clockwise: bool


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


def _grow(blobs: Array, seed: int) -> _Lattice:
    """Return the lattice of blobs around one, each way corrected by the last step that was taken."""
    tree = cKDTree(blobs)
    ways = _first_ways(blobs, seed, tree)
    if ways is None:
        return _Lattice({(0, 0): seed}, clockwise=True)
    places: dict[Place, int] = {(0, 0): seed}
    used, waiting = {seed}, deque([((0, 0), ways)])
    while waiting:
        place, ways = waiting.popleft()
        for axis, sign in ((0, 1), (0, -1), (1, 1), (1, -1)):
            there = (place[0] + sign * (axis == 0), place[1] + sign * (axis == 1))
            away, nearest = tree.query(blobs[places[place]] + sign * ways[axis])
            found = int(nearest)
            if there in places or found in used or away > OFF_SHARE * np.linalg.norm(ways[axis]):
                continue
            places[there] = found
            used.add(found)
            taken = ways.copy()
            taken[axis] = sign * (blobs[found] - blobs[places[place]])
            waiting.append((there, taken))
    return _Lattice(places, bool(_cross(*ways) > 0))


def _first_ways(blobs: Array, seed: int, tree: cKDTree) -> Array | None:
    """Return the ways (2, 2), px, to the nearest blob and to the nearest one in another direction."""
    _, nearest = tree.query(blobs[seed], k=min(NEAREST, len(blobs)))
    ways = blobs[np.atleast_1d(nearest)[1:]] - blobs[seed]
    for way in ways[1:]:
        sine = abs(_cross(ways[0], way)) / (np.linalg.norm(ways[0]) * np.linalg.norm(way))
        if sine > LEAST_SINE:
            return np.stack([ways[0], way])
    return None


def _in_order(lattice: _Lattice, blobs: Array, target: Circles) -> Array | None:
    """Return the dots in the target's order; None where the lattice does not hold the target's shape."""
    number, step = np.arange(target.rows * target.columns), target.step_m
    wanted = np.rint(target.object_points[:, :2] / step).astype(np.int64)
    fitting: list[tuple[float, Array]] = []
    for first in WAYS:
        for second in WAYS:
            if first[0] * second[1] - first[1] * second[0] != (AREA if lattice.clockwise else -AREA):
                continue
            steps = {
                (a * first[0] + b * second[0], a * first[1] + b * second[1]): blob
                for (a, b), blob in lattice.places.items()
            }
            found = _placed(steps, wanted)
            if found is not None:
                points = blobs[found][number]
                ahead = points[target.columns - 1] - points[0]
                fitting.append((float(ahead[0] / np.linalg.norm(ahead)), points))
    return max(fitting, key=lambda fit: fit[0])[1] if fitting else None


def _placed(steps: dict[Place, int], wanted: NDArray[np.int64]) -> list[int] | None:
    """Return the blobs at places wanted (n, 2), shifted so that each is there; None if they cannot be."""
    for x, y in steps:
        found = [steps.get((x + int(u), y + int(v))) for u, v in wanted]
        whole = [blob for blob in found if blob is not None]
        if len(whole) == len(wanted):
            return whole
    return None


def _cross(a: Array, b: Array) -> float:
    return float(a[0] * b[1] - a[1] * b[0])
