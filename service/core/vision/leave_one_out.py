"""What a result would have been without one of its views, for each view, in the time of one more iteration.

The Schur complement adds up over views, so a view is taken away by a subtraction, and one Gauss–Newton step
from the common optimum leads to the optimum without it. Exact to first order; a view that moves the result by
many standard deviations is found all the same. Not here: limits (`service.core.quality`).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.calibration import CalibrationResult
from service.core.vision.camera import parameter_names
from service.core.vision.normal_equations import Reduced, unit_scale
from service.core.vision.transforms import Array

LEAST_EIGENVALUE = 1e-13


@dataclass(frozen=True)
class LeaveOneOut:
    """Results without each of v views.

    vectors: (v, p) parameters. held_out_rms_px: (v,) rms of a view under the parameters of the others, its
    own pose refitted. fit_rms_px: (v,) rms of the same view as part of the solve. covariance: (p, p)
    jackknife estimate, which sees what noise alone does not explain. A view whose absence leaves a parameter
    undetermined has NaN.
    """

    vectors: Array
    held_out_rms_px: Array
    fit_rms_px: Array
    covariance: Array

    @property
    def ratio(self) -> float:
        """Rms of all held-out views over the rms of the fit: near one where views agree on the camera."""
        return float(np.sqrt(np.mean(self.held_out_rms_px**2) / np.mean(self.fit_rms_px**2)))


def leave_one_out(result: CalibrationResult) -> LeaveOneOut:
    """Return the results without each view of a solve."""
    vector, squared_errors = result.intrinsics.vector, result.equations.squared_errors
    free = [i for i, name in enumerate(parameter_names(result.intrinsics.lens)) if name not in result.fixed]
    reduced = result.reduced
    steps = _steps_without(reduced)
    vectors = np.tile(vector, (len(steps), 1))
    vectors[:, free] += steps
    gained = 2.0 * np.sum(steps * reduced.gradient, axis=1)
    curved = np.einsum("vf,vfg,vg->v", steps, reduced.information, steps)
    counts = np.array([len(residuals) for residuals in result.residuals])
    held_out = np.sqrt(np.maximum(squared_errors - gained + curved, 0.0) / counts)
    spread = vectors - vectors.mean(axis=0)
    covariance = spread.T @ spread * (len(steps) - 1) / len(steps)
    return LeaveOneOut(vectors, held_out, np.sqrt(squared_errors / counts), covariance)


def _steps_without(reduced: Reduced) -> Array:
    """Return the Gauss–Newton steps (v, f) to the optimum without each view; NaN where there is none."""
    total = reduced.information.sum(axis=0)
    scale = unit_scale(total)
    remaining = (total - reduced.information) * np.outer(scale, scale)
    gradient = (reduced.gradient.sum(axis=0) - reduced.gradient) * scale
    determined = _are_above(remaining, LEAST_EIGENVALUE)
    remaining = np.where(determined[:, None, None], remaining, np.eye(len(scale)))
    steps: Array = np.linalg.solve(remaining, gradient[..., None])[..., 0] * scale
    return np.where(determined[:, None], steps, np.nan)


def _are_above(matrices: Array, least: float) -> NDArray[np.bool_]:
    """Whether all eigenvalues of symmetric matrices (v, f, f) are above the least; they usually all are."""
    try:
        np.linalg.cholesky(matrices - least * np.eye(matrices.shape[-1]))
    except np.linalg.LinAlgError:
        return np.asarray(np.linalg.eigvalsh(matrices)[:, 0] > least)
    return np.ones(len(matrices), dtype=np.bool_)
