"""Dark dots. Not here: where they are."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from service.core.vision.printed import Disc
from service.core.vision.transforms import Array
from service.simulator.coverage import half_plane_area
from service.simulator.soft_edges import Levels, soft_step

FLAT = 0.25  # of a radius: over so much of its rim a dot is taken as straight


@dataclass(frozen=True)
class Discs:
    """Dots by their centres (k, 2) and radii (k,), squares."""

    centres: Array
    radii: Array

    @property
    def finest(self) -> float:
        """How much of a rim is nearly straight."""
        return float(FLAT * self.radii.min())

    def sample(self, uv: Array) -> NDArray[np.bool_]:
        """Return whether points (n, 2) lie in a dot."""
        inside, _ = self._inside(uv)
        return inside > 0.0

    def shares(self, uv: Array, jacobian: Array) -> Array:
        """Return the dark shares (n,) of pixels, with the rim as straight within each."""
        inside, outwards = self._inside(uv)
        return half_plane_area(inside, -np.einsum("ni,nij->nj", outwards, jacobian))

    def near_edge(self, uv: Array, half: Array) -> NDArray[np.bool_]:
        """Return whether a rim may lie within half (n, 2) of points (n, 2)."""
        return np.asarray(np.abs(self._inside(uv)[0]) < np.hypot(half[:, 0], half[:, 1]))

    def soft_shares(self, u: Levels, v: Levels, footprint: tuple[Levels, Levels]) -> Levels:
        """Return the dark shares (h, w) of pixels, softly."""
        uv = np.stack([u, v], axis=-1).reshape(-1, 2).astype(np.float64)
        inside, outwards = self._inside(uv)
        across = np.abs(outwards.reshape(*u.shape, 2)).astype(np.float32)
        width = np.hypot(across[..., 0] * footprint[0], across[..., 1] * footprint[1])
        return soft_step(inside.reshape(u.shape).astype(np.float32), width)

    def _inside(self, uv: Array) -> tuple[Array, Array]:
        """Return how far (n,) points lie inside the nearest dot, and the direction (n, 2) out of it."""
        away, nearest = cKDTree(self.centres).query(uv)
        outwards = (uv - self.centres[nearest]) / np.maximum(away, 1e-12)[:, None]
        return self.radii[nearest] - away, outwards


def make_discs(discs: Sequence[Disc], square_m: float) -> Discs:
    """Return the pattern of dots."""
    centres = np.array([disc.centre for disc in discs])
    return Discs(centres / square_m, np.array([disc.radius_m for disc in discs]) / square_m)
