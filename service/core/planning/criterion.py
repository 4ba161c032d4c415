"""What a set of poses is to be good at, as one number that the search makes small.

Three aims, weighted: the paper's norm of all parameters, the mean and the worst mapping error over a zone.
Each counts in units of what an average set reaches, so that weights compare. The worst is a maximum, which
has no gradient everywhere; the search follows a mean whose weights move to where the error is large, round by
round. Not here: the search (`optimiser`), and figures for people (`scoring`, `prediction`).
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Final, Literal, get_args

import numpy as np

from service.core.planning.scoring import expected_covariance
from service.core.vision.transforms import Array

Objective = Literal["balanced", "parameters", "mapping", "worst"]
OBJECTIVES: Final = get_args(Objective)
SHARPENING: Final = 4.0


@dataclass(frozen=True)
class Weights:
    """How much each aim counts: any numbers from 0 on, not all 0; only their ratios matter."""

    parameters: float = 0.0
    mapping_mean: float = 0.0
    mapping_worst: float = 0.0


PRESETS: Final[Mapping[str, Weights]] = {
    "balanced": Weights(1.0, 1.0, 0.0),
    "parameters": Weights(1.0, 0.0, 0.0),
    "mapping": Weights(0.0, 1.0, 1.0),
    "worst": Weights(0.0, 0.0, 1.0),
}


@dataclass(frozen=True)
class Criterion:
    """Weights over scales (3,), mapping Jacobians J (k, 2, p) of pixels, and each one's share (k,) in the
    worst.

    J is that of `service.core.vision.uncertainty.compensated_jacobian`, free parameters only.
    """

    factors: Array
    J: Array
    shares: Array

    @property
    def metric(self) -> Array:
        """W (p, p): tr(W Σ) is the value of a covariance Σ, with the worst replaced by its weighted mean."""
        p = self.J.shape[-1]
        worst = np.einsum("kif,k,kig->fg", self.J, self.shares, self.J)
        mean = np.einsum("kif,kig->fg", self.J, self.J) / max(len(self.J), 1)
        metric: Array = self.factors[0] * np.eye(p) + self.factors[1] * mean + self.factors[2] * worst
        return metric

    @property
    def has_worst(self) -> bool:
        """Whether the worst pixel counts at all."""
        return bool(self.factors[2] > 0)

    def value(self, covariances: Array) -> float:
        """Return what covariances (d, p, p) are worth on average, the worst taken as it is."""
        variances = self.variances(covariances)
        aims = np.stack(
            [
                np.trace(covariances, axis1=1, axis2=2),
                variances.mean(axis=1),
                variances.max(axis=1),
            ],
            axis=1,
        )
        return float(np.mean(aims @ self.factors))

    def towards_the_worst(self, covariances: Array) -> "Criterion":
        """Return it with more weight on the pixels where covariances (d, p, p) leave most error."""
        variances = self.variances(covariances).mean(axis=0)
        shares = self.shares * (variances / variances.max()) ** SHARPENING
        return replace(self, shares=shares / shares.sum())

    def variances(self, covariances: Array) -> Array:
        """Return the variance (d, k), px², of each pixel's mapping."""
        root = np.linalg.cholesky(covariances)
        spread = self.J.reshape(-1, self.J.shape[-1]) @ root
        squares = np.sum(spread * spread, axis=2)
        variances: Array = squares.reshape(len(covariances), -1, 2).sum(axis=2)
        return variances


def make_criterion(weights: Weights, information: Array, J: Array | None = None) -> Criterion:
    """Return the criterion for candidates of mean information (p, p) and mapping Jacobians J (k, 2, p).

    Pixels that the lens does not reach (NaN) are left out; J is needed as soon as the mapping counts.
    """
    p = information.shape[-1]
    if J is None and (weights.mapping_mean > 0 or weights.mapping_worst > 0):
        raise ValueError("The mapping needs its Jacobians.")
    reached = np.zeros((1, 2, p)) if J is None else J[np.all(np.isfinite(J), axis=(1, 2))]
    shares = np.full(len(reached), 1.0 / len(reached))
    bare = Criterion(np.ones(3), reached, shares)
    covariance = expected_covariance(information)[None]
    variances = bare.variances(covariance)[0]
    scales = np.array([np.trace(covariance[0]), variances.mean(), variances.max()])
    wanted = np.array([weights.parameters, weights.mapping_mean, weights.mapping_worst])
    return replace(bare, factors=np.where(wanted > 0, wanted / np.where(scales > 0, scales, 1.0), 0.0))
