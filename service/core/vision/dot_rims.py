"""Where the centres of dots are by their rims: a model of the soft rim, fitted to every grey level near it.

A rim is where the grey level changes, whatever the light does across the dot; a centroid weighs the light,
too. The rim's shape is that of the circle on the board as homography and lens map it, so that its centre is
the image of the dot's centre, and no bias is left to take off.
Not here: rough centres (`circle_centres`), which dots are the grid (`circle_grid`).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import erf

from service.core.vision.board_map import fit_board_map
from service.core.vision.map_form import BoardMap
from service.core.vision.pixel_patches import Patches, cut_patches, soft_step, solve_steps
from service.core.vision.sampling import FloatImage
from service.core.vision.target_circles import Circles
from service.core.vision.transforms import Array

ROUNDS = 2  # of the map that gives rims their shape
ITERATIONS = 8
SETTLED_PX = 1e-3
FARTHEST_PX = 1.0  # from the start
SIGMA_PX = (0.5, 8.0)
SIGMAS = 3.0  # of the blur on either side of the rim that are looked at, and a pixel more
GAP_SHARE = 0.45  # of the way to the next dot's rim
SOFT_PX = 1.0
POINT, GROWTH, SIGMA, DARK, BRIGHT = slice(0, 2), 2, 3, 4, slice(5, 8)


def refine_by_rims(
    image: FloatImage, start: Array, target: Circles, sigma_px: float, middle: Array
) -> tuple[Array, NDArray[np.bool_]]:
    """Return the images (n, 2) px of dots' centres near starts (n, 2), and which of them (n,) are proven.

    image: (h, w), evenly lit as far as it is known, rims of a sigma of at least 0.6 px. sigma_px: of the
    rims' blur, about. middle: (2,) px, of the whole picture, of which the image may be a part. A centre is
    proven where the fit has settled within a pixel of its start; the others come back as they were given.
    """
    points, proven = start, np.ones(len(start), dtype=bool)
    for _ in range(ROUNDS):
        rims = _rims(fit_board_map(target.object_points[:, :2], points, middle), target)
        reach = float(rims.radius_px.max()) + SIGMAS * sigma_px + 1.0
        points, proven = _fit(cut_patches(image, start, reach), rims, start, sigma_px)
    return points, proven


@dataclass(frozen=True)
class _Rims:
    """The rims of n dots about their centres' images: A e + Q(e, e) px for directions e of length one.

    A: (n, 2, 2); its inverse; Q: (n, 3, 2) for e_x², e_y² and e_x e_y. gap: between dots, in dot radii.
    """

    A: Array
    inverse: Array
    Q: Array
    gap: float

    @property
    def radius_px(self) -> Array:
        """The longer half axis (n,)."""
        return np.asarray(np.linalg.norm(self.A, ord=2, axis=(1, 2)))


@dataclass(frozen=True)
class _Near:
    """Pixels near a rim: distances outwards (n, k) px, the rim's normals x, y, and weights."""

    distance: Array
    normal_x: Array
    normal_y: Array
    weights: Array


def _rims(board_map: BoardMap, target: Circles) -> _Rims:
    """Return the rims of a target's dots under a mapping."""
    radius, centres = 0.5 * target.diameter_m, target.object_points[:, :2]
    ways = radius * np.array([[1.0, 0.0], [0.0, 1.0], [np.sqrt(0.5), np.sqrt(0.5)]])
    middle = board_map.image_of(centres)[:, None]
    ahead, behind = (board_map.image_of(centres[:, None] + sign * ways) - middle for sign in (1.0, -1.0))
    A = np.swapaxes(0.5 * (ahead - behind)[:, :2], 1, 2)
    even = 0.5 * (ahead + behind)
    Q = np.stack([even[:, 0], even[:, 1], 2.0 * even[:, 2] - even[:, 0] - even[:, 1]], axis=1)
    gap = (np.sqrt(2.0) * target.step_m - target.diameter_m) / radius
    return _Rims(A, np.asarray(np.linalg.inv(A), dtype=np.float64), Q, float(gap))


def _fit(patches: Patches, rims: _Rims, start: Array, sigma_px: float) -> tuple[Array, NDArray[np.bool_]]:
    """Return the centres (n, 2) px whose rims fit best, and which are proven."""
    state = _first_state(patches, rims, start, sigma_px)
    settled = np.zeros(len(start), dtype=bool)
    for _ in range(ITERATIONS):
        step = _step(patches, rims, state, sigma_px)
        state = state + step
        state[:, SIGMA] = np.clip(state[:, SIGMA], *SIGMA_PX)
        settled = np.abs(step[:, POINT]).max(axis=1) < SETTLED_PX
        if settled.all():
            break
    proven = settled & (np.abs(state[:, POINT] - start).max(axis=1) < FARTHEST_PX)
    return np.where(proven[:, None], state[:, POINT], start), proven


def _first_state(patches: Patches, rims: _Rims, start: Array, sigma_px: float) -> Array:
    """Return the first x, y, growth, sigma, dark level, bright level and its slopes (n, 8)."""
    near = _near(patches, rims, start, sigma_px)
    dark, bright = (
        np.sum(near.weights * side * patches.levels, axis=1)
        / np.maximum(np.sum(near.weights * side, axis=1), 1e-9)
        for side in (near.distance < -sigma_px, near.distance > sigma_px)
    )
    nothing = np.zeros(len(start))
    return np.column_stack([start, nothing, np.full(len(start), sigma_px), dark, bright, nothing, nothing])


def _near(patches: Patches, rims: _Rims, points: Array, sigma_px: float) -> _Near:
    """Return the pixels near the rims of dots at points (n, 2) px."""
    ux, uy = patches.ways_from(points)
    e = np.einsum("nij,njk->nik", rims.inverse, np.stack([ux, uy], axis=1))
    rho = np.maximum(np.sqrt(e[:, 0] ** 2 + e[:, 1] ** 2), 1e-9)
    e /= rho[:, None]
    slope = np.einsum("nji,njk->nik", rims.inverse, e)
    steep = np.sqrt(slope[:, 0] ** 2 + slope[:, 1] ** 2)
    nx, ny = slope[:, 0] / steep, slope[:, 1] / steep
    squares = np.stack([e[:, 0] ** 2, e[:, 1] ** 2, e[:, 0] * e[:, 1]], axis=1)
    bent = np.einsum("nsi,nsk->nik", rims.Q, squares)
    distance = (rho - 1.0) / steep - nx * bent[:, 0] - ny * bent[:, 1]
    reach = np.minimum(SIGMAS * sigma_px + 1.0, GAP_SHARE * rims.gap / steep)
    return _Near(distance, nx, ny, patches.inside * soft_step(reach - np.abs(distance), SOFT_PX))


def _step(patches: Patches, rims: _Rims, state: Array, sigma_px: float) -> Array:
    """Return Gauss and Newton's steps (n, 8)."""
    near = _near(patches, rims, state[:, POINT], sigma_px)
    ux, uy = patches.ways_from(state[:, POINT])
    sigma, places = state[:, SIGMA, None], np.stack([np.ones_like(ux), ux, uy], axis=1)
    dark, bright = state[:, DARK, None], np.einsum("np,npk->nk", state[:, BRIGHT], places)
    distance = near.distance - state[:, GROWTH, None]
    outside = 0.5 * (1.0 + erf(distance / (np.sqrt(2.0) * sigma)))
    height = bright - dark
    rate = height * np.exp(-0.5 * (distance / sigma) ** 2) / (np.sqrt(2.0 * np.pi) * sigma)
    by_rim = np.stack([-near.normal_x, -near.normal_y, -np.ones_like(rate), -distance / sigma], axis=1)
    inside = (1.0 - outside)[:, None]
    J = np.concatenate([rate[:, None] * by_rim, inside, outside[:, None] * places], axis=1)
    return solve_steps(J, near.weights, patches.levels - dark - height * outside)
