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
    Step,
    is_feasible,
    linearise,
    solve_step,
)
from service.core.vision.view_stack import ViewStack

DISTANCE_TO_OPTIMUM_SD = 3e-5
SMALLEST_SIGMA_PX = 1e-7
FIRST_DAMPING = 1e-4
LARGEST_DAMPING = 1e9


@dataclass(frozen=True)
class Fit:
    """Where a solve ended, after how many steps, and the undamped step that proves it to be an optimum.

    That step is not taken: it is None where nothing is proven.
    """

    estimate: Estimate
    equations: NormalEquations
    iterations: int
    proof: Step | None

    @property
    def converged(self) -> bool:
        """Whether the end is proven to be an optimum."""
        return self.proof is not None


def minimise(
    lens: str,
    stack: ViewStack,
    start: Estimate,
    free: NDArray[np.intp],
    *,
    iterations: int = 200,
    damping: float = FIRST_DAMPING,
    distance_sd: float = DISTANCE_TO_OPTIMUM_SD,
    may_fold: bool = False,
) -> Fit | None:
    """Minimise the squared reprojection errors over the free parameters (indices) and all poses.

    damping: the first one; small where the start is known to be near, so that the first step is nearly
    Newton's. distance_sd: how near to the optimum is near enough. may_fold: the way, but not the end, may
    lead beyond the fold of the lens. None where the start or the end is not feasible: a corner is behind the
    camera or beyond the fold.
    """
    if not is_feasible(lens, start, stack.visible_points, may_fold):
        return None
    way = _Way(iterations, damping, distance_sd, may_fold)
    fit = _descend(lens, stack, start, free, way)
    if may_fold and not is_feasible(lens, fit.estimate, stack.visible_points):
        return None
    return fit


@dataclass(frozen=True)
class _Way:
    iterations: int
    damping: float
    distance_sd: float
    may_fold: bool


def _descend(lens: str, stack: ViewStack, here: Estimate, free: NDArray[np.intp], way: _Way) -> Fit:
    """Take steps from a feasible estimate until the optimum is proven or nothing helps any more."""
    equations, damping = linearise(lens, stack, here, free), way.damping
    for iteration in range(way.iterations):
        step = _step(equations, damping)
        threshold = way.distance_sd**2 * _variance(stack, equations, len(free))
        if step is not None and step.promised <= threshold:
            proof = _proof(equations, threshold)
            if proof is not None:
                return Fit(here, equations, iteration, proof)
        if damping > LARGEST_DAMPING:
            break
        moved = _try(lens, stack, here, free, step, may_fold=way.may_fold)
        gain = (equations.cost - moved[1].cost) / step.promised if moved and step else -1.0
        if moved and gain > 0:
            here, equations = moved
        damping = _next_damping(damping, gain)
    return Fit(here, equations, way.iterations, None)


def _variance(stack: ViewStack, equations: NormalEquations, free: int) -> float:
    """Return the variance of a corner coordinate, px², as the residuals tell it."""
    unknowns = free + 6 * len(equations.V)
    return max(equations.cost / max(stack.measurements - unknowns, 1), SMALLEST_SIGMA_PX**2)


def _step(equations: NormalEquations, damping: float) -> Step | None:
    """Return the damped step; None where it is undetermined."""
    try:
        step = solve_step(equations, damping)
    except np.linalg.LinAlgError:
        return None
    return step if 0.0 <= step.promised < np.inf else None


def _proof(equations: NormalEquations, threshold: float) -> Step | None:
    """Return the undamped step if it promises next to nothing: damping hides slopes along weak directions."""
    newton = _step(equations, 0.0)
    return newton if newton is not None and newton.promised <= threshold else None


def _try(
    lens: str,
    stack: ViewStack,
    here: Estimate,
    free: NDArray[np.intp],
    step: Step | None,
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
