"""The normal equations of a solve over many views, and what is left of them without the poses.

Each view's unknowns are the shared parameters C and its own six pose values. Its block of JᵀJ is
[[U, W], [Wᵀ, V]]; eliminating the pose leaves the Schur complement U − W V⁻¹ Wᵀ, which is what the view tells
about C. Not here: how steps are taken (`levenberg_marquardt`).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.camera import LENSES, project_with_jacobians
from service.core.vision.transforms import Array, rotation_matrix, turn_points
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
    """Blocks of each view at one estimate, the errors e = detected − projected as a column more behind J.

    shared (v, f + 1, f + 1) for f free parameters: U with the gradient Jᵀe as its last column and e² in its
    corner. mixed (v, 6, f + 1): Wᵀ with the poses' gradient. V (v, 6, 6). Steps solve JᵀJ δ = Jᵀe.
    """

    shared: Array
    mixed: Array
    V: Array

    @property
    def squared_errors(self) -> Array:
        """Sum of squared weighted errors of each view (v,), px²."""
        errors: Array = self.shared[:, -1, -1]
        return errors

    @property
    def cost(self) -> float:
        """Sum of squared weighted errors, px²."""
        return float(self.squared_errors.sum())


@dataclass(frozen=True)
class Reduced:
    """What each view tells without its pose: information (v, f, f), gradient (v, f)."""

    information: Array
    gradient: Array


@dataclass(frozen=True)
class Step:
    """Steps of the parameters (f,) and poses (v, 6), and the decrease, px², that a linear model promises."""

    parameters: Array
    poses: Array
    promised: float


def is_feasible(lens: str, estimate: Estimate, object_points: Array, may_fold: bool = False) -> bool:
    """Whether the lens shows each board point (v, n, 3) and, unless it may fold, before the fold."""
    if not (np.all(np.isfinite(estimate.vector)) and estimate.vector[:2].min() > 0):
        return False
    points = turn_points(estimate.rotations, object_points) + estimate.translations[:, None, :]
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
    rows[..., f] = stack.image_points - pixels
    rows[..., f + 1 :] = by_pose
    if stack.is_weighted:
        J *= stack.weights[:, None, None, :]
    flat = J.reshape(views, f + 7, 2 * count)
    G = flat @ np.swapaxes(flat, -1, -2)
    known, pose = slice(0, f + 1), slice(f + 1, None)
    return NormalEquations(G[:, known, known], np.ascontiguousarray(G[:, pose, known]), G[:, pose, pose])


def reduce(equations: NormalEquations) -> Reduced:
    """Eliminate the poses; raises LinAlgError where one is undetermined."""
    mixed = equations.mixed
    left = equations.shared - np.swapaxes(mixed, -1, -2) @ np.linalg.solve(equations.V, mixed)
    return Reduced(left[:, :-1, :-1], left[:, :-1, -1])


def solve_step(equations: NormalEquations, damping: float = 0.0) -> Step:
    """Return the step with Marquardt's damping on the diagonals.

    Raises LinAlgError where the parameters or a pose are undetermined.
    """
    columns = equations.mixed.shape[-1]
    total = equations.shared.sum(axis=0)
    added_to_poses = damping * np.einsum("vii->vi", equations.V)
    added = damping * np.diagonal(total)[:-1]
    V = equations.V.copy()
    np.einsum("vii->vi", V)[...] += added_to_poses
    eliminated = np.linalg.solve(V, equations.mixed)
    # The sum of all views' products is one product of all their rows.
    left = total - equations.mixed.reshape(-1, columns).T @ eliminated.reshape(-1, columns)
    parameters = _solve_scaled(left[:-1, :-1] + np.diag(added), left[:-1, -1])
    poses = eliminated[..., -1] - eliminated[..., :-1] @ parameters
    # The promise |e|² − |e − Jδ|² of a damped step exceeds δᵀg by λ δᵀDδ.
    promised = parameters @ (total[:-1, -1] + added * parameters)
    promised += np.vdot(poses, equations.mixed[..., -1] + added_to_poses * poses)
    return Step(parameters, poses, float(promised))


def unit_scale(information: Array) -> Array:
    """Return factors (f,) that give an information matrix (f, f) a diagonal of ones.

    Raises LinAlgError where a parameter has no information at all.
    """
    diagonal = np.diagonal(information)
    # Written so that NaN has none either.
    if not (diagonal.min() > 0 and diagonal.max() < np.inf):
        raise np.linalg.LinAlgError("a parameter is undetermined")
    return np.asarray(1.0 / np.sqrt(diagonal))


def _solve_scaled(information: Array, gradient: Array) -> Array:
    """Solve a system whose unknowns have units of their own."""
    scale = unit_scale(information)
    return np.asarray(scale * np.linalg.solve(information * np.outer(scale, scale), gradient * scale))
