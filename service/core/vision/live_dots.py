"""Dark dots of a live frame, in a bounded time: what lies below the middle of the light and dark around it.

One threshold for each place, from the brightest and darkest pixels near it, so that light may fall and the
room behind the plate be as bright or dark as it likes. Not here: which dots are a grid (`dot_lattice`).
"""

from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.vision.transforms import Array

COARSE: Final = 4  # pixels of a frame across one of the levels
LARGEST_PX: Final = 64  # across a dot, and all that is filled in to tell the light around it
LEAST_DEPTH: Final = 10.0  # grey levels between a dot and what is around it
LEAST_AREA_PX: Final = 5
LEAST_FILLED: Final = 0.3  # of the upright rectangle around it: an ellipse of a slanting dot
MOST_FILLED: Final = 0.9  # of one that has room for corners: more is a square
ROOM_PX: Final = 14
LONGEST: Final = 4.0  # times as wide as high, or high as wide
MOST_DOTS: Final = 500


def find_live_dots(image: NDArray[np.uint8]) -> tuple[Array, Array]:
    """Return centroids (n, 2) px and areas (n,) of what may be dots in a frame (h, w), of 500 at most."""
    bright, dark = _levels_around(image)
    size = (image.shape[1], image.shape[0])
    middle = np.minimum(0.5 * (bright + dark), bright - LEAST_DEPTH)
    threshold = cv2.resize(middle, size, interpolation=cv2.INTER_LINEAR)
    mask = cv2.compare(image.astype(np.float32), threshold, cv2.CMP_LT)
    # Twice as quick as the one that is taken by itself.
    _, _, stats, centroids = cv2.connectedComponentsWithStatsWithAlgorithm(mask, 8, cv2.CV_32S, cv2.CCL_BBDT)
    fits = _look_like_dots(np.asarray(stats), size)
    points, areas = np.asarray(centroids[fits], dtype=np.float64), stats[fits, cv2.CC_STAT_AREA]
    if len(points) > MOST_DOTS:
        x, y = np.rint(points).astype(np.int64).T
        last = np.array(bright.shape) - 1
        around = bright[np.minimum(y // COARSE, last[0]), np.minimum(x // COARSE, last[1])]
        deepest = np.argpartition(image[y, x] - around, MOST_DOTS)[:MOST_DOTS]
        points, areas = points[deepest], areas[deepest]
    return points, np.asarray(areas, dtype=np.float64)


def _levels_around(image: NDArray[np.uint8]) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Return the levels around dots, and the darkest ones near, each of COARSE x COARSE pixels."""
    cell = np.ones((COARSE, COARSE), np.uint8)
    brightest = cv2.dilate(image, cell)[COARSE // 2 :: COARSE, COARSE // 2 :: COARSE]
    darkest = cv2.erode(image, cell)[COARSE // 2 :: COARSE, COARSE // 2 :: COARSE]
    reach = LARGEST_PX // COARSE + 1
    around = cv2.morphologyEx(brightest, cv2.MORPH_CLOSE, np.ones((reach, reach), np.uint8))
    near = cv2.erode(darkest, np.ones((3, 3), np.uint8))
    return around.astype(np.float32), near.astype(np.float32)


def _look_like_dots(stats: NDArray[np.int_], size: tuple[int, int]) -> NDArray[np.bool_]:
    """Return which components (n, 5) are large and round enough, and whole in a frame (width, height).

    The first is the background.
    """
    left, top = stats[:, cv2.CC_STAT_LEFT], stats[:, cv2.CC_STAT_TOP]
    width, height, area = (stats[:, k] for k in (cv2.CC_STAT_WIDTH, cv2.CC_STAT_HEIGHT, cv2.CC_STAT_AREA))
    short, long = np.minimum(width, height), np.maximum(width, height)
    filled = area / (width * height)
    round_enough = (filled >= LEAST_FILLED) & ((short < ROOM_PX) | (filled <= MOST_FILLED))
    sized = (area >= LEAST_AREA_PX) & (long <= LARGEST_PX) & (long <= LONGEST * short)
    whole = (left > 0) & (top > 0) & (left + width < size[0]) & (top + height < size[1])
    fits: NDArray[np.bool_] = round_enough & sized & whole
    fits[0] = False
    return fits
