"""A solve from starts that know nothing of each other, so that a false optimum shows.

From each start the solve runs on a few corners of each view first, which is cheap and ends close to the
optimum, then on all of them. Not here: how a start is found (`calibration_start`), what becomes of the ends
(`calibration`).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from service.core.vision.calibration_start import blind_start, nominal_start, sweep_starts
from service.core.vision.camera import Intrinsics
from service.core.vision.levenberg_marquardt import Fit, minimise
from service.core.vision.normal_equations import Estimate
from service.core.vision.transforms import Array
from service.core.vision.uncertainty import mapping_difference, whole_image
from service.core.vision.view_stack import ViewStack

AGREEMENT_PX = 0.05
THINNED_CORNERS = 16
THINNED_ITERATIONS = 60


@dataclass(frozen=True)
class Problem:
    """What is to be solved: views of one camera, its free parameters (indices), its nominal if any."""

    lens: str
    image_size: tuple[int, int]
    stack: ViewStack
    free: NDArray[np.intp]
    nominal: Intrinsics | None

    def intrinsics(self, vector: Array) -> Intrinsics:
        """Return the intrinsics of a parameter vector (p,)."""
        return Intrinsics.from_vector(self.lens, vector, self.image_size)


def solve_from_starts(problem: Problem) -> Mapping[str, Fit | None]:
    """Return the ends by the names of their starts: `nominal` or, without one, `sweep`; and `blind`.

    Where blind and nominal end at different cameras, the sweep decides whether blind was merely unlucky.
    """
    blind = _from_blind(problem)
    if problem.nominal is None:
        return {"sweep": _from_sweep(problem), "blind": blind}
    nominal = _solve(problem, nominal_start(problem.nominal, problem.stack))
    if not (nominal and blind and largest_difference(problem, [nominal, blind]) <= AGREEMENT_PX):
        blind = _cheapest([fit for fit in (blind, _from_sweep(problem)) if fit])
    return {"nominal": nominal, "blind": blind}


def largest_difference(problem: Problem, fits: Sequence[Fit]) -> float:
    """Return the largest difference over the image, px, between fits; inf where they share no pixel."""
    largest = 0.0
    grid = whole_image(problem.image_size)
    cameras = [problem.intrinsics(fit.estimate.vector) for fit in fits]
    for a, b in pairwise(cameras):
        difference = mapping_difference(a, b, grid)
        shared = difference[np.isfinite(difference)]
        largest = max(largest, float(shared.max()) if shared.size else float("inf"))
    return largest


def _from_blind(problem: Problem) -> Fit | None:
    start = blind_start(problem.lens, problem.image_size, problem.stack)
    return None if start is None else _solve(problem, start)


def _from_sweep(problem: Problem) -> Fit | None:
    """Return the end of the start whose solve on a few corners is the best of the sweep."""
    thinned = problem.stack.thinned(THINNED_CORNERS)
    starts = [_held(problem, start) for start in sweep_starts(problem.lens, problem.image_size, thinned)]
    fits = [minimise(problem.lens, thinned, start, problem.free, THINNED_ITERATIONS) for start in starts]
    best = _cheapest([fit for fit in fits if fit])
    return None if best is None else _solve(problem, best.estimate)


def _cheapest(fits: Sequence[Fit]) -> Fit | None:
    return min(fits, key=lambda fit: fit.equations.cost, default=None)


def _solve(problem: Problem, start: Estimate) -> Fit | None:
    """Solve on a few corners, then on all; None where the start is not feasible."""
    start = _held(problem, start)
    coarse = minimise(
        problem.lens, problem.stack.thinned(THINNED_CORNERS), start, problem.free, THINNED_ITERATIONS
    )
    fine = minimise(problem.lens, problem.stack, coarse.estimate, problem.free) if coarse else None
    return fine or minimise(problem.lens, problem.stack, start, problem.free)


def _held(problem: Problem, start: Estimate) -> Estimate:
    """Return the start with the fixed parameters at the values they are to keep."""
    vector = np.zeros_like(start.vector)
    vector[2:4] = (np.array(problem.image_size) - 1) / 2.0
    if problem.nominal is not None:
        vector = problem.nominal.vector.copy()
    vector[problem.free] = start.vector[problem.free]
    return Estimate(vector, start.rotations, start.translations)
