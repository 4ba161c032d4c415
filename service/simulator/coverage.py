"""Exact areas of a pixel that edges cut, for patterns which are products of step functions in two directions.

A pixel is the unit square around its centre; an edge is a straight line through it. Everything is closed form
and vectorised over pixels: a grid of samples would quantise edges and move corners. Not here: the pattern.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.transforms import Array


@dataclass(frozen=True)
class Steps:
    """A function of one coordinate that jumps at edges (k,), ascending, between values (k + 1,)."""

    edges: Array
    values: Array

    def around(self, x: Array) -> tuple[Array, Array, Array]:
        """Return the distance (n,) of x (n,) beyond its nearest edge, and the values below and above that."""
        nearest = np.searchsorted(0.5 * (self.edges[1:] + self.edges[:-1]), x)
        return x - self.edges[nearest], self.values[nearest], self.values[nearest + 1]


def integrate_product(f: Steps, g: Steps, uv: Array, jacobian: Array) -> Array:
    """Return the mean (n,) of f(u) g(v) over pixels.

    uv: (n, 2) at the centre; jacobian: (n, 2, 2) d(u, v)/d(pixel).
    Exact as long as u and v are affine over a pixel and no pixel meets two edges of the same function.
    """
    du, f_below, f_above = f.around(uv[:, 0])
    dv, g_below, g_above = g.around(uv[:, 1])
    share_u, share_v = half_plane_area(du, jacobian[:, 0]), half_plane_area(dv, jacobian[:, 1])
    both = share_u * share_v
    crossed = _is_cut(share_u) & _is_cut(share_v) & (f_below != f_above) & (g_below != g_above)
    both[crossed] = quarter_plane_area(np.stack([du[crossed], dv[crossed]], axis=1), jacobian[crossed])
    f_jump, g_jump = f_above - f_below, g_above - g_below
    mean: Array = (
        f_below * g_below + f_jump * g_below * share_u + f_below * g_jump * share_v + f_jump * g_jump * both
    )
    return mean


def box_steps(low: float, high: float) -> Steps:
    """Return the function that is 1 between two edges and 0 elsewhere."""
    return Steps(np.array([low, high]), np.array([0.0, 1.0, 0.0]))


def corner_share(beyond: Array, jacobian: Array) -> tuple[Array, Array, Array]:
    """Return the shares (n,) of pixels beyond an edge of u, beyond one of v, and beyond both.

    beyond: (n, 2) how far the pixel's centre is beyond each; jacobian: (n, 2, 2) d(u, v)/d(pixel).
    """
    share_u = half_plane_area(beyond[:, 0], jacobian[:, 0])
    share_v = half_plane_area(beyond[:, 1], jacobian[:, 1])
    both = share_u * share_v
    crossed = _is_cut(share_u) & _is_cut(share_v)
    both[crossed] = quarter_plane_area(beyond[crossed], jacobian[crossed])
    return share_u, share_v, both


def half_plane_area(offset: Array, gradient: Array) -> Array:
    """Return the area (n,) of the unit pixel where offset (n,) + gradient (n, 2) · x > 0.

    The box filter of a ramp in two directions: a second difference of t²/2.
    """
    a, b = np.abs(gradient[:, 0]), np.abs(gradient[:, 1])
    # An edge along a pixel's side is the limit of slightly turned ones; this turns it by a millionth.
    floor = 1e-6 * np.maximum(a, b) + 1e-300
    a, b = np.maximum(a, floor), np.maximum(b, floor)
    wide, narrow = 0.5 * (a + b), 0.5 * (a - b)
    second = _ramp(offset + wide) - _ramp(offset + narrow) - _ramp(offset - narrow) + _ramp(offset - wide)
    return np.where(np.abs(offset) >= wide, (offset > 0).astype(float), np.clip(second / (a * b), 0.0, 1.0))


def quarter_plane_area(offsets: Array, gradients: Array) -> Array:
    """Return the area (n,) of the unit pixel where both offsets (n, 2) + gradients (n, 2, 2) · x are > 0."""
    square = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
    polygon = np.broadcast_to(square, (len(offsets), 4, 2))
    for i in range(2):
        polygon = _clip(polygon, offsets[:, i], gradients[:, i])
    following = np.roll(polygon, -1, axis=1)
    twice = polygon[..., 0] * following[..., 1] - polygon[..., 1] * following[..., 0]
    area: Array = 0.5 * np.sum(twice, axis=1)
    return area


def _ramp(t: Array) -> Array:
    return 0.5 * np.square(np.maximum(t, 0.0))


def _is_cut(share: Array) -> NDArray[np.bool_]:
    return (share > 0.0) & (share < 1.0)


def _clip(polygon: Array, offset: Array, gradient: Array) -> Array:
    """Clip polygons (n, m, 2) to half-planes; the result (n, 2m, 2) has the clipped area, vertices doubled.

    A vertex outside is put at its foot on the clipping line, where going to and fro encloses nothing: so
    every polygon keeps the same number of vertices and no case needs to be told apart.
    """
    level = offset[:, None] + np.einsum("nmi,ni->nm", polygon, gradient)
    norm = np.sum(gradient * gradient, axis=1)[:, None]
    foot = polygon - (np.minimum(level, 0.0) / norm)[..., None] * gradient[:, None, :]
    next_level, next_vertex = np.roll(level, -1, axis=1), np.roll(polygon, -1, axis=1)
    crosses = level * next_level < 0.0
    share = np.where(crosses, level / np.where(crosses, level - next_level, 1.0), 0.0)
    crossing = polygon + share[..., None] * (next_vertex - polygon)
    between = np.where(crosses[..., None], crossing, foot)
    return np.stack([foot, between], axis=2).reshape(len(polygon), 2 * polygon.shape[1], 2)
