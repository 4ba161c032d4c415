"""Square markers of known dictionaries: their names and their cells.

Not here: where a target has them (`target_*.py`), how they are found in an image (`marker_detection`).
"""

from collections.abc import Mapping
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

DICTIONARIES: Mapping[str, int] = {
    **{
        f"{bits}x{bits}_{count}": getattr(cv2.aruco, f"DICT_{bits}X{bits}_{count}")
        for bits in (4, 5, 6, 7)
        for count in (50, 100, 250, 1000)
    },
    "tag16h5": cv2.aruco.DICT_APRILTAG_16h5,
    "tag25h9": cv2.aruco.DICT_APRILTAG_25h9,
    "tag36h10": cv2.aruco.DICT_APRILTAG_36h10,
    "tag36h11": cv2.aruco.DICT_APRILTAG_36h11,
}


@lru_cache(maxsize=16)
def marker_dictionary(name: str) -> cv2.aruco.Dictionary:
    """Return a dictionary of `DICTIONARIES` by name."""
    return cv2.aruco.getPredefinedDictionary(DICTIONARIES[name])


@lru_cache(maxsize=4096)
def dark_cells(name: str, marker: int, border: int) -> NDArray[np.bool_]:
    """Return which cells of a marker are dark (n, n), seen upright, with a dark border of so many cells."""
    dictionary = marker_dictionary(name)
    side = dictionary.markerSize + 2
    bits = dictionary.generateImageMarker(marker, side, borderBits=1)[1:-1, 1:-1]
    return np.asarray(np.pad(bits == 0, border, constant_values=True), dtype=np.bool_)
