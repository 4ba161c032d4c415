"""A board held by its lower edge: how it moves when the hand moves it. Not here: which way."""

from dataclasses import dataclass

import numpy as np

from service.core.vision.target import Target
from service.core.vision.transforms import Array, Pose, rotation_matrix, rotation_vector

NEAREST_M = 0.12  # no hand pushes the board into the camera


@dataclass(frozen=True)
class Grip:
    """Where the board's centre is (3,) m and how it is turned (3, 3), in the camera frame.

    hold: (3,) m, from the centre to where the hand holds the board, along the board's axes; turns are about
    that place, so that they shift the centre a little, as a hand's turns do.
    """

    centre: Array
    rotation: Array
    hold: Array

    def pose(self, target: Target) -> Pose:
        """Return `T_cam_board` of a target that is held so."""
        return Pose(rotation_vector(self.rotation), self.centre - self.rotation @ target.centre)

    def moved(self, way: Array) -> "Grip":
        """Return the grip after a way (6,): right, down, closer along the line of sight, m; turns, rad.

        The turns are about the camera's x, y and z axes.
        """
        sight = self.centre / np.linalg.norm(self.centre)
        shifted = self.centre + np.array([way[0], way[1], 0.0]) - way[2] * sight
        shifted[2] = max(shifted[2], NEAREST_M)
        return self.at(shifted).turned(way[3:])

    def turned(self, turn: Array) -> "Grip":
        """Return the grip after a rotation vector (3,) rad in camera axes, about where the hand holds it."""
        R = rotation_matrix(turn)
        arm = self.rotation @ self.hold
        return Grip(self.centre + arm - R @ arm, R @ self.rotation, self.hold)

    def at(self, centre: Array) -> "Grip":
        """Return the grip with its centre (3,) m elsewhere."""
        return Grip(centre, self.rotation, self.hold)


def grip_of(pose: Pose, target: Target, hold: Array) -> Grip:
    """Return the grip that holds a target at `T_cam_board`; hold: (3,) m."""
    R = pose.rotation
    return Grip(R @ target.centre + pose.tvec, R, hold)
