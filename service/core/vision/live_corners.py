"""Corner candidates of a live frame: those of `corner_candidates`, in a bounded time and from kept buffers.

A rough ring of whole pixels throws out most saddle points before anything is interpolated.
Not here: which corners are neighbours (`corner_grid`).
"""

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.vision.corner_candidates import (
    LEAST_CONTRAST,
    RADII_PX,
    SIGMA_PX,
    Corners,
    inspect_rings,
    join_corners,
    without_twins,
)
from service.core.vision.saddle import disc_fit, saddle_of
from service.core.vision.sampling import FloatImage
from service.core.vision.transforms import Array

CANDIDATES = 400
BORDER_PX = 4
ROUGH_SAMPLES = 16
ROUGH_X, ROUGH_Y = (
    np.rint(
        np.array(RADII_PX)[:, None] * way(np.arange(ROUGH_SAMPLES) * (2.0 * np.pi / ROUGH_SAMPLES))
    ).astype(np.int64)
    for way in (np.cos, np.sin)
)
NEAR = np.ones((5, 5), np.uint8)
LARGEST_DISC_PX = 3
PASSES = 3
SETTLED_PX = 0.8  # largest last step, from a whole pixel


class LiveWorkspace:
    """Buffers that the detector of one stream uses again from frame to frame; not for two threads at once."""

    def __init__(self) -> None:
        """Hold nothing until the first frame."""
        self._floats: dict[str, FloatImage] = {}

    def floats(self, name: str, shape: tuple[int, ...]) -> FloatImage:
        """Return a buffer (h, w) whose content is that of its last use; zeros when it is new."""
        buffer = self._floats.get(name)
        if buffer is None or buffer.shape != shape:
            buffer = self._floats[name] = np.zeros(shape, dtype=np.float32)
        return buffer


def smooth_frame(image: NDArray[np.uint8], workspace: LiveWorkspace) -> FloatImage:
    """Return a frame (h, w) blurred as the candidates need it, in a buffer of the workspace."""
    floats = workspace.floats("floats", image.shape)
    floats[...] = image
    blurred = workspace.floats("blurred", image.shape)
    cv2.GaussianBlur(floats, (5, 5), SIGMA_PX, dst=blurred)
    return blurred


def find_live_corners(blurred: FloatImage, workspace: LiveWorkspace) -> Corners:
    """Return corner candidates of a smoothed frame (h, w): the best of the 400 strongest saddle points."""
    peaks = _strongest(_response(blurred, workspace), workspace)
    likely = peaks[_has_rough_ring(blurred, peaks)]
    points, proven = refine_on_pixels(blurred, likely, np.full(len(likely), 2))
    points = points[proven]
    found: list[Corners] = []
    for radius in RADII_PX:
        passed, corners = inspect_rings(blurred, points, np.full(len(points), radius))
        found.append(corners)
        points = points[~passed]
    return without_twins(join_corners(found))


def refine_on_pixels(
    blurred: FloatImage, points: Array, radii: NDArray[np.int64]
) -> tuple[Array, NDArray[np.bool_]]:
    """Return saddle points (n, 2) px near the given ones, and which of them (n,) are proven.

    As `refine_saddles`, on the whole pixels around each point instead of values between them, three times,
    and over discs of at most 3 px: a few hundredths of a pixel are left over.
    """
    refined, proven = np.array(points), np.zeros(len(points), dtype=bool)
    small = radii < LARGEST_DISC_PX
    for radius, group in ((LARGEST_DISC_PX - 1, small), (LARGEST_DISC_PX, ~small)):
        if group.any():
            refined[group], proven[group] = _refine_group(blurred, refined[group], radius)
    return refined, proven


def _refine_group(blurred: FloatImage, start: Array, radius: int) -> tuple[Array, NDArray[np.bool_]]:
    height, width = blurred.shape
    offsets, fit = disc_fit(radius)
    disc = (offsets[:, 1] * width + offsets[:, 0]).astype(np.int64)
    flat, last = blurred.ravel(), np.array([width - 1 - radius, height - 1 - radius])
    points, size = start, np.zeros(len(start))
    whole = np.rint(start)
    proven = np.all((whole >= radius) & (whole <= last), axis=1)
    for _ in range(PASSES):
        centre = np.minimum(np.maximum(np.rint(points), radius), last).astype(np.int64)
        values = flat[(centre[:, 1] * width + centre[:, 0])[:, None] + disc].astype(np.float64)
        step = saddle_of(values @ fit.T)
        size = np.abs(step).max(axis=1)
        proven &= np.isfinite(size)
        points = np.where(proven[:, None], centre + np.minimum(np.maximum(step, -1.5), 1.5), start)
    proven &= size < SETTLED_PX
    return np.where(proven[:, None], points, start), proven


def _response(blurred: FloatImage, workspace: LiveWorkspace) -> FloatImage:
    """Return Ixy² − Ixx Iyy (h, w) in a buffer of the workspace."""
    xx, yy, xy = (workspace.floats(name, blurred.shape) for name in ("xx", "yy", "xy"))
    cv2.Sobel(blurred, cv2.CV_32F, 2, 0, dst=xx)
    cv2.Sobel(blurred, cv2.CV_32F, 0, 2, dst=yy)
    cv2.Sobel(blurred, cv2.CV_32F, 1, 1, dst=xy)
    cv2.multiply(xy, xy, dst=xy)
    cv2.multiply(xx, yy, dst=xx)
    cv2.subtract(xy, xx, dst=xy)
    return xy


def _strongest(response: FloatImage, workspace: LiveWorkspace) -> Array:
    """Return the strongest local maxima (n, 2) px of a response, away from the border."""
    highest = workspace.floats("highest", response.shape)
    cv2.dilate(response, NEAR, dst=highest)
    flat = np.flatnonzero((response >= highest) & (response > 1.0))
    strength = response.ravel()[flat]
    if flat.size > CANDIDATES:
        flat = flat[np.argpartition(-strength, CANDIDATES)[:CANDIDATES]]
    height, width = response.shape
    y, x = np.divmod(flat, width)
    inner = (x >= BORDER_PX) & (x < width - BORDER_PX) & (y >= BORDER_PX) & (y < height - BORDER_PX)
    return np.stack([x[inner], y[inner]], axis=-1).astype(np.float64)


def _has_rough_ring(blurred: FloatImage, peaks: Array) -> NDArray[np.bool_]:
    """Return which whole-pixel peaks (n, 2) have about four changes on one of the rings of whole pixels."""
    height, width = blurred.shape
    at = peaks.astype(np.int64)[:, :, None, None]
    x = np.minimum(np.maximum(at[:, 0] + ROUGH_X, 0), width - 1)
    y = np.minimum(np.maximum(at[:, 1] + ROUGH_Y, 0), height - 1)
    values = blurred.ravel()[y * width + x]
    low, high = values.min(axis=-1), values.max(axis=-1)
    above = values > (0.5 * (low + high))[..., None]
    changes = np.count_nonzero(above[..., 1:] != above[..., :-1], axis=-1) + (above[..., 0] != above[..., -1])
    good = (changes >= 4) & (changes <= 6) & (high - low > LEAST_CONTRAST)
    return np.asarray(good.any(axis=-1))
