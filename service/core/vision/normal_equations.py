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
    """Where a solve stands: parameters (p,), rotations (v, 3, 3) and translations (v, 3) m of the views.

    Or where several solves stand: with a leading dimension each.
    """

    vector: Array
    rotations: Array
    translations: Array

    def moved(self, parameter_step: Array, pose_steps: Array) -> "Estimate":
        """Return the estimate after steps (p,) and (v, 6): left increments in rad, then metres."""
        turned = rotation_matrix(pose_steps[..., :3]) @ self.rotations
        return Estimate(self.vector + parameter_step, turned, self.translations + pose_steps[..., 3:])


@dataclass(frozen=True)
class NormalEquations:
    """Blocks of each view at one estimate, the errors e = detected − projected as a column more behind J.

    shared (v, f + 1, f + 1) for f free parameters: U with the gradient Jᵀe as its last column and e² in its
    corner. mixed (v, 6, f + 1): Wᵀ with the poses' gradient. V (v, 6, 6). Steps solve JᵀJ δ = Jᵀe. With a
    leading dimension each where the estimate is one of several solves.
    """

    shared: Array
    mixed: Array
    V: Array

    @property
    def squared_errors(self) -> Array:
        """Sum of squared weighted errors of each view (v,), px²."""
        errors: Array = self.shared[..., -1, -1]
        return errors

    @property
    def cost(self) -> Array:
        """Sum of squared weighted errors (), px²."""
        return np.asarray(self.squared_errors.sum(axis=-1))

    def after(self, step: "Step") -> "NormalEquations":
        """Return what a linear model makes of them after a step of one solve: J stays, e becomes e − Jδ."""
        shared, mixed = self.shared.copy(), self.mixed.copy()
        W = mixed[..., :-1]
        by_parameters = (
            shared[:, :-1, :-1] @ step.parameters + (np.swapaxes(W, 1, 2) @ step.poses[..., None])[..., 0]
        )
        by_poses = W @ step.parameters + (self.V @ step.poses[..., None])[..., 0]
        # |e − Jδ|² = e² − δᵀ(2 Jᵀe − JᵀJ δ), which rounding makes negative where nothing is left.
        gained = (2.0 * shared[:, :-1, -1] - by_parameters) @ step.parameters
        gained += np.sum((2.0 * mixed[..., -1] - by_poses) * step.poses, axis=1)
        shared[:, -1, -1] = np.maximum(shared[:, -1, -1] - gained, 0.0)
        shared[:, :-1, -1] -= by_parameters
        shared[:, -1, :-1] = shared[:, :-1, -1]
        mixed[..., -1] -= by_poses
        return NormalEquations(shared, mixed, self.V)


@dataclass(frozen=True)
class Reduced:
    """What each view tells without its pose: information (v, f, f), gradient (v, f)."""

    information: Array
    gradient: Array


@dataclass(frozen=True)
class Step:
    """Steps of the parameters (f,) and poses (v, 6), and the decrease (), px², that they promise."""

    parameters: Array
    poses: Array
    promised: Array


def is_feasible(
    lens: str, estimate: Estimate, object_points: Array, may_fold: bool = False
) -> NDArray[np.bool_]:
    """Whether the lens shows each board point (v, n, 3) and, unless it may fold, before the fold: ()."""
    points = turn_points(estimate.rotations, object_points) + estimate.translations[..., None, :]
    model = LENSES[lens]
    farthest = model.radius(points).max(axis=(-2, -1))
    is_sound = np.isfinite(estimate.vector).all(axis=-1) & (estimate.vector[..., :2].min(axis=-1) > 0)
    # Written so that NaN is not feasible.
    possible = np.atleast_1d(is_sound & (farthest < np.inf))
    if not may_fold:
        vectors = np.atleast_2d(estimate.vector)
        for row in np.flatnonzero(possible):
            possible[row] = model.reaches(vectors[row, 4:], float(np.atleast_1d(farthest)[row]))
    return possible.reshape(farthest.shape)


def linearise(lens: str, stack: ViewStack, estimate: Estimate, free: NDArray[np.intp]) -> NormalEquations:
    """Return the normal equations of the views at an estimate, for the free parameters (indices)."""
    # One for all views is taken without a dimension of its own, which is faster.
    vector = (
        estimate.vector.reshape(-1)
        if estimate.vector.size == estimate.vector.shape[-1]
        else estimate.vector[:, None]
    )
    pixels, by_parameters, by_pose = project_with_jacobians(
        lens, vector, estimate.rotations, estimate.translations, stack.object_points
    )
    count, f = pixels.shape[-2], len(free)
    # One row for each unknown: the products below then run along contiguous memory.
    J = np.empty((*pixels.shape[:-2], f + 7, 2, count))
    rows = J.swapaxes(-1, -3)
    # The first ones are a view of them, any others a copy.
    rows[..., :f] = by_parameters[..., :f] if free[-1] == f - 1 else by_parameters[..., free]
    rows[..., f] = stack.image_points - pixels
    rows[..., f + 1 :] = by_pose
    if stack.is_weighted:
        J *= stack.weights[:, None, None, :]
    flat = J.reshape(*J.shape[:-2], 2 * count)
    G = flat @ flat.swapaxes(-1, -2)
    known, pose = slice(0, f + 1), slice(f + 1, None)
    return NormalEquations(
        G[..., known, known], np.ascontiguousarray(G[..., pose, known]), G[..., pose, pose]
    )


def reduce(equations: NormalEquations) -> Reduced:
    """Eliminate the poses; raises LinAlgError where one is undetermined."""
    mixed = equations.mixed
    left = equations.shared - np.swapaxes(mixed, -1, -2) @ np.linalg.solve(equations.V, mixed)
    return Reduced(left[:, :-1, :-1], left[:, :-1, -1])


def solve_step(equations: NormalEquations, damping: Array | float = 0.0) -> Step:
    """Return the step with Marquardt's damping () on the diagonals.

    Raises LinAlgError where the parameters or a pose are undetermined.
    """
    V, mixed = equations.V, equations.mixed
    total = equations.shared.sum(axis=-3)
    added = added_to_poses = np.zeros(())
    if np.any(damping):
        damping = np.asarray(damping)
        added = damping[..., None] * _diagonal(total)[..., :-1]
        added_to_poses = damping[..., None, None] * _diagonal(V)
        V = V.copy()
        _diagonal(V)[...] += added_to_poses
    eliminated = np.linalg.solve(V, mixed)
    # The sum of all views' products is one product of all their rows.
    as_rows = (*mixed.shape[:-3], -1, mixed.shape[-1])
    left = total - mixed.reshape(as_rows).swapaxes(-1, -2) @ eliminated.reshape(as_rows)
    _diagonal(left)[..., :-1] += added
    parameters = _solve_scaled(left[..., :-1, :-1], left[..., :-1, -1])
    poses = eliminated[..., -1] - (eliminated[..., :-1] @ parameters[..., None, :, None])[..., 0]
    # The promise |e|² − |e − Jδ|² of a damped step exceeds δᵀg by λ δᵀDδ.
    promised = np.sum(parameters * (total[..., :-1, -1] + added * parameters), axis=-1)
    promised += np.sum(poses * (mixed[..., -1] + added_to_poses * poses), axis=(-2, -1))
    return Step(parameters, poses, np.asarray(promised))


def _diagonal(matrices: Array) -> Array:
    """Return the diagonals (..., n) of matrices (..., n, n), in their own memory."""
    return np.asarray(np.einsum("...ii->...i", matrices))


def unit_scale(information: Array) -> Array:
    """Return factors (f,) that give an information matrix (f, f) a diagonal of ones.

    Raises LinAlgError where a parameter has no information at all.
    """
    diagonal = _diagonal(information)
    # Written so that NaN has none either.
    if not (diagonal.min() > 0 and diagonal.max() < np.inf):
        raise np.linalg.LinAlgError("a parameter is undetermined")
    return np.asarray(1.0 / np.sqrt(diagonal))


def _solve_scaled(information: Array, gradient: Array) -> Array:
    """Solve a system whose unknowns have units of their own."""
    scale = unit_scale(information)
    scaled = information * (scale[..., None] * scale[..., None, :])
    return np.asarray(scale * np.linalg.solve(scaled, (gradient * scale)[..., None])[..., 0])
