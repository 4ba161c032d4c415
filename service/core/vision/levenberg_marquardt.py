"""Levenberg–Marquardt over all views at once, with a test that proves the optimum.

Solves from several starts go side by side, each with its own damping: their equations are set up in one pass,
which takes hardly longer than that of one of them. A step that puts a corner behind the camera or beyond the
fold of the lens is refused like one that raises the cost: beyond the fold a polynomial lens maps two
directions to one pixel, and a solver that walks there finds false optima. The proof is Newton's decrement:
the decrease gᵀ(JᵀJ)⁻¹g that an undamped step still promises, against the variance of the residuals. Its root
is the step's length in standard deviations, and by how much steps shrink tells what the last one leaves
(Deuflhard, Newton Methods for Nonlinear Problems, 2004). Not here: where to start.
"""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property

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
from service.core.vision.side_by_side import chosen, row, rows, side_by_side
from service.core.vision.transforms import Array
from service.core.vision.view_stack import ViewStack

DISTANCE_TO_OPTIMUM_SD = 1e-3
SMALLEST_SIGMA_PX = 1e-7
FIRST_DAMPING = 3e-5
LARGEST_DAMPING = 1e9
LEAST_DAMPING = 1e-6  # as long as no step was refused, less is none
FIRST_RAISED = 1e-9  # where there was none
SURE_SHRINKAGE = 0.25  # of one step to the next: what shrinks so fast goes on to


@dataclass(frozen=True)
class Fit:
    """Where a solve ended, after how many steps, and whether that is proven to be an optimum.

    linearised: the equations before the step that proved it, which is taken (None: no step did). Where that
    led beyond the fold, the optimum is at the fold itself; `stood`, before the step, is feasible.
    """

    estimate: Estimate
    stood: Estimate
    linearised: NormalEquations
    step: Step | None
    iterations: int
    converged: bool

    @cached_property
    def equations(self) -> NormalEquations:
        """The equations at the end: what a linear model makes of those before the step."""
        return self.linearised.after(self.step) if self.step else self.linearised


def minimise(
    lens: str,
    stack: ViewStack,
    starts: Sequence[Estimate | None],
    free: NDArray[np.intp],
    *,
    iterations: int = 200,
    damping: float = FIRST_DAMPING,
    distance_sd: float = DISTANCE_TO_OPTIMUM_SD,
    may_fold: bool = False,
) -> list[Fit | None]:
    """Minimise the squared reprojection errors over the free parameters (indices) and all poses.

    damping: the first one; none where the start is known to be near, so that the first step is Newton's.
    distance_sd: how near to the optimum is near enough. may_fold: the way, but not the end, may lead beyond
    the fold of the lens. Returns the end of each start; None where there is no start, or the start or the end
    is not feasible: a corner is behind the camera or beyond the fold.
    """
    task = _Task(lens, stack, free, distance_sd, may_fold)
    fits: list[Fit | None] = [None] * len(starts)
    given = [i for i, start in enumerate(starts) if start is not None]
    if not given:
        return fits
    here = side_by_side([start for start in starts if start is not None])
    able = np.flatnonzero(task.allows(here)).tolist()
    if able:
        walkers = [_Walker(given[i], damping) for i in able]
        for number, end in _descend(task, rows(here, able), walkers, iterations):
            is_before_fold = not may_fold or is_feasible(lens, end.estimate, stack.visible_points)
            fits[number] = end if is_before_fold else None
    return fits


@dataclass(frozen=True)
class _Task:
    lens: str
    stack: ViewStack
    free: NDArray[np.intp]
    distance_sd: float
    may_fold: bool

    def allows(self, estimate: Estimate) -> NDArray[np.bool_]:
        """Whether one may stand at an estimate: ()."""
        return is_feasible(self.lens, estimate, self.stack.visible_points, self.may_fold)

    def linearise(self, estimate: Estimate) -> NormalEquations:
        """Return the normal equations at an estimate."""
        return linearise(self.lens, self.stack, estimate, self.free)

    def moved(self, estimate: Estimate, step: Step) -> Estimate:
        """Return estimates after a step each, fixed parameters as they are."""
        parameters = np.zeros_like(estimate.vector)
        parameters[:, self.free] = step.parameters
        return estimate.moved(parameters, step.poses)

    def variance(self, equations: NormalEquations) -> Array:
        """Return the variance of a corner coordinate (s,), px², as the residuals tell it."""
        unknowns = len(self.free) + 6 * equations.mixed.shape[-3]
        freedom = max(self.stack.measurements - unknowns, 1)
        return np.asarray(np.maximum(equations.cost / freedom, SMALLEST_SIGMA_PX**2))


@dataclass
class _Walker:
    """One of the solves: which start it came from, its damping, and whether a step of it was refused.

    length_sd: of the step before; zero where that was damped or refused.
    """

    number: int
    damping: float
    is_wary: bool = False
    length_sd: float = 0.0

    def learn(self, gain: float, length_sd: float) -> None:
        """Choose the next damping after a step of a length with this share of the promised decrease."""
        self.length_sd = length_sd if gain > 0 and self.damping <= LEAST_DAMPING else 0.0
        if gain <= 0:
            self.damping, self.is_wary = 8.0 * (self.damping or FIRST_RAISED), True
        elif gain <= 0.25:
            self.damping = 3.0 * (self.damping or FIRST_RAISED)
        elif gain > 0.75:
            self.damping *= 0.05 if self.is_wary else 0.01
            if not self.is_wary and self.damping < LEAST_DAMPING:
                self.damping = 0.0

    def is_sure(self, length_sd: float, distance_sd: float) -> bool:
        """Whether a step is so much shorter than the one before that what it leaves is near enough."""
        if self.damping > 0.0 or not length_sd < SURE_SHRINKAGE * self.length_sd:
            return False
        shrinkage = length_sd / self.length_sd
        return length_sd * shrinkage / (1.0 - shrinkage) <= distance_sd


def _descend(
    task: _Task, here: Estimate, walkers: Sequence[_Walker], iterations: int
) -> list[tuple[int, Fit]]:
    """Take steps from feasible estimates until the optima are proven or nothing helps any more."""
    ends: list[tuple[int, Fit]] = []
    equations = task.linearise(here)
    for iteration in range(iterations):
        step, lengths_sd, is_proven = _steps(task, equations, walkers)
        moved = task.moved(here, step)
        left = []
        for i, walker in enumerate(walkers):
            if is_proven[i]:
                taken = row(step, i), iteration
                end = Fit(row(moved, i), row(here, i), row(equations, i), *taken, converged=True)
                ends.append((walker.number, end))
            elif walker.damping > LARGEST_DAMPING:
                ends.append((walker.number, _unproven(here, equations, i, iteration)))
            else:
                left.append(i)
        if not left:
            return ends
        if len(left) < len(walkers):
            walkers, lengths_sd = [walkers[i] for i in left], lengths_sd[left]
            here, equations = rows(here, left), rows(equations, left)
            moved, step = rows(moved, left), rows(step, left)
        here, equations, gains = _advance(task, here, equations, moved, step.promised)
        for walker, gain, length_sd in zip(walkers, gains.tolist(), lengths_sd.tolist(), strict=True):
            walker.learn(gain, length_sd)
    return ends + [
        (walker.number, _unproven(here, equations, i, iterations)) for i, walker in enumerate(walkers)
    ]


def _unproven(here: Estimate, equations: NormalEquations, index: int, iterations: int) -> Fit:
    """Return where one of the solves stands, as its end."""
    stands = row(here, index)
    return Fit(stands, stands, row(equations, index), None, iterations, converged=False)


def _steps(
    task: _Task, equations: NormalEquations, walkers: Sequence[_Walker]
) -> tuple[Step, Array, list[bool]]:
    """Return the damped steps, their lengths (s,), sd, and which of them prove the optimum.

    Those that are undamped, and short or so much shorter than the one before that what they leave is. Damping
    hides slopes along weak directions: what is damped and short is looked at again without.
    """
    damping = np.array([walker.damping for walker in walkers])
    step, variance = _solved(equations, damping), task.variance(equations)
    lengths = np.sqrt(step.promised / variance)
    near = lengths <= task.distance_sd
    if np.any(near & (damping > 0.0)):
        newton = _solved(equations, np.zeros_like(damping))
        near &= newton.promised <= task.distance_sd**2 * variance
        step = chosen(near, newton, step)
    sure = [
        walker.is_sure(length, task.distance_sd)
        for walker, length in zip(walkers, lengths.tolist(), strict=True)
    ]
    return step, lengths, (near | sure).tolist()


def _advance(
    task: _Task, here: Estimate, equations: NormalEquations, moved: Estimate, promised: Array
) -> tuple[Estimate, NormalEquations, Array]:
    """Return estimates and their equations after the steps that help, and the shares (s,) that these gained.

    moved: estimates after the steps. promised: the decrease, px², that each step promises.
    """
    possible = task.allows(moved) & (promised < np.inf)
    after = task.linearise(chosen(possible, moved, here))
    gains = np.where(possible, (equations.cost - after.cost) / promised, -1.0)
    better = gains > 0.0
    return chosen(better, moved, here), chosen(better, after, equations), gains


def _solved(equations: NormalEquations, damping: Array) -> Step:
    """Return the steps at a damping (s,) each; where one is undetermined it promises infinity."""
    try:
        step = solve_step(equations, damping)
    except np.linalg.LinAlgError:
        step = _one_by_one(equations, damping)
    sound = step.promised >= 0.0
    return step if sound.all() else replace(step, promised=np.where(sound, step.promised, np.inf))


def _one_by_one(equations: NormalEquations, damping: Array) -> Step:
    """Return the steps (s,), nothing for those that are undetermined."""
    s, v, _, columns = equations.mixed.shape
    step = Step(np.zeros((s, columns - 1)), np.zeros((s, v, 6)), np.full(s, np.inf))
    for i in range(s):
        with suppress(np.linalg.LinAlgError):
            one = solve_step(row(equations, i), damping[i])
            step.parameters[i], step.poses[i], step.promised[i] = one.parameters, one.poses, one.promised
    return step
