"""The pixels of an element, as the browser paints them."""

import cv2
import numpy as np
from numpy.typing import NDArray
from playwright.sync_api import Locator


def pixels_of(element: Locator) -> NDArray[np.uint8]:
    """Return an element's screenshot, (h, w, 3), red green blue."""
    png = np.frombuffer(element.screenshot(), dtype=np.uint8)
    decoded = cv2.imdecode(png, cv2.IMREAD_COLOR)
    assert decoded is not None
    return np.asarray(decoded[:, :, ::-1], dtype=np.uint8)
