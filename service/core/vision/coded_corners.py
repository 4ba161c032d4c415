"""The corners of a board with markers: where markers put them, refined, and where their neighbours put more.

Not here: finding markers (`marker_detection`), what is measured of the board (`detection_coded`).
"""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.vision.coded import CodedTarget
from service.core.vision.edge_crossing import CROSSING_PX, edges_on_board, refine_crossings
from service.core.vision.marker_detection import Markers, map_points
from service.core.vision.saddle import refine_saddles
from service.core.vision.sampling import FloatImage, sample_bilinear
from service.core.vision.transforms import Array

DISC_RADII_PX = (2, 8)
FIRST_DISC_PX = 4.0
QUADRANT = (0.5, 0.8)  # of the disc: where a quadrant is looked at
LEAST_STEP = 0.4  # between a quadrant that is bright and one that is dark, of the board's contrast
ROUNDS = 3  # in which corners are looked for beside those that are known
NEIGHBOURS = 9
FLATTEST = 0.1  # of the neighbours' spread along its longer axis, across it
STEP = 0.25  # of a square, over which the board's scale is taken


@dataclass(frozen=True)
class Corners:
    """Corners of a board: ids (n,), points (n, 2) px, and a metre of the board in px there (n, 2, 2)."""

    ids: NDArray[np.int64]
    points: Array
    scale: Array

    def part(self, index: NDArray[np.bool_]) -> "Corners":
        """Return some of the corners."""
        return Corners(self.ids[index], self.points[index], self.scale[index])

    def joined(self, other: "Corners") -> "Corners":
        """Return these and other corners, by ascending id."""
        ids = np.concatenate([self.ids, other.ids])
        order = np.argsort(ids)
        points, scale = (
            np.concatenate(pair) for pair in ((self.points, other.points), (self.scale, other.scale))
        )
        return Corners(ids[order], points[order], scale[order])


def first_corners(H: Array, markers: Markers, target: CodedTarget) -> Corners:
    """Return the corners that the markers tell of, each where its markers put it on average."""
    told = [
        (feature, k) for k, marker in enumerate(markers.ids) for feature in target.marker_features[marker]
    ]
    feature, by = np.array(told, dtype=np.int64).T
    places, scale = scale_at(H[by], target.object_points[feature, :2], STEP * target.square_m)
    ids, of = np.unique(feature, return_inverse=True)
    count = np.bincount(of)
    points, scales = np.zeros((len(ids), 2)), np.zeros((len(ids), 2, 2))
    np.add.at(points, of, places)
    np.add.at(scales, of, scale)
    return Corners(ids, points / count[:, None], scales / count[:, None, None])


def find_corners_of(blurred: FloatImage, first: Corners, target: CodedTarget) -> Corners:
    """Return the corners that are where markers put them, and more that these lead to.

    A marker that cannot be read, for a reflection or because it is cut off, still has its corners.
    """
    known = _checked(blurred, refine_corners(blurred, first, FIRST_DISC_PX, target), target)
    for _ in range(ROUNDS):
        told = _told_by_neighbours(known, target)
        more = _checked(blurred, refine_corners(blurred, told, FIRST_DISC_PX, target), target)
        more = more.part(_nearness(more, told) < target.plain_m)
        if not len(more.ids):
            break
        known = known.joined(more)
    return known


def _nearness(found: Corners, told: Corners) -> Array:
    """Return how far (n,), m, corners were found from where they were looked for."""
    at = np.searchsorted(told.ids, found.ids)
    moved = np.linalg.solve(found.scale, (found.points - told.points[at])[..., None])[..., 0]
    return np.asarray(np.linalg.norm(moved, axis=-1))


def _told_by_neighbours(known: Corners, target: CodedTarget) -> Corners:
    """Return the corners that are not known, where the nearest known ones put them; ascending ids."""
    board = target.object_points[:, :2]
    missing = np.setdiff1d(np.arange(len(board)), known.ids)
    told = [_told(feature, known, board, target) for feature in missing]
    found = [one for one in told if one is not None]
    if not found:
        return known.part(np.zeros(len(known.ids), dtype=bool))
    ids, points, scale = (np.array(values) for values in zip(*found, strict=True))
    return Corners(ids, points, scale)


def _told(feature: int, known: Corners, board: Array, target: CodedTarget) -> tuple[int, Array, Array] | None:
    """Return a corner's id, place and scale by a homography of the nearest known ones, if they are near."""
    away = np.linalg.norm(board[known.ids] - board[feature], axis=1)
    near = np.argsort(away, kind="stable")[:NEIGHBOURS]
    places = board[known.ids[near]]
    spread = np.linalg.svd(places - places.mean(axis=0), compute_uv=False)
    if len(near) < NEIGHBOURS or spread[1] < FLATTEST * spread[0] or away[near[0]] > 1.01 * _pitch(board):
        return None
    H = np.asarray(cv2.findHomography(places, known.points[near])[0], dtype=np.float64)
    if H.shape != (3, 3):
        return None
    point, scale = scale_at(H[None], board[feature][None], STEP * target.square_m)
    return feature, point[0], scale[0]


def _pitch(board: Array) -> float:
    """Return the largest distance, m, of a feature from its nearest one or from the next in its row."""
    x = np.unique(board[:, 0])
    y = np.unique(board[:, 1])
    return float(max(np.diff(x).max(), np.diff(y).max()))


def scale_at(H: Array, board: Array, step_m: float) -> tuple[Array, Array]:
    """Return where homographies (n, 3, 3) put board points (n, 2), px, and a metre in px there (n, 2, 2)."""
    around = board[:, None] + step_m * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    places = map_points(H, around)
    scale = np.stack([places[:, 1] - places[:, 0], places[:, 2] - places[:, 0]], axis=-1) / step_m
    return places[:, 0], scale


def refine_corners(image: FloatImage, corners: Corners, wanted_px: float, target: CodedTarget) -> Corners:
    """Return the corners that a saddle fit proves, with a disc of the wanted size if there is room for it."""
    room = np.floor(target.disc_m * np.linalg.norm(corners.scale, axis=1).min(axis=1))
    radii = np.clip(np.minimum(np.rint(wanted_px), room), *DISC_RADII_PX).astype(np.int64)
    points, proven = refine_saddles(image, corners.points, radii, iterations=20)
    return Corners(corners.ids, points, corners.scale).part(proven)


def cross_edges(
    image: FloatImage, corners: Corners, sigma_px: float, middle: Array, target: CodedTarget
) -> Corners:
    """Return the corners where their edges cross in an evenly lit image.

    sigma_px: of the edges' blur; middle: (2,) px, of the whole picture, of which the image may be a part.
    """
    board = target.object_points[corners.ids, :2]
    edges = edges_on_board(board, corners.points, target.square_m, middle)
    room = target.disc_m * np.linalg.norm(corners.scale, axis=1).min(axis=1)
    points, _ = refine_crossings(image, corners.points, edges, np.minimum(room, CROSSING_PX), sigma_px)
    return Corners(corners.ids, points, corners.scale)


def _checked(blurred: FloatImage, corners: Corners, target: CodedTarget) -> Corners:
    """Return the corners around which dark and bright quadrants are as they must be."""
    if not len(corners.ids):
        return corners
    row, column = np.divmod(corners.ids, target.columns)
    reach = target.disc_m / np.sqrt(2.0) * np.array(QUADRANT)
    diagonals = np.array([[-1.0, -1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, 1.0]])
    spots = (reach[:, None] * diagonals[:, None]).reshape(-1, 2)
    pixels = corners.points[:, None] + spots @ np.swapaxes(corners.scale, 1, 2)
    level = sample_bilinear(blurred, pixels[..., 0], pixels[..., 1])
    along, across = np.split(level, 2, axis=1)
    even = (row + column) % 2 == 0
    dark, bright = np.where(even[:, None], along, across), np.where(even[:, None], across, along)
    step = bright.min(axis=1) - dark.max(axis=1)
    contrast = np.median(bright.mean(axis=1) - dark.mean(axis=1))
    return corners.part(step > max(LEAST_STEP * float(contrast), 0.0))
