"""Points that look like a chessboard corner: saddle response, the strongest of them, and a ring around each.

Around a corner a ring of samples changes between dark and bright exactly four times, and it looks the same
turned by 180 degrees. The four changes are the corner's slots: the directions of its edges, numbered in the
sense of growing image angle (x to y) so that the squares between slots 0 and 1 and between 2 and 3 are the
dark ones. A neighbour along an edge has the colours the other way round, which is what makes linking safe.
Not here: which corners are neighbours (`corner_grid`).
"""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.vision.saddle import refine_saddles
from service.core.vision.sampling import FloatImage, smooth
from service.core.vision.transforms import Array

RING_SAMPLES = 32
BEFORE, FOLLOWING = (np.roll(np.arange(RING_SAMPLES), places) for places in (1, -1))
RING_X, RING_Y = (way(np.arange(RING_SAMPLES) * (2.0 * np.pi / RING_SAMPLES)) for way in (np.cos, np.sin))
SIGMA_PX = 1.1
LEAST_CONTRAST = 5.0  # grey levels
MANY_CELLS = 1 << 32
RADII_PX = (4.0, 6.5, 2.8)  # ordinary, blurred or noisy, tiny squares


@dataclass(frozen=True)
class Corners:
    """Candidates: points (n, 2) px; slots (n, 4), angles of the edges, rad; contrast (n,), grey levels."""

    points: Array
    slots: Array
    contrast: Array

    def __len__(self) -> int:
        return len(self.points)

    def take(self, index: NDArray[np.int64] | NDArray[np.bool_]) -> "Corners":
        """Return the candidates of an index or mask."""
        return Corners(self.points[index], self.slots[index], self.contrast[index])


def find_corners(image: NDArray[np.uint8], limit: int = 1000) -> Corners:
    """Return corner candidates of an image (h, w), at most `limit` of the strongest saddle points."""
    blurred = smooth(image, SIGMA_PX)
    peaks = strongest_peaks(saddle_response(blurred), limit)
    points, proven = refine_saddles(blurred, peaks, np.full(len(peaks), 2), iterations=4, tolerance_px=0.05)
    points = points[proven]
    found: list[Corners] = []
    for radius in RADII_PX:
        passed, corners = inspect_rings(blurred, points, np.full(len(points), radius))
        found.append(corners)
        points = points[~passed]
    return without_twins(join_corners(found))


def saddle_response(blurred: FloatImage) -> FloatImage:
    """Return Ixy² − Ixx Iyy (h, w): large where the surface curves up one way and down the other."""
    xx = cv2.Sobel(blurred, cv2.CV_32F, 2, 0)
    yy = cv2.Sobel(blurred, cv2.CV_32F, 0, 2)
    xy = cv2.Sobel(blurred, cv2.CV_32F, 1, 1)
    cv2.multiply(xy, xy, dst=xy)
    cv2.multiply(xx, yy, dst=xx)
    return np.asarray(cv2.subtract(xy, xx, dst=xy), dtype=np.float32)


def strongest_peaks(response: FloatImage, limit: int, border: int = 4) -> Array:
    """Return the local maxima (n, 2) px of a response, strongest first, at most `limit`."""
    highest = cv2.dilate(response, np.ones((5, 5), np.uint8))
    inner = np.zeros(response.shape, dtype=bool)
    inner[border:-border, border:-border] = True
    is_peak = (response >= highest) & (response > 1.0) & inner
    flat = np.flatnonzero(is_peak)
    strength = response.ravel()[flat]
    if flat.size > limit:
        keep = np.argpartition(-strength, limit)[:limit]
        flat, strength = flat[keep], strength[keep]
    flat = flat[np.argsort(-strength, kind="stable")]
    return np.stack([flat % response.shape[1], flat // response.shape[1]], axis=-1).astype(np.float64)


def inspect_rings(blurred: FloatImage, points: Array, radii: Array) -> tuple[NDArray[np.bool_], Corners]:
    """Test points (n, 2) with rings of radii (n,) px; return which passed (n,) and those as corners."""
    if not len(points):
        return np.zeros(0, dtype=bool), Corners(np.zeros((0, 2)), np.zeros((0, 4)), np.zeros(0))
    values = _ring_values(blurred, points, radii)
    ordered = np.sort(values, axis=1)
    bright, dark = ordered[:, -8:-2].sum(axis=1) / 6.0, ordered[:, 2:8].sum(axis=1) / 6.0
    contrast = bright - dark
    centred = values - 0.5 * (bright + dark)[:, None]
    half = RING_SAMPLES // 2
    asymmetry = np.abs(values[:, :half] - values[:, half:]).sum(axis=1) / half
    above = centred > 0
    changes = above != above[:, FOLLOWING]
    passed = (changes.sum(axis=1) == 4) & (contrast > LEAST_CONTRAST) & (asymmetry < 0.3 * contrast)
    slots, good = _slots(centred[passed], changes[passed])
    passed[np.flatnonzero(passed)[~good]] = False
    return passed, Corners(points[passed], slots[good], contrast[passed])


def _ring_values(blurred: FloatImage, points: Array, radii: Array) -> Array:
    """Return grey values (n, RING_SAMPLES) on rings, smoothed along the ring."""
    x = (points[:, :1] + radii[:, None] * RING_X).astype(np.float32)
    y = (points[:, 1:] + radii[:, None] * RING_Y).astype(np.float32)
    values = cv2.remap(blurred, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE).astype(np.float64)
    smooth: Array = 0.5 * values + 0.25 * (values[:, BEFORE] + values[:, FOLLOWING])
    return smooth


def _slots(centred: Array, changes: NDArray[np.bool_]) -> tuple[Array, NDArray[np.bool_]]:
    """Return slot angles (n, 4) of rings with four changes, and whether they lie like two crossing lines."""
    at = np.nonzero(changes)[1].reshape(-1, 4)
    rows = np.arange(len(at))[:, None]
    here, following = centred[rows, at], centred[rows, (at + 1) % RING_SAMPLES]
    angle = (at + here / (here - following)) * (2.0 * np.pi / RING_SAMPLES)
    crooked = np.abs(angle[:, 2:] - angle[:, :2] - np.pi).max(axis=1) if len(at) else np.zeros(0)
    line = 0.5 * (angle[:, :2] + angle[:, 2:] - np.pi)
    opening = line[:, 1] - line[:, 0]
    good = (crooked < 0.5) & (opening > 0.3) & (opening < np.pi - 0.3)
    # The sector after the first change is dark when it is a fall; otherwise the count starts one later.
    falls = here[:, 0] > 0
    first = np.where(falls, line[:, 0], line[:, 1])
    second = np.where(falls, line[:, 1], line[:, 0] + np.pi)
    return np.stack([first, second, first + np.pi, second + np.pi], axis=-1), good


def join_corners(parts: list[Corners]) -> Corners:
    """Return the candidates of all parts."""
    return Corners(
        np.concatenate([part.points for part in parts]),
        np.concatenate([part.slots for part in parts]),
        np.concatenate([part.contrast for part in parts]),
    )


def without_twins(corners: Corners, distance_px: float = 2.0) -> Corners:
    """Return the candidates without those that ran to the same saddle point as one before them."""
    if len(corners) < 2:
        return corners
    x, y = np.round(corners.points / distance_px).astype(np.int64).T
    # One number for each cell: rows of two are sorted far more slowly.
    _, first = np.unique(x * MANY_CELLS + y, return_index=True)
    return corners.take(np.sort(first))
