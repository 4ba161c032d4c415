"""From a frame to what an operator's page gets: detection, pose, comparison, hints and the session's step."""

from collections.abc import Callable, Sequence
from contextlib import suppress

import numpy as np
from numpy.typing import NDArray

from service.core.errors import PoseUndetermined
from service.core.guidance.actions import Frame
from service.core.guidance.comparison import default_tolerances
from service.core.guidance.observation import Observation
from service.core.guidance.session import step
from service.core.guidance.session_poses import start_session
from service.core.guidance.session_state import GuidanceSettings
from service.core.guidance.session_view import view
from service.core.vision.camera import Intrinsics
from service.core.vision.live_detection import LiveDetection, LiveWorkspace, detect_live
from service.core.vision.pose import estimate_pose
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Pose

FRAME_S = 0.05

Image = NDArray[np.uint8]
Look = Callable[[Image], LiveDetection]


def guide(camera: Intrinsics, target: Chessboard, poses: Sequence[Pose]) -> Look:
    """Return what makes the next state of a session from a frame, 20 frames a second."""
    settings = GuidanceSettings(camera, target, default_tolerances(camera.image_size))
    workspace = LiveWorkspace()
    state = start_session(list(poses))
    at_s = 0.0

    def see(image: Image) -> LiveDetection:
        nonlocal state, at_s
        at_s += FRAME_S
        found = detect_live(image, target, workspace)
        state, _ = step(state, Frame(_observe(found, camera, target, at_s)), settings)
        view(state, settings)
        return found

    return see


def _observe(found: LiveDetection, camera: Intrinsics, target: Chessboard, at_s: float) -> Observation:
    pose, by = None, None
    if found.image_points is not None:
        with suppress(PoseUndetermined):
            estimate = estimate_pose(camera, target.object_points, found.image_points)
            pose, by = estimate.freed or (estimate.pose, None)
    return Observation(
        at_s,
        found.kind,
        found.corners_seen,
        pose,
        found.image_points,
        found.edge_width_px,
        found.brightness,
        camera=by,
    )
