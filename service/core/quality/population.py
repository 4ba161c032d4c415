"""What the cameras of a SKU revision have in common: mean and covariance of their intrinsics, and how far one
camera is from them.

Moments are kept by adding one unit after the other and can be made again from the units. The sample
covariance holds the spread of the cameras and the noise of their calibrations; between cameras is what is
left without the second. A distance is squared, in standard deviations of the spread and the camera's own
uncertainty together (Mahalanobis). A population known from n units is itself uncertain: the distance of a new
unit then follows Hotelling's T², and is scaled so that a limit from the chi-square distribution holds for any
n. Not here: limits and what is said (`gates_population`).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from service.core.vision.transforms import Array

NEEDED_UNITS = 50
MOST_LEFT_OUT = (
    0.1  # of the first units; where more lie apart it is a mixture, and nobody knows which are wrong
)
QUANTILE = 0.999  # at which the scaled T² and the chi-square agree
LIMIT_DOF = 9  # degrees of freedom for which the limit on the distance is stated


@dataclass(frozen=True)
class Moments:
    """Sums over units: how many, their mean (p,), scatter Σ(x − mean)(x − mean)ᵀ, and Σ own covariances."""

    units: int
    mean: Array
    scatter: Array
    own: Array

    @classmethod
    def of_none(cls, size: int) -> "Moments":
        """Return the moments of no unit at all, of so many parameters."""
        return cls(0, np.zeros(size), np.zeros((size, size)), np.zeros((size, size)))

    def with_unit(self, vector: Array, covariance: Array) -> "Moments":
        """Return the moments with one more unit: its parameters (p,) and their own covariance (p, p)."""
        off, units = vector - self.mean, self.units + 1
        scatter = self.scatter + np.outer(off, off) * (self.units / units)
        return Moments(units, self.mean + off / units, scatter, self.own + covariance)

    def without_unit(self, vector: Array, covariance: Array) -> "Moments":
        """Return the moments without a unit that is in them."""
        units = self.units - 1
        if units == 0:
            return Moments.of_none(len(self.mean))
        mean = self.mean - (vector - self.mean) / units
        off = vector - mean
        scatter = self.scatter - np.outer(off, off) * (units / self.units)
        return Moments(units, mean, scatter, self.own - covariance)


@dataclass(frozen=True)
class Population:
    """How many units, their mean (p,), and their covariance (p, p) without noise of their calibrations."""

    units: int
    mean: Array
    between: Array


@dataclass(frozen=True)
class Distance:
    """How far a camera is from a population.

    squared: of `dof` degrees of freedom, scaled to the chi-square distribution. unlikeliness: −2 ln of the
    likelihood, without its constant. farthest: index of the parameter that is most standard deviations off,
    and how many.
    """

    squared: float
    unlikeliness: float
    dof: int
    farthest: int
    farthest_sd: float


def population_of(moments: Moments) -> Population:
    """Return the population that moments of at least two units describe.

    Where the units' own noise exceeds what was seen of the spread, the spread is zero and never negative.
    """
    sample = moments.scatter / (moments.units - 1)
    between = sample - moments.own / moments.units
    scale = np.sqrt(np.maximum(np.diagonal(sample), 0.0))
    scale = np.where(scale > 0.0, scale, 1.0)
    values, vectors = np.linalg.eigh(between / np.outer(scale, scale))
    spread = (vectors * np.maximum(values, 0.0)) @ vectors.T * np.outer(scale, scale)
    return Population(moments.units, moments.mean, 0.5 * (spread + spread.T))


def population_distance(population: Population, vector: Array, covariance: Array) -> Distance:
    """Return how far parameters (p,) with their own covariance (p, p) are from a population.

    Parameters without any variance of their own are fixed and not counted.
    """
    free = np.flatnonzero(np.diagonal(covariance) > 0.0)
    total = (population.between + covariance)[np.ix_(free, free)]
    scale = np.sqrt(np.diagonal(total))
    off = (vector - population.mean)[free] / scale
    lower = np.linalg.cholesky(total / np.outer(scale, scale))
    squared = float(np.sum(np.linalg.solve(lower, off) ** 2)) * _certainty(population.units, len(free))
    log_det = 2.0 * float(np.sum(np.log(np.diagonal(lower))) + np.sum(np.log(scale)))
    at = int(np.argmax(np.abs(off)))
    return Distance(squared, squared + log_det, len(free), int(free[at]), float(off[at]))


def distance_limit(limit: float, dof: int) -> float:
    """Return the limit that lets through as many good cameras as a limit for nine degrees of freedom does."""
    if dof == LIMIT_DOF:
        return limit
    return float(stats.chi2.isf(stats.chi2.sf(limit, LIMIT_DOF), dof))


def expected_advantage(own: Population, other: Population, covariance: Array) -> float:
    """Return by how much −2 ln of the likelihood is lower for its own population, for a usual camera.

    That is twice the Kullback–Leibler divergence of the two; zero where they are the same. covariance: the
    camera's own, (p, p).
    """
    free = np.flatnonzero(np.diagonal(covariance) > 0.0)
    at = np.ix_(free, free)
    here, there = (own.between + covariance)[at], (other.between + covariance)[at]
    scale = np.sqrt(np.diagonal(there))
    here, there = here / np.outer(scale, scale), there / np.outer(scale, scale)
    off = (own.mean - other.mean)[free] / scale
    _, log_here = np.linalg.slogdet(here)
    _, log_there = np.linalg.slogdet(there)
    spread = float(np.trace(np.linalg.solve(there, here))) - len(free) + float(log_there - log_here)
    return spread + float(off @ np.linalg.solve(there, off))


def select_units(vectors: Sequence[Array], covariances: Sequence[Array], limit: float) -> NDArray[np.bool_]:
    """Return which of the first units make up the population: all but a few that lie apart from the others.

    Each is measured against the others; the farthest goes as long as it is beyond the limit (for nine degrees
    of freedom). Where more than a tenth would go all stay.
    """
    kept = np.ones(len(vectors), dtype=np.bool_)
    moments = Moments.of_none(len(vectors[0]))
    for vector, covariance in zip(vectors, covariances, strict=True):
        moments = moments.with_unit(vector, covariance)
    while True:
        worst, over = -1, 1.0
        for i in map(int, np.flatnonzero(kept)):
            others = population_of(moments.without_unit(vectors[i], covariances[i]))
            distance = population_distance(others, vectors[i], covariances[i])
            share = distance.squared / distance_limit(limit, distance.dof)
            if share > over:
                worst, over = i, share
        if worst < 0:
            return kept
        kept[worst] = False
        moments = moments.without_unit(vectors[worst], covariances[worst])
        if np.count_nonzero(~kept) > MOST_LEFT_OUT * len(kept):
            return np.ones(len(vectors), dtype=np.bool_)


def _certainty(units: int, dof: int) -> float:
    """Return what turns T² of a unit against n others into a chi-square of the same tail: below 1."""
    if units <= dof + 1:
        return 0.0
    spread = dof * (units**2 - 1.0) / (units * (units - dof))
    return float(stats.chi2.ppf(QUANTILE, dof) / (spread * stats.f.ppf(QUANTILE, dof, units - dof)))
