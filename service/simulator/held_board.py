"""A virtual board that a person moves from a screen: no hand of its own, no tremor, nothing but the moves.

Not here: how moves come in, and the hand that follows hints (`operator`).
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from service.core.guidance.hints import ShownHint
from service.core.vision.camera import Intrinsics, project_camera_points
from service.core.vision.target import Target
from service.core.vision.transforms import Array, Pose
from service.ports import BoardMove
from service.simulator.grip import Grip, grip_of

HOME_M = (0.0, 0.0, 0.6)
NEAREST_M, FARTHEST_M = 0.15, 3.0
# A board at a greater angle to the line of sight shows nothing that could be found.
LARGEST_INCIDENCE_RAD = float(np.deg2rad(80.0))
AT_CENTRE = np.zeros(3)


@dataclass(frozen=True)
class Reach:
    """Where a person may take the board: its centre in the picture, its face towards the camera."""

    camera: Intrinsics

    def limited(self, before: Grip, after: Grip) -> Grip:
        """Return a move as far as it is allowed: a shift and a turn each happen or do not."""
        centre = after.centre if self._is_in_picture(after.centre) else before.centre
        rotation = after.rotation if self._faces_camera(after.rotation, centre) else before.rotation
        return Grip(centre, rotation, after.hold)

    def _is_in_picture(self, centre: Array) -> bool:
        if not NEAREST_M <= centre[2] <= FARTHEST_M:
            return False
        place = project_camera_points(self.camera, centre[None])[0]
        return bool(np.all((place >= 0) & (place <= np.array(self.camera.image_size) - 1.0)))

    def _faces_camera(self, rotation: Array, centre: Array) -> bool:
        cosine = rotation[:, 2] @ centre / np.linalg.norm(centre)
        return bool(cosine >= np.cos(LARGEST_INCIDENCE_RAD))


class HeldBoard:
    """A board that is where the moves have brought it; upright before the camera at first."""

    def __init__(self, camera: Intrinsics, target: Target, take_move: Callable[[], BoardMove | None]) -> None:
        """Take the camera, for what a px of a drag is, and what returns the moves since it was last asked."""
        self._camera, self._target, self._take_move = camera, target, take_move
        self._reach = Reach(camera)
        start = Pose(np.zeros(3), np.array(HOME_M) - target.centre)
        self._grip = grip_of(start, target, AT_CENTRE)

    def step(self, hints: tuple[ShownHint, ...], dt_s: float, rng: np.random.Generator) -> Pose:
        """Return the pose `T_cam_board` after the moves that came since the last step."""
        move = self._take_move()
        if move is not None:
            self._grip = self._reach.limited(self._grip, self._moved(move))
        return self._grip.pose(self._target)

    def _moved(self, move: BoardMove) -> Grip:
        """Return the grip after a move: the centre goes with the pointer, whatever its distance."""
        centre = self._grip.centre / (1.0 + move.closer_share)
        focal = np.diag(self._camera.camera_matrix)[:2]
        shift = np.array([move.right_px, move.down_px]) * centre[2] / focal
        turn = np.array([move.tilt_rad, move.turn_rad, move.roll_rad])
        return self._grip.at(centre + np.append(shift, 0.0)).turned(turn)
