"""How sharp the picture of a board is: the 10–90 % widths of the edges of its squares.

Sampling between pixels adds about a sixth to an edge of 2 px, and nothing that matters to one of 4 px.
Not here: limits (`quality.gates`).
"""

from dataclasses import dataclass

import numpy as np

from service.core.vision.sampling import FloatImage, sample_bilinear
from service.core.vision.transforms import Array

PLACES = np.linspace(0.3, 0.7, 5)  # along an edge, away from its corners
SAMPLES = 65  # across an edge
REACH = 0.42  # of the square on either side
LONGEST_REACH_PX = 24.0
LEAST_EDGES = 6


@dataclass(frozen=True)
class Sharpness:
    """10–90 % edge widths, px.

    edge_width_px: median over the board. quadrants_px: medians of the edges that lie in the image's top left,
    top right, bottom right and bottom left quadrant. centre_px: of those in the middle half of its width and
    height. NaN where fewer than six edges lie.
    """

    edge_width_px: float
    quadrants_px: tuple[float, float, float, float]
    centre_px: float


def measure_sharpness(image: FloatImage, corners: Array) -> Sharpness:
    """Return the sharpness of an image (h, w) along the edges of a board's corners (rows, columns, 2) px."""
    rows = _inner_edges(corners)
    columns = _inner_edges(np.swapaxes(corners, 0, 1))
    spots, across = (np.concatenate(parts) for parts in zip(rows, columns, strict=True))
    return measure_edges(image, spots, across)


def measure_edges(image: FloatImage, spots: Array, across: Array) -> Sharpness:
    """Return the sharpness of an image (h, w) at edges, each by the median over its spots.

    spots: (k, s, 2) px on the edges; across: (k, 2) px from an edge to where its side is plain, at a right
    angle to it.
    """
    middle, width = spots.mean(axis=1), _edge_widths(image, spots, across)
    size = np.array([image.shape[1], image.shape[0]])
    offset = (middle - 0.5 * (size - 1)) / size
    right, low = offset[:, 0] >= 0, offset[:, 1] >= 0
    quadrants = [~right & ~low, right & ~low, right & low, ~right & low]
    tl, tr, br, bl = (_median(width[part]) for part in quadrants)
    return Sharpness(_median(width), (tl, tr, br, bl), _median(width[np.abs(offset).max(axis=1) < 0.25]))


def _median(widths: Array) -> float:
    known = widths[~np.isnan(widths)]
    return float(np.median(known)) if known.size >= LEAST_EDGES else float("nan")


def _inner_edges(corners: Array) -> tuple[Array, Array]:
    """Return the spots (n, s, 2) and reaches (n, 2), px, of the edges along the inner rows of corners."""
    start, end = corners[1:-1, :-1], corners[1:-1, 1:]
    along = end - start
    length = np.linalg.norm(along, axis=-1, keepdims=True)
    normal = np.stack([-along[..., 1], along[..., 0]], axis=-1) / length
    heights = [
        np.abs(np.sum((other - start) * normal, axis=-1)) for other in (corners[:-2, :-1], corners[2:, :-1])
    ]
    reach = np.minimum(REACH * np.minimum(*heights), LONGEST_REACH_PX)
    spots = start[..., None, :] + along[..., None, :] * PLACES[:, None]
    return spots.reshape(-1, len(PLACES), 2), (normal * reach[..., None]).reshape(-1, 2)


def _edge_widths(image: FloatImage, spots: Array, across: Array) -> Array:
    """Return the 10–90 % widths (k,) px of edges, the median of those at their spots (k, s, 2)."""
    grid = spots[..., None, :] + across[:, None, None, :] * np.linspace(-1, 1, SAMPLES)[:, None]
    profiles = sample_bilinear(image, grid[..., 0], grid[..., 1])
    reach = np.linalg.norm(across, axis=-1)
    step = np.broadcast_to(2.0 * reach[:, None] / (SAMPLES - 1), profiles.shape[:-1])
    widths = _width_10_90(profiles.reshape(-1, SAMPLES), step.reshape(-1)).reshape(profiles.shape[:-1])
    return np.asarray(np.median(widths, axis=-1))


def _width_10_90(profiles: Array, step_px: Array) -> Array:
    """Return the 10–90 % widths (n,) px of profiles (n, samples) whose samples are step_px (n,) apart."""
    ends = SAMPLES // 8
    low, high = profiles[:, :ends].mean(axis=1), profiles[:, -ends:].mean(axis=1)
    level = (profiles - low[:, None]) / np.where(high == low, 1.0, high - low)[:, None]
    middle = np.argmax(level >= 0.5, axis=1)
    index = np.arange(SAMPLES)
    # The last crossing of 10 % before the middle and the first of 90 % after it.
    below = np.where((level < 0.1) & (index < middle[:, None]), index, -1).max(axis=1)
    above = np.where((level > 0.9) & (index >= middle[:, None]), index, SAMPLES).min(axis=1)
    good = (below >= 0) & (above < SAMPLES) & (high != low)
    below, above = np.where(good, below, 0), np.where(good, above, 1)
    at_10 = below + _fraction(level, below, 0.1)
    at_90 = above - 1 + _fraction(level, above - 1, 0.9)
    return np.where(good, (at_90 - at_10) * step_px, np.nan)


def _fraction(level: Array, index: Array, wanted: float) -> Array:
    """Return how far (n,) between sample index and index + 1 a profile reaches a level."""
    rows = np.arange(len(level))
    here, following = level[rows, index], level[rows, index + 1]
    gap = following - here
    return np.asarray((wanted - here) / np.where(gap == 0, 1.0, gap), dtype=np.float64)
