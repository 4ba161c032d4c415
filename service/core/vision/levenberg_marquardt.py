"""Levenberg–Marquardt over all views at once, with a test that proves the optimum.

A step that puts a corner behind the camera or beyond the fold of the lens is refused like one that raises the
cost: beyond the fold a polynomial lens maps two directions to one pixel, and a solver that walks there finds
false optima. The proof is Newton's decrement: the decrease gᵀ(JᵀJ)⁻¹g that an undamped step still promises,
against the variance of the residuals. Its root is the distance to the optimum in standard deviations. Not
here: where to start.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.normal_equations import (
    Estimate,
    NormalEquations,
    is_feasible,
    linearise,
    reduce,
    solve_reduced,
)
from service.core.vision.transforms import Array
from service.core.vision.view_stack import ViewStack

DISTANCE_TO_OPTIMUM_SD = 3e-5
SMALLEST_SIGMA_PX = 1e-7
FIRST_DAMPING = 1e-4
LARGEST_DAMPING = 1e9


@dataclass(frozen=True)
class Fit:
    """Where a solve ended, after how many steps, and whether that is proven to be an optimum."""

    estimate: Estimate
    equations: NormalEquations
    iterations: int
    converged: bool


@dataclass(frozen=True)
class _Step:
    parameters: Array
    poses: Array
    promised: float


def minimise(
    lens: str,
    stack: ViewStack,
    start: Estimate,
    free: NDArray[np.intp],
    *,
    iterations: int = 200,
    damping: float = FIRST_DAMPING,
    may_fold: bool = False,
) -> Fit | None:
    """Minimise the squared reprojection errors over the free parameters (indices) and all poses.

    damping: the first one; small where the start is known to be near, so that the first step is nearly
    Newton's. may_fold: the way, but not the end, may lead beyond the fold of the lens. None where the start
    or the end is not feasible: a corner is behind the camera or beyond the fold.
    """
    if not is_feasible(lens, start, stack.visible_points, may_fold):
        return None
    fit = _descend(lens, stack, start, free, iterations=iterations, damping=damping, may_fold=may_fold)
    if may_fold and not is_feasible(lens, fit.estimate, stack.visible_points):
        return None
    return fit


def _descend(
    lens: str,
    stack: ViewStack,
    here: Estimate,
    free: NDArray[np.intp],
    *,
    iterations: int,
    damping: float,
    may_fold: bool,
) -> Fit:
    """Take steps from a feasible estimate until the optimum is proven or nothing helps any more."""
    equations = linearise(lens, stack, here, free)
    for iteration in range(iterations):
        step = _step(equations, damping)
        threshold = _threshold(stack, equations, len(free))
        if step is not None and step.promised <= threshold and _is_optimum(equations, threshold):
            return Fit(here, equations, iteration, converged=True)
        if damping > LARGEST_DAMPING:
            break
        moved = _try(lens, stack, here, free, step, may_fold=may_fold)
        gain = (equations.cost - moved[1].cost) / step.promised if moved and step else -1.0
        if moved and gain > 0:
            here, equations = moved
        damping = _next_damping(damping, gain)
    return Fit(here, equations, iterations, converged=False)


def _threshold(stack: ViewStack, equations: NormalEquations, free: int) -> float:
    """Return the promise, px², below which an estimate counts as the optimum."""
    unknowns = free + 6 * len(equations.V)
    variance = equations.cost / max(stack.measurements - unknowns, 1)
    return DISTANCE_TO_OPTIMUM_SD**2 * max(variance, SMALLEST_SIGMA_PX**2)


def _step(equations: NormalEquations, damping: float) -> _Step | None:
    """Return the damped step with the decrease that its linear model promises, None where undetermined."""
    try:
        reduced = reduce(equations, damping)
        parameters, poses = solve_reduced(reduced)
    except np.linalg.LinAlgError:
        return None
    along = parameters @ equations.by_parameters.sum(axis=0) + np.sum(poses * equations.by_pose)
    # The promise |e|² − |e − Jδ|² of a damped step exceeds δᵀg by λ δᵀDδ.
    diagonal_u = np.diagonal(equations.U, axis1=-2, axis2=-1).sum(axis=0)
    diagonal_v = np.diagonal(equations.V, axis1=-2, axis2=-1)
    damped = damping * (np.sum(diagonal_u * parameters**2) + np.sum(diagonal_v * poses**2))
    promised = float(along + damped)
    return _Step(parameters, poses, promised) if np.isfinite(promised) and promised >= 0 else None


def _is_optimum(equations: NormalEquations, threshold: float) -> bool:
    """Whether an undamped step promises next to nothing: damping hides a slope along a weak direction."""
    newton = _step(equations, 0.0)
    return newton is not None and newton.promised <= threshold


def _try(
    lens: str,
    stack: ViewStack,
    here: Estimate,
    free: NDArray[np.intp],
    step: _Step | None,
    *,
    may_fold: bool,
) -> tuple[Estimate, NormalEquations] | None:
    """Return the estimate after a step with its equations, None where no lens can do that."""
    if step is None:
        return None
    parameter_step = np.zeros_like(here.vector)
    parameter_step[free] = step.parameters
    moved = here.moved(parameter_step, step.poses)
    if not is_feasible(lens, moved, stack.visible_points, may_fold):
        return None
    return moved, linearise(lens, stack, moved, free)


def _next_damping(damping: float, gain: float) -> float:
    """Return the damping after a step with this share of the promised decrease."""
    if gain <= 0:
        return damping * 8.0
    if gain > 0.75:
        return damping * 0.05
    return damping if gain > 0.25 else damping * 3.0
