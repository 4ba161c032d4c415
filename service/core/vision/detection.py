"""From a captured image to the features of the declared target, whatever its kind.

A detector is one file (`detection_*.py`) and one line in `detect_target`. Not here: how it works.
"""

import numpy as np
from numpy.typing import NDArray

from service.core.errors import TargetSpecInvalid
from service.core.vision.detected import Detection, check_grey_image
from service.core.vision.detection_chessboard import detect_chessboard
from service.core.vision.detection_circles import detect_circles
from service.core.vision.detection_coded import detect_coded
from service.core.vision.target import Target
from service.core.vision.target_aprilgrid import AprilGrid
from service.core.vision.target_charuco import Charuco
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.target_circles import Circles

__all__ = ["Detection", "check_grey_image", "detect_target"]


def detect_target(image: NDArray[np.uint8], target: Target) -> Detection:
    """Return the target's features in a grey image (h, w), in the order of target.object_points.

    All of them on a plain board, those that can be seen of a coded one. Raises TargetNotVisible when there is
    no target or too little of it (facts: corners_seen, corners_needed), WrongTarget when another one is
    there, TargetOverexposed, Unprocessable when the array is no grey image.
    """
    if isinstance(target, Chessboard):
        return detect_chessboard(image, target)
    if isinstance(target, Circles):
        return detect_circles(image, target)
    if isinstance(target, Charuco | AprilGrid):
        return detect_coded(image, target)
    raise TargetSpecInvalid(f"A {target.name} cannot be detected.", spec=target.spec)
