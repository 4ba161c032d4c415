"""What was found in a captured image, and what an image must be to be looked at.

Not here: how a kind of target is found (`detection_*.py`).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.errors import Unprocessable
from service.core.vision.sharpness import Sharpness
from service.core.vision.transforms import Array

SMALLEST_IMAGE_PX = 32


@dataclass(frozen=True)
class Detection:
    """A target found in an image.

    image_points: (n, 2) px. corner_ids: (n,) indices into target.object_points. image_size: (width, height)
    px. parity_separation and contrast: see `Parity`. saturated_share: of the bright squares; NaN where it was
    not measured, as in captures of before.
    """

    image_points: Array
    corner_ids: NDArray[np.int64]
    image_size: tuple[int, int]
    sharpness: Sharpness
    parity_separation: float
    contrast: float
    saturated_share: float = float("nan")


def check_grey_image(image: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return the image if it is grey (h, w), 8 bit and at least 32x32 px; raises Unprocessable otherwise."""
    if image.ndim != 2 or image.dtype != np.uint8:
        raise Unprocessable(
            f"Give a grey image of 8 bits; this array has {image.ndim} dimensions of {image.dtype}."
        )
    if min(image.shape) < SMALLEST_IMAGE_PX:
        height, width = image.shape
        raise Unprocessable(f"An image must be at least 32x32 px; this one is {width}x{height}.")
    return np.ascontiguousarray(image)
