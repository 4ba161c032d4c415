"""Chessboards drawn exactly: edges by formula and never by supersampling, which moves corners."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.special import erf

from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Array

Image = NDArray[np.uint8]


@dataclass(frozen=True)
class DrawnBoard:
    """A board in a picture by its homography (3, 3) from squares (corner 0 is (0, 0)) to px."""

    target: Chessboard
    homography: Array
    size: tuple[int, int] = (640, 480)
    sigma_px: float = 0.8
    white: float = 205.0
    dark: float = 40.0

    @property
    def corners(self) -> Array:
        """The true corners (n, 2) px, in the order of target.object_points."""
        squares = self.target.object_points[:, :2] / self.target.square_m
        points = np.column_stack([squares, np.ones(len(squares))]) @ self.homography.T
        return np.asarray(points[:, :2] / points[:, 2:])

    def light(self) -> Array:
        """The picture (h, w) in unrounded grey levels: board, white margin, grey surroundings."""
        y, x = np.mgrid[: self.size[1], : self.size[0]].astype(np.float64)
        position = np.stack([x, y, np.ones_like(x)], axis=-1) @ np.linalg.inv(self.homography).T
        u, v = position[..., 0] / position[..., 2], position[..., 1] / position[..., 2]
        pattern = 0.5 * (1.0 + _wave(u, self.sigma_px) * _wave(v, self.sigma_px))
        picture = self.white - (self.white - self.dark) * pattern
        outside = np.maximum(_beyond(u, self.target.columns), _beyond(v, self.target.rows))
        picture[outside > 0.0] = self.white
        picture[outside > 0.7] = 0.5 * (self.white + self.dark)
        return picture

    def image(self, noise_grey: float = 0.0, seed: int = 1) -> Image:
        """The picture (h, w) with noise, rounded."""
        noise = np.random.default_rng(seed).normal(0.0, 1.0, self.size[::-1]) * noise_grey
        return to_image(self.light() + noise)


def to_image(light: Array) -> Image:
    """Round grey levels as a sensor does."""
    return np.clip(np.rint(light), 0, 255).astype(np.uint8)


def draw_board(
    columns: int = 9,
    rows: int = 6,
    square_px: float = 36.0,
    roll_deg: float = 0.0,
    tilt: float = 6e-4,
    centre: tuple[float, float] = (320.0, 240.0),
    sigma_px: float = 0.8,
    white: float = 205.0,
    dark: float = 40.0,
) -> DrawnBoard:
    """Return a tilted board around the middle of a picture of 640x480 px."""
    turn = np.deg2rad(roll_deg)
    to_middle = np.array([[1, 0, -(columns - 1) / 2], [0, 1, -(rows - 1) / 2], [0, 0, 1]], dtype=np.float64)
    rotate = np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]])
    scale = np.diag([square_px, square_px, 1.0])
    perspective = np.array([[1, 0, 0], [0, 1, 0], [tilt, -0.7 * tilt, 1]])
    place = np.array([[1, 0, centre[0]], [0, 1, centre[1]], [0, 0, 1]])
    homography = place @ perspective @ scale @ rotate @ to_middle
    target = Chessboard(columns, rows, 0.025)
    return DrawnBoard(target, homography, sigma_px=sigma_px, white=white, dark=dark)


def blur(image: Image, sigma_px: float) -> Image:
    """Defocus a picture."""
    return np.asarray(cv2.GaussianBlur(image, (0, 0), sigma_px), dtype=np.uint8)


def _wave(u: Array, sigma_px: float) -> Array:
    """A square wave (h, w) that changes sign at the integers, over edges sigma_px wide in the picture."""
    slope = np.hypot(*np.gradient(u))
    line = np.rint(u)
    edge: Array = erf((u - line) / (slope * sigma_px * np.sqrt(2.0)))
    return np.where(line % 2 == 0, edge, -edge)


def _beyond(u: Array, corners: int) -> Array:
    """How far (h, w), in squares, a place is outside the squares along one axis."""
    return np.maximum(-1.0 - u, u - corners)
