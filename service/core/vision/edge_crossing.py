"""Corners where two edges cross: a model of the blurred crossing, fitted to every grey level around it.

Near a corner the picture is the product of two soft edges. Fitting them uses both edges for many pixels,
where a surface through the grey levels next to the corner (`saddle`) uses two or three. How a lens bends the
edges, and how light changes around each corner, all corners together tell (`board_map`, `light_slopes`). What
the model leaves out, such as ink that has spread or a pixel's own shape, looks the same turned by 180 degrees
and does not move the crossing.
Not here: which corners there are (`grid_growth`).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import erf

from service.core.vision.board_map import fit_board_map, misfit_px
from service.core.vision.light_slopes import light_slopes
from service.core.vision.map_form import BoardMap
from service.core.vision.pixel_patches import Patches, cut_patches, soft_step, solve_steps
from service.core.vision.sampling import FloatImage
from service.core.vision.transforms import Array

EDGE_WIDTHS_OF_SIGMA = 2.563  # 10–90 % width of a Gaussian edge
BEND_STEP = 0.2  # of a square, over which a bend is taken
LARGEST_MISFIT_PX = 1.0  # rms; plates that are not flat and real lenses stay below it
CROSSING_PX = 12.0  # radius of discs beyond which more of the edges tells little more
LEAST_RADIUS_PX = 3.0  # with fewer pixels seven unknowns would follow the noise
ITERATIONS = 8
SETTLED_PX = 1e-3
FARTHEST_PX = 0.5  # from the start
LARGEST_TURN_RAD = 0.2  # in one step
SIGMA_PX = (0.5, 10.0)  # a narrower edge is not seen by pixels
SOFT_PX = 1.5  # over which the border of the disc fades
POINT, ANGLES, SIGMA, LEVELS = slice(0, 2), slice(2, 4), 4, slice(5, 7)


@dataclass(frozen=True)
class Edges:
    """The two edges through each of n corners.

    angles: (n, 2) rad, from x to y. bends: (n, 2) 1/px, towards the normal (-sin, cos) of the angle.
    """

    angles: Array
    bends: Array


def edges_on_board(board: Array, points: Array, square_m: float, middle: Array) -> Edges:
    """Return the edges along the board's x and y through corners at board (n, 2) m, seen at points (n, 2) px.

    square_m: the side of a square; middle: (2,) px, of the image. Bends are those of the board's map: taken
    from single corners' places they would have their noise, and no neighbours on one side at a board's
    border, which is a thousandth of a pixel, but all one way. Straight where no map fits.
    """
    board_map = fit_board_map(board, points, middle)
    both = [_along(board_map, board, way) for way in BEND_STEP * square_m * np.eye(2)]
    angles, bends = (np.stack([pair[i] for pair in both], axis=-1) for i in (0, 1))
    fits = misfit_px(board_map, board, points) < LARGEST_MISFIT_PX
    return Edges(angles, bends if fits else np.zeros_like(bends))


def refine_crossings(
    image: FloatImage, start: Array, edges: Edges, radii: Array, sigma_px: float
) -> tuple[Array, NDArray[np.bool_]]:
    """Return where edges cross (n, 2) px near starts (n, 2), and which crossings (n,) are proven.

    image: (h, w), evenly lit, edges of a sigma of at least 0.6 px. radii: (n,) px of the discs that are
    looked at: nothing but the crossing may be in them. sigma_px: of the edges' blur, about.
    A crossing is proven where the fit has settled within half a pixel of its start; the others come back as
    they were given.
    """
    patches = cut_patches(image, start, float(radii.max(initial=0.0)) + 0.5 * SOFT_PX)
    state = _first_state(patches, radii, edges, start, sigma_px)
    state, _ = _fit(patches, radii, edges, state, np.zeros((len(start), 2, 2)))
    state, settled = _fit(patches, radii, edges, state, _light(state))
    proven = (
        settled & (radii >= LEAST_RADIUS_PX) & (np.abs(state[:, POINT] - start).max(axis=1) < FARTHEST_PX)
    )
    return np.where(proven[:, None], state[:, POINT], start), proven


@dataclass(frozen=True)
class _Edge:
    """An edge at n times k pixels: levels from -1 to 1, slopes, 1/px, distances in sigmas, px along it."""

    levels: Array
    slopes: Array
    sigmas: Array
    along: Array
    sine: Array
    cosine: Array


def _along(board_map: BoardMap, board: Array, way: Array) -> tuple[Array, Array]:
    """Return angles and bends (n,) of lines through board points (n, 2) m in a direction (2,) m."""
    before, here, after = (board_map.image_of(board + sign * way) for sign in (-1.0, 0.0, 1.0))
    x, y = (0.5 * (after - before)).T
    bent_x, bent_y = (after - 2.0 * here + before).T
    return np.arctan2(y, x), (x * bent_y - y * bent_x) / np.maximum(x * x + y * y, 1e-12) ** 1.5


def _first_state(patches: Patches, radii: Array, edges: Edges, start: Array, sigma_px: float) -> Array:
    """Return the first x, y, two angles, sigma, mean and height (n, 7), the last two by least squares."""
    n = len(start)
    state = np.concatenate([start, edges.angles, np.full((n, 1), sigma_px), np.zeros((n, 2))], axis=1)
    ux, uy = patches.ways_from(start)
    w = _weights(patches, radii, ux, uy)
    first, second = _edges(state, edges, ux, uy)
    shape = first.levels * second.levels
    total = w.sum(axis=1)
    mean_shape, mean_level = (np.sum(w * part, axis=1) / total for part in (shape, patches.levels))
    about = shape - mean_shape[:, None]
    height = np.sum(w * about * patches.levels, axis=1) / np.sum(w * about * about, axis=1)
    state[:, LEVELS] = np.stack([mean_level - height * mean_shape, height], axis=-1)
    return state


def _weights(patches: Patches, radii: Array, ux: Array, uy: Array) -> Array:
    """Return the weights (n, k) of pixels at ways (n, k) px from the corners: discs of radii (n,) px."""
    return patches.inside * soft_step(radii[:, None] - np.sqrt(ux * ux + uy * uy), SOFT_PX)


def _edges(state: Array, edges: Edges, ux: Array, uy: Array) -> tuple[_Edge, _Edge]:
    """Return both edges at ways (n, k) px from the corner."""
    first, second = (_edge(state[:, 2 + i], edges.bends[:, i], state[:, SIGMA], ux, uy) for i in (0, 1))
    return first, second


def _edge(angle: Array, bend: Array, sigma: Array, ux: Array, uy: Array) -> _Edge:
    sine, cosine = np.sin(angle)[:, None], np.cos(angle)[:, None]
    along = cosine * ux + sine * uy
    sigmas = (cosine * uy - sine * ux - 0.5 * bend[:, None] * along * along) / sigma[:, None]
    slopes = np.sqrt(2.0 / np.pi) / sigma[:, None] * np.exp(-0.5 * sigmas * sigmas)
    return _Edge(erf(sigmas / np.sqrt(2.0)), slopes, sigmas, along, sine, cosine)


def _light(state: Array) -> Array:
    """Return the slopes (n, 2, 2) of each corner's mean and height, by the heights of all."""
    mean, height = state[:, LEVELS].T
    signs = np.where(height < 0, -1.0, 1.0)
    slopes = light_slopes(state[:, POINT], np.stack([mean, np.abs(height)], axis=1), signs)
    return np.asarray(slopes * np.stack([np.ones_like(signs), signs], axis=1)[:, None])


def _fit(
    patches: Patches, radii: Array, edges: Edges, state: Array, light: Array
) -> tuple[Array, NDArray[np.bool_]]:
    """Return the state that fits best, and which corners (n,) have settled."""
    settled = np.zeros(len(state), dtype=bool)
    for _ in range(ITERATIONS):
        step = _step(patches, radii, edges, state, light)
        state = _moved(state, step)
        settled = np.abs(step[:, POINT]).max(axis=1) < SETTLED_PX
        if settled.all():
            break
    return state, settled


def _step(patches: Patches, radii: Array, edges: Edges, state: Array, light: Array) -> Array:
    """Return Gauss and Newton's steps (n, 7). light: slopes (n, 2, 2) of mean and height along x and y."""
    ux, uy = patches.ways_from(state[:, POINT])
    one, two = _edges(state, edges, ux, uy)
    height = state[:, 6:7]
    by_one, by_two = height * one.slopes * two.levels, height * two.slopes * one.levels
    shape = one.levels * two.levels
    J = np.empty((len(state), 7, ux.shape[1]))
    J[:, 0] = by_one * one.sine + by_two * two.sine
    J[:, 1] = -by_one * one.cosine - by_two * two.cosine
    J[:, 2], J[:, 3] = -by_one * one.along, -by_two * two.along
    J[:, SIGMA] = -(by_one * one.sigmas + by_two * two.sigmas)
    J[:, 5], J[:, 6] = 1.0, shape
    mean_slope, height_slope = (light[:, :1, i] * ux + light[:, 1:, i] * uy for i in (0, 1))
    error = patches.levels - state[:, 5:6] - mean_slope - (height + height_slope) * shape
    return solve_steps(J, _weights(patches, radii, ux, uy), error)


def _moved(state: Array, step: Array) -> Array:
    """Return the state after a step that is not too long."""
    bounded = step.copy()
    bounded[:, POINT] = np.clip(step[:, POINT], -FARTHEST_PX, FARTHEST_PX)
    bounded[:, ANGLES] = np.clip(step[:, ANGLES], -LARGEST_TURN_RAD, LARGEST_TURN_RAD)
    moved = state + bounded
    moved[:, SIGMA] = np.clip(moved[:, SIGMA], *SIGMA_PX)
    return moved
