"""Live frames as the session needs them: from a browser's bytes, seen for a target, and as JPEG or PNG.

Not here: where frames come from, and what guidance makes of them.
"""

from collections import OrderedDict
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.errors import BadRequest, PoseUndetermined, WrongImageSize
from service.core.guidance.observation import Observation
from service.core.guidance.problems import FrameMoved
from service.core.guidance.session_state import GuidanceSettings
from service.core.vision.camera import Intrinsics, project
from service.core.vision.live_corners import LiveWorkspace
from service.core.vision.live_detection import LiveDetection, detect_live
from service.core.vision.pose import estimate_pose
from service.core.vision.transforms import Array, Pose
from service.ports import LiveFrame

Pixels = NDArray[np.uint8]
JPEG_QUALITY = 80
FRAMES_KEPT = 60  # frames whose corners are remembered, about four seconds
MOVED_SHARE = 8 / 1280  # of the image width: how far corners may lie from those that were judged


@dataclass(frozen=True)
class RawFrame:
    """A frame that came as grey bytes."""

    sequence: int
    image: Pixels
    scale: int
    at_s: float


class Eye:
    """Looks at the frames of one run and remembers where the corners were."""

    def __init__(self, settings: GuidanceSettings) -> None:
        self._settings = settings
        self._workspace = LiveWorkspace()
        self._judged: OrderedDict[int, Array] = OrderedDict()

    def observe(self, frame: LiveFrame) -> Observation:
        """Return what a frame shows; raises WrongImageSize."""
        settings = self._settings
        check_size(frame, settings.intrinsics.image_size)
        seen = self._detect(frame.image, frame.scale)
        pose, camera, image_points = None, None, seen.image_points
        if image_points is not None:
            self._judged[frame.sequence] = image_points
            while len(self._judged) > FRAMES_KEPT:
                self._judged.popitem(last=False)
            pose, camera = self._pose(image_points)
            image_points = self._whole(image_points, pose, camera)
        # A part of a board that no pose explains says nothing of where the rest is.
        is_board = seen.kind != "present" or image_points is not None
        return Observation(
            at_s=frame.at_s,
            kind=seen.kind if is_board else "partial",
            corners_seen=seen.corners_seen,
            pose=pose,
            camera=camera,
            image_points=image_points,
            edge_width_px=seen.edge_width_px,
            brightness=seen.brightness,
            sequence=frame.sequence,
            glare_share=seen.glare_share,
        )

    def _pose(self, image_points: Array) -> tuple[Pose | None, Intrinsics | None]:
        """Return the pose by the corners (n, 2) that are not NaN, None where none explains them.

        And the camera that it is of, where the nominal one is wrong.
        """
        is_seen = ~np.isnan(image_points[:, 0])
        points = self._settings.target.object_points[is_seen]
        try:
            found = estimate_pose(self._settings.intrinsics, points, image_points[is_seen])
        except PoseUndetermined:
            return None, None
        return found.freed or (found.pose, None)

    def _whole(self, image_points: Array, pose: Pose | None, camera: Intrinsics | None) -> Array | None:
        """Return corners (n, 2) with those that are NaN where the pose puts them; None if it does not."""
        if not np.isnan(image_points).any():
            return image_points
        if pose is None:
            return None
        target, camera = self._settings.target, camera or self._settings.intrinsics
        told = project(camera, pose.rotation, pose.tvec, target.object_points)
        whole = np.where(np.isnan(image_points), told, image_points)
        return None if np.isnan(whole).any() else whole

    def check_same(self, sequence: int, full: Pixels) -> None:
        """Return if a full picture shows the board where the judged frame did.

        Raises WrongImageSize, FrameMoved.
        """
        check_size(RawFrame(sequence, full, 1, 0.0), self._settings.intrinsics.image_size)
        judged = self._judged.get(sequence)
        seen = self._detect(full, 1).image_points
        width = self._settings.intrinsics.image_size[0]
        if judged is not None and seen is not None:
            orders = (seen, seen[::-1]) if self._settings.target.is_symmetric else (seen,)
            if any(_mean_way(order, judged) <= MOVED_SHARE * width for order in orders):
                return
        raise FrameMoved(
            "The full picture does not show the board where the live picture did. Hold it still until the "
            "next pose is shown.",
            sequence=sequence,
        )

    def _detect(self, image: Pixels, scale: int) -> LiveDetection:
        return detect_live(image, self._settings.target, self._workspace, scale=scale)


def _mean_way(points: Array, others: Array) -> float:
    """Return the mean distance, px, of points (n, 2) that are not NaN in either; inf without any."""
    ways = np.linalg.norm(points - others, axis=1)
    both = ~np.isnan(ways)
    return float(ways[both].mean()) if both.any() else float("inf")


def check_size(frame: LiveFrame, image_size: tuple[int, int]) -> None:
    """Raise WrongImageSize unless a frame is one of the camera's, at full or half size."""
    height, width = frame.image.shape
    expected = (image_size[0] // frame.scale, image_size[1] // frame.scale)
    if (width, height) != expected:
        raise WrongImageSize(
            f"The camera sends {width * frame.scale}x{height * frame.scale} px; this SKU's camera has "
            f"{image_size[0]}x{image_size[1]} px. Check which camera is connected and that it sends its "
            "full image.",
            found=[width * frame.scale, height * frame.scale],
            expected=list(image_size),
        )


def read_raw(content: bytes, size: tuple[int, int], *, sequence: int, scale: int, at_s: float) -> RawFrame:
    """Return the frame of its grey bytes, row by row; raises BadRequest unless there are width x height."""
    width, height = size
    if len(content) != width * height:
        raise BadRequest(
            f"A frame of {width}x{height} px has {width * height} bytes; {len(content)} came.",
            bytes=len(content),
        )
    image = np.frombuffer(content, dtype=np.uint8).reshape(height, width)
    return RawFrame(sequence, image, scale, at_s)


def to_png(image: Pixels) -> bytes:
    """Return grey pixels (h, w) as a lossless file."""
    encoded: bytes = cv2.imencode(".png", image, [cv2.IMWRITE_PNG_COMPRESSION, 1])[1].tobytes()
    return encoded


def to_jpeg(image: Pixels) -> bytes:
    """Return grey pixels (h, w) as a picture to look at, never to measure on."""
    encoded: bytes = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])[1].tobytes()
    return encoded
