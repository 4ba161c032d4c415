"""Which part of the image is asked for, and which part of it the corners have covered.

Two zones, rectangles in px: the working zone, where the camera is used and where accuracy counts (by default
the central 70 % of width and height: a driver's head, at every seat and steering-wheel setting, stays away
from the border), and the valid region, up to which the model may be used at all (by default the central 90 %:
a board that must be whole in the image puts hardly a corner nearer to the border, and there the polynomial
extrapolates). Without a SKU nobody has said where the camera is used: the valid region and the working zone
are then what was seen, the convex hull of all corners.
"""

import cv2
import numpy as np

from service.core.vision.transforms import Array
from service.core.vision.uncertainty import Region

WORKING_SHARE = 0.70
VALID_SHARE = 0.90
GRID = (25, 17)


def default_working_zone(image_size: tuple[int, int]) -> Region:
    """Return the central 70 % of width and height."""
    return _central(image_size, WORKING_SHARE)


def default_valid_region(image_size: tuple[int, int]) -> Region:
    """Return the central 90 % of width and height."""
    return _central(image_size, VALID_SHARE)


def zone_grid(zone: Region) -> Array:
    """Return points (m, 2) px spread over a zone, border included."""
    return zone.grid(*GRID)


def seen_grid(image_points: Array) -> Array:
    """Return points (m, 2) px spread over the convex hull of corners (n, 2) px, its own corners included."""
    hull = convex_hull(image_points)
    left, top = hull.min(axis=0)
    right, bottom = hull.max(axis=0)
    grid = Region(float(left), float(top), float(right), float(bottom)).grid(*GRID)
    polygon = hull.astype(np.float32)
    inside = [cv2.pointPolygonTest(polygon, (float(u), float(v)), False) >= 0 for u, v in grid]
    return np.concatenate([grid[np.array(inside)], hull])


def convex_hull(image_points: Array) -> Array:
    """Return the convex hull (h, 2) px of points (n, 2) px."""
    hull = cv2.convexHull(np.asarray(image_points, dtype=np.float32))
    return hull.reshape(-1, 2).astype(np.float64)


def covered_share(image_points: Array, zone: Region) -> float:
    """Return the share of a zone that lies within the convex hull of points (n, 2) px."""
    corners = [
        (zone.left_px, zone.top_px),
        (zone.right_px, zone.top_px),
        (zone.right_px, zone.bottom_px),
        (zone.left_px, zone.bottom_px),
    ]
    area, _ = cv2.intersectConvexConvex(
        convex_hull(image_points).astype(np.float32), np.array(corners, dtype=np.float32)
    )
    whole = (zone.right_px - zone.left_px) * (zone.bottom_px - zone.top_px)
    return min(float(area) / whole, 1.0)


def _central(image_size: tuple[int, int], share: float) -> Region:
    width, height = image_size[0] - 1.0, image_size[1] - 1.0
    edge = (1.0 - share) / 2.0
    return Region(edge * width, edge * height, (1.0 - edge) * width, (1.0 - edge) * height)
