"""Where the centres of dots are in an image: the centroid of what is dark, freed from its bias.

The image of a disc's centre is not the centroid of the disc's image: perspective and lens stretch the near
half of a dot more than the far one. The mapping from board to image is known well enough from the dots
themselves (`board_map`) to say by how much, and this is taken off.
Not here: finding the grid (`circle_grid`), the rims of dots (`dot_rims`).
"""

import numpy as np

from service.core.vision.board_map import fit_board_map
from service.core.vision.circle_grid import apply_homography, fit_homography
from service.core.vision.light import LightFall
from service.core.vision.map_form import BoardMap
from service.core.vision.sampling import FloatImage, middle_of
from service.core.vision.target_circles import Circles
from service.core.vision.transforms import Array

ROUNDS = 3
RIM_POINTS = 48
SOFT_RIM_PX = 4.0  # beyond a dot's rim: the blur of a picture that can be used
GAP_SHARE = 0.45  # of the way to the next dot's rim


def refine_centres(image: FloatImage, light: LightFall, first: Array, target: Circles) -> Array:
    """Return the images (n, 2), px, of the dots' centres, from centres (n, 2) that are right to a pixel."""
    points, bias = first, np.zeros_like(first)
    middle = middle_of(image)
    for _ in range(ROUNDS):
        centroids = _centroids(image, light, points + bias, target)
        board_map = fit_board_map(target.object_points[:, :2], centroids - bias, middle)
        bias = centroid_bias(board_map, target)
        points = centroids - bias
    return points


def centroid_bias(board_map: BoardMap, target: Circles) -> Array:
    """Return by how much (n, 2), px, the centroids of dots' images are off the images of their centres."""
    angle = np.arange(RIM_POINTS) * (2.0 * np.pi / RIM_POINTS)
    rim = 0.5 * target.diameter_m * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    centres = target.object_points[:, :2]
    middle = board_map.image_of(centres)
    outline = board_map.image_of(centres[:, None] + rim) - middle[:, None]
    following = np.roll(outline, -1, axis=1)
    twice = outline[..., 0] * following[..., 1] - outline[..., 1] * following[..., 0]
    moment = ((outline + following) * twice[..., None]).sum(axis=1)
    return np.asarray(moment / (3.0 * twice.sum(axis=1)[:, None]))


def _centroids(image: FloatImage, light: LightFall, points: Array, target: Circles) -> Array:
    """Return the centroids (n, 2), px, of the darkness around points (n, 2)."""
    H = fit_homography(target, points)
    board = target.object_points[:, :2]
    along = 0.5 * target.diameter_m * np.eye(2)
    axes = np.stack([apply_homography(H, board + side) - points for side in along], axis=-1)
    gap_m = np.sqrt(2.0) * target.step_m - target.diameter_m
    out = np.empty_like(points)
    for k, (point, axis) in enumerate(zip(points, axes, strict=True)):
        radius_px = float(np.linalg.svd(axis, compute_uv=False)[0])
        room = 1.0 + GAP_SHARE * gap_m / (0.5 * target.diameter_m)
        reach = min(room, 1.0 + SOFT_RIM_PX / max(float(np.linalg.svd(axis, compute_uv=False)[1]), 1e-6))
        out[k] = _centroid(image, light, point, (axis, reach, radius_px))
    return out


def _centroid(image: FloatImage, light: LightFall, point: Array, within: tuple[Array, float, float]) -> Array:
    """Return the centroid (2,) of the darkness in an ellipse: axes (2, 2), how many of them, its radius."""
    axes, reach, radius_px = within
    half = int(np.ceil(reach * radius_px)) + 2
    height, width = image.shape
    left, top = np.rint(point).astype(int) - half
    low_x, low_y = max(left, 0), max(top, 0)
    high_x, high_y = min(left + 2 * half + 1, width), min(top + 2 * half + 1, height)
    y, x = np.mgrid[low_y:high_y, low_x:high_x].astype(np.float64)
    inside = np.linalg.solve(axes, np.stack([x - point[0], y - point[1]]).reshape(2, -1))
    # The border of the window is soft, so that pixels do not jump in and out of it.
    window = np.clip((reach - np.hypot(*inside)) * radius_px + 0.5, 0.0, 1.0).reshape(x.shape)
    bright, dark = light.levels(x, y)
    weight = window * (bright - image[low_y:high_y, low_x:high_x]) / np.maximum(bright - dark, 1.0)
    total = max(float(weight.sum()), 1e-9)
    return np.array([float((weight * x).sum()), float((weight * y).sum())]) / total
