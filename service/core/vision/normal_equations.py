"""The normal equations of a solve over many views, and what is left of them without the poses.

Each view's unknowns are the shared parameters C and its own six pose values. Its block of JᵀJ is
[[U, W], [Wᵀ, V]]; eliminating the pose leaves the Schur complement U − W V⁻¹ Wᵀ, which is what the view tells
about C. Not here: how steps are taken (`levenberg_marquardt`).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.camera import LENSES, project_with_jacobians
from service.core.vision.transforms import Array, rotation_matrix
from service.core.vision.view_stack import ViewStack


@dataclass(frozen=True)
class Estimate:
    """Where a solve stands: parameters (p,), rotations (v, 3, 3) and translations (v, 3) m of the views."""

    vector: Array
    rotations: Array
    translations: Array

    def moved(self, parameter_step: Array, pose_steps: Array) -> "Estimate":
        """Return the estimate after steps (p,) and (v, 6): left increments in rad, then metres."""
        turned = rotation_matrix(pose_steps[:, :3]) @ self.rotations
        return Estimate(self.vector + parameter_step, turned, self.translations + pose_steps[:, 3:])


@dataclass(frozen=True)
class NormalEquations:
    """Blocks at one estimate: U (v, f, f), W (v, f, 6), V (v, 6, 6) for f free parameters.

    by_parameters (v, f) and by_pose (v, 6) are gradients, squared_errors (v,) px². Gradients are Jᵀe with e =
    detected − projected, so that steps solve JᵀJ δ = Jᵀe.
    """

    U: Array
    W: Array
    V: Array
    by_parameters: Array
    by_pose: Array
    squared_errors: Array

    @property
    def cost(self) -> float:
        """Sum of squared weighted errors, px²."""
        return float(self.squared_errors.sum())


@dataclass(frozen=True)
class Reduced:
    """Equations without the poses: information (v, f, f), gradient (v, f); V⁻¹Wᵀ (v, 6, f), V⁻¹g (v, 6)."""

    information: Array
    gradient: Array
    pose_by_parameters: Array
    pose_alone: Array


def is_feasible(lens: str, estimate: Estimate, object_points: Array, may_fold: bool = False) -> bool:
    """Whether the lens shows each board point (v, n, 3) and, unless it may fold, before the fold."""
    if not (np.all(np.isfinite(estimate.vector)) and estimate.vector[:2].min() > 0):
        return False
    points = object_points @ np.swapaxes(estimate.rotations, -1, -2) + estimate.translations[:, None, :]
    model = LENSES[lens]
    farthest = float(model.radius(points).max())
    # Written so that NaN is not feasible.
    return farthest < np.inf and (may_fold or farthest < model.reach(estimate.vector[4:]))


def linearise(lens: str, stack: ViewStack, estimate: Estimate, free: NDArray[np.intp]) -> NormalEquations:
    """Return the normal equations of the views at an estimate, for the free parameters (indices)."""
    pixels, by_parameters, by_pose = project_with_jacobians(
        lens, estimate.vector, estimate.rotations, estimate.translations, stack.object_points
    )
    views, count, f = len(pixels), pixels.shape[1], len(free)
    # One row for each unknown: the products below then run along contiguous memory.
    J = np.empty((views, f + 7, 2, count))
    rows = J.transpose(0, 3, 2, 1)
    rows[..., :f] = by_parameters if f == by_parameters.shape[-1] else by_parameters[..., free]
    rows[..., f:-1] = by_pose
    rows[..., -1] = stack.image_points - pixels
    if stack.is_weighted:
        J *= stack.weights[:, None, None, :]
    flat = J.reshape(views, f + 7, 2 * count)
    G = flat @ np.swapaxes(flat, -1, -2)
    return NormalEquations(
        G[:, :f, :f], G[:, :f, f:-1], G[:, f:-1, f:-1], G[:, :f, -1], G[:, f:-1, -1], G[:, -1, -1]
    )


def reduce(equations: NormalEquations, damping: float = 0.0) -> Reduced:
    """Eliminate the poses, with Marquardt's damping on the diagonals.

    Raises LinAlgError where a pose is undetermined.
    """
    U, V = equations.U, equations.V
    if damping > 0:
        U, V = _damped(U, damping), _damped(V, damping)
    right = np.concatenate([np.swapaxes(equations.W, -1, -2), equations.by_pose[..., None]], axis=-1)
    solved = np.linalg.solve(V, right)
    pose_by_parameters, pose_alone = solved[..., :-1], solved[..., -1]
    removed = equations.W @ solved
    return Reduced(
        U - removed[..., :-1], equations.by_parameters - removed[..., -1], pose_by_parameters, pose_alone
    )


def solve_reduced(reduced: Reduced) -> tuple[Array, Array]:
    """Return the steps of the parameters (f,) and of the poses (v, 6).

    Raises LinAlgError where the parameters are undetermined.
    """
    information, gradient = reduced.information.sum(axis=0), reduced.gradient.sum(axis=0)
    scale = unit_scale(information)
    step = scale * np.linalg.solve(information * np.outer(scale, scale), gradient * scale)
    return step, reduced.pose_alone - reduced.pose_by_parameters @ step


def unit_scale(information: Array) -> Array:
    """Return factors (f,) that give an information matrix (f, f) a diagonal of ones.

    Raises LinAlgError where a parameter has no information at all.
    """
    diagonal = np.diagonal(information)
    if not (np.all(np.isfinite(diagonal)) and np.all(diagonal > 0)):
        raise np.linalg.LinAlgError("a parameter is undetermined")
    return np.asarray(1.0 / np.sqrt(diagonal))


def _damped(matrices: Array, damping: float) -> Array:
    """Return matrices (v, d, d) with their diagonals enlarged by a factor 1 + damping."""
    index = np.arange(matrices.shape[-1])
    out = matrices.copy()
    out[..., index, index] *= 1.0 + damping
    return out
