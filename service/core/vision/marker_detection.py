"""Which markers an image shows, and which of them lie as on the declared board.

The ids come from OpenCV's detector, whose corners are good to a pixel. Not here: the board's own corners
(`detection_coded`), what is said when there are none (`marker_refusal`).
"""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.vision.coded import CodedTarget
from service.core.vision.markers import marker_dictionary
from service.core.vision.transforms import Array

SMALLEST_PERIMETER = 0.02  # of the image's longer side
TOLERANCE = 0.35  # of a marker's side: where a neighbour says that it is
SAME_RING = 1.05  # of the smallest distance of two markers on the board


@dataclass(frozen=True)
class Markers:
    """Markers in an image: ids (k,), corners (k, 4, 2) px in the dictionary's order."""

    ids: NDArray[np.int64]
    corners: Array

    def __len__(self) -> int:
        return len(self.ids)

    def part(self, index: NDArray[np.bool_] | NDArray[np.int64]) -> "Markers":
        """Return some of the markers."""
        return Markers(self.ids[index], self.corners[index])

    @property
    def sides_px(self) -> Array:
        """The mean side (k,) of each."""
        along = np.roll(self.corners, -1, axis=1) - self.corners
        return np.asarray(np.linalg.norm(along, axis=-1).mean(axis=1))


def find_markers(image: NDArray[np.uint8], dictionary: str, border: int) -> Markers:
    """Return all markers of a dictionary, with a dark border of so many cells, in a grey image (h, w)."""
    parameters = cv2.aruco.DetectorParameters()
    parameters.markerBorderBits = border
    parameters.minMarkerPerimeterRate = SMALLEST_PERIMETER
    parameters.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_NONE
    detector = cv2.aruco.ArucoDetector(marker_dictionary(dictionary), parameters)
    corners, ids, _ = detector.detectMarkers(image)
    count = len(corners)
    if count == 0:
        return Markers(np.zeros(0, dtype=np.int64), np.zeros((0, 4, 2)))
    return Markers(
        np.asarray(ids, dtype=np.int64).reshape(count),
        np.asarray(corners, dtype=np.float64).reshape(count, 4, 2),
    )


@dataclass(frozen=True)
class Layout:
    """Markers that the declared board has: those that lie as they should, and how many pairs do not."""

    fitting: Markers
    pairs: int
    pairs_apart: int


def compare_layout(found: Markers, target: CodedTarget) -> Layout:
    """Return the largest group of markers that lie to each other as on the board, of ids that it has."""
    board = target.marker_corners
    first, second = _pairs(found, board)
    fits = _fits(found, board, first, second) & _fits(found, board, second, first)
    group = _largest_group(len(found), first[fits], second[fits])
    return Layout(found.part(group), len(first), int(np.count_nonzero(~fits)))


def board_to_image(board: Array, corners: Array) -> Array:
    """Return the homographies (k, 3, 3) that take squares (k, 4, 2), m, to corners (k, 4, 2), px."""
    x, y = board[..., 0], board[..., 1]
    u, v = corners[..., 0], corners[..., 1]
    one, zero = np.ones_like(x), np.zeros_like(x)
    upper = np.stack([x, y, one, zero, zero, zero, -u * x, -u * y], axis=-1)
    lower = np.stack([zero, zero, zero, x, y, one, -v * x, -v * y], axis=-1)
    right = np.concatenate([u, v], axis=1)[..., None]
    h = np.linalg.solve(np.concatenate([upper, lower], axis=1), right)[..., 0]
    return np.concatenate([h, np.ones((len(h), 1))], axis=1).reshape(-1, 3, 3)


def map_points(H: Array, points: Array) -> Array:
    """Return points (k, n, 2) taken by homographies (k, 3, 3)."""
    mapped = points @ np.swapaxes(H[:, :, :2], 1, 2) + H[:, None, :, 2]
    return np.asarray(mapped[..., :2] / mapped[..., 2:])


def _pairs(found: Markers, board: Array) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the pairs (p,), (p,) of markers that are next to each other on the board."""
    centres = board.mean(axis=1)
    pitch = np.sort(np.linalg.norm(centres - centres[0], axis=1))[1]
    away = np.linalg.norm(centres[found.ids][:, None] - centres[found.ids], axis=-1)
    first, second = np.nonzero(np.triu((away > 0) & (away < SAME_RING * pitch)))
    return first.astype(np.int64), second.astype(np.int64)


def _fits(found: Markers, board: Array, at: NDArray[np.int64], of: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Return whether markers `of` (p,) lie where markers `at` (p,) say."""
    if not len(at):
        return np.zeros(0, dtype=bool)
    H = board_to_image(board[found.ids[at]], found.corners[at])
    told = map_points(H, board[found.ids[of]].mean(axis=1)[:, None])[:, 0]
    off = np.linalg.norm(told - found.corners[of].mean(axis=1), axis=-1)
    return np.asarray(off < TOLERANCE * found.sides_px[of])


def _largest_group(count: int, first: NDArray[np.int64], second: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the indices of the largest group that pairs connect."""
    label = np.arange(count)
    for _ in range(count):
        least = np.minimum(label[first], label[second])
        before = label.copy()
        np.minimum.at(label, first, least)
        np.minimum.at(label, second, least)
        if np.array_equal(before, label):
            break
    if count == 0:
        return label
    return np.flatnonzero(label == np.bincount(label).argmax())
