"""A solve from starts that know nothing of each other, so that a false optimum shows.

From each start the solve runs on a few corners of each view first, which is cheap and ends close to the
optimum. Where those ends are one camera, the last steps on all corners are taken once, for from there both
would be the same; where they are not, each start is solved on all corners. Not here: how a start is found
(`calibration_start`), what becomes of the ends (`calibration`).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from service.core.vision.calibration_start import blind_start, nominal_start, sweep_starts
from service.core.vision.camera import LENSES, Intrinsics, parameter_names
from service.core.vision.levenberg_marquardt import Fit, minimise
from service.core.vision.normal_equations import Estimate
from service.core.vision.transforms import Array
from service.core.vision.uncertainty import mapping_difference, whole_image
from service.core.vision.view_stack import ViewStack

AGREEMENT_PX = 0.05
THINNED_CORNERS = 16
DAMPING_NEAR_OPTIMUM = 1e-9
# The optimum of a few corners is itself several sd of all unknowns away from that of all corners.
COARSE_DISTANCE_SD = 0.03
# On the way an estimate is shown, and must come soon: where it takes longer, too few views determine it.
QUICK_STEPS = 15
QUICK_DISTANCE_SD = 0.01
FIRST_PARAMETERS = (0, 1, 4)


@dataclass(frozen=True)
class Problem:
    """What is to be solved: views of one camera, its free parameters (indices), its nominal if any."""

    lens: str
    image_size: tuple[int, int]
    stack: ViewStack
    free: NDArray[np.intp]
    nominal: Intrinsics | None

    @property
    def firm(self) -> NDArray[np.intp]:
        """The free parameters that a few corners determine."""
        weak = [i for i, name in enumerate(parameter_names(self.lens)) if name in LENSES[self.lens].weak]
        return np.setdiff1d(self.free, weak)

    def intrinsics(self, vector: Array) -> Intrinsics:
        """Return the intrinsics of a parameter vector (p,)."""
        return Intrinsics.from_vector(self.lens, vector, self.image_size)


@dataclass(frozen=True)
class Ends:
    """Where the solve ended by the name of each start (None: nowhere), and how far apart the ends are."""

    fits: Mapping[str, Fit | None]
    agreement_px: float


def solve_from_starts(problem: Problem) -> Ends:
    """Return the ends of the starts `nominal` or, without one, `sweep`; and `blind`.

    agreement_px is inf where a start gave no end. Where blind and nominal end at different cameras, the sweep
    decides whether blind was merely unlucky.
    """
    thinned = problem.stack.thinned(THINNED_CORNERS)
    blind = _coarse(problem, thinned, blind_start(problem.lens, problem.image_size, thinned))
    if problem.nominal is None:
        return _finish(problem, {"sweep": _sweep(problem, thinned), "blind": blind})
    nominal = _coarse(problem, thinned, nominal_start(problem.nominal, thinned))
    ends = _finish(problem, {"nominal": nominal, "blind": blind})
    if ends.agreement_px <= AGREEMENT_PX:
        return ends
    return _finish(problem, {"nominal": nominal, "blind": _cheapest([blind, _sweep(problem, thinned)])})


def solve_from_nominal(problem: Problem, nominal: Intrinsics) -> Ends:
    """Return the end of the start `nominal` alone, near enough to be shown; with nothing to agree with it."""
    thinned = problem.stack.thinned(THINNED_CORNERS)
    start = _held(problem, nominal_start(nominal, thinned))
    quick = partial(minimise, problem.lens, iterations=QUICK_STEPS)
    coarse = quick(thinned, start, problem.firm, distance_sd=COARSE_DISTANCE_SD)
    near = coarse and quick(
        problem.stack,
        coarse.estimate,
        problem.free,
        damping=DAMPING_NEAR_OPTIMUM,
        distance_sd=QUICK_DISTANCE_SD,
    )
    return Ends({"nominal": _counted(near, coarse)}, float("inf"))


def _sweep(problem: Problem, thinned: ViewStack) -> Fit | None:
    """Return the end of a sweep of focal lengths on a few corners: the most promising until one is proven."""
    starts = sweep_starts(problem.lens, problem.image_size, thinned)
    ahead = [_ahead(problem, thinned, start) for start in starts]
    ends: list[Fit | None] = []
    for fit in sorted((fit for fit in ahead if fit), key=lambda fit: fit.equations.cost):
        end = _coarse(problem, thinned, fit.estimate)
        ends.append(end)
        if end and end.converged:
            break
    return _cheapest(ends)


def _ahead(problem: Problem, thinned: ViewStack, start: Estimate) -> Fit | None:
    """Return a start with its focal length and first coefficient improved."""
    first = np.intersect1d(problem.free, FIRST_PARAMETERS)
    return minimise(problem.lens, thinned, _held(problem, start), first, iterations=12)


def _coarse(problem: Problem, thinned: ViewStack, start: Estimate | None) -> Fit | None:
    """Return the end of a start on a few corners of each view.

    Where it sticks at the fold of the lens, it is tried again on a path that may lead through the fold.
    """
    if start is None:
        return None
    start = _held(problem, start)
    solve = partial(
        minimise, problem.lens, thinned, start, problem.firm, iterations=60, distance_sd=COARSE_DISTANCE_SD
    )
    direct = solve()
    if direct and direct.converged:
        return _arrived(problem, direct)
    through = solve(may_fold=True)
    return _arrived(problem, through) if through and through.converged else _cheapest([direct, through])


def _arrived(problem: Problem, fit: Fit) -> Fit:
    """Return a proven fit with the step of its proof taken, so that ends can be told apart to a hair."""
    if fit.proof is None:
        return fit
    step = np.zeros_like(fit.estimate.vector)
    step[problem.firm] = fit.proof.parameters
    return replace(fit, estimate=fit.estimate.moved(step, fit.proof.poses))


def _cheapest(fits: Sequence[Fit | None]) -> Fit | None:
    """Return the fit of least cost; None where there is none."""
    return min((fit for fit in fits if fit), key=lambda fit: fit.equations.cost, default=None)


def _finish(problem: Problem, coarse: Mapping[str, Fit | None]) -> Ends:
    """Return the ends on all corners of the ends on a few."""
    agreement = _largest_difference(problem, coarse)
    if agreement <= AGREEMENT_PX:
        common = _fine(problem, next(iter(coarse.values())))
        return Ends({name: _counted(common, fit) for name, fit in coarse.items()}, agreement)
    fits = {name: _counted(_fine(problem, fit), fit) for name, fit in coarse.items()}
    return Ends(fits, _largest_difference(problem, fits))


def _fine(problem: Problem, near: Fit | None) -> Fit | None:
    """Return the end on all corners; None where the lens cannot show them all from there."""
    if near is None:
        return None
    return minimise(problem.lens, problem.stack, near.estimate, problem.free, damping=DAMPING_NEAR_OPTIMUM)


def _counted(fit: Fit | None, coarse: Fit | None) -> Fit | None:
    """Return a fit with the steps of its coarse part added."""
    return replace(fit, iterations=fit.iterations + coarse.iterations) if fit and coarse else fit


def _largest_difference(problem: Problem, fits: Mapping[str, Fit | None]) -> float:
    """Return the largest difference of ends, px over the image; inf without an end or a common pixel."""
    cameras = [problem.intrinsics(fit.estimate.vector) for fit in fits.values() if fit]
    if len(cameras) < len(fits):
        return float("inf")
    grid = whole_image(problem.image_size)
    differences = np.array([mapping_difference(a, b, grid) for a, b in combinations(cameras, 2)])
    return float(np.nanmax(differences, initial=0.0)) if np.any(np.isfinite(differences)) else float("inf")


def _held(problem: Problem, start: Estimate) -> Estimate:
    """Return the start with the fixed parameters at the values they are to keep."""
    vector = np.zeros_like(start.vector)
    vector[2:4] = (np.array(problem.image_size) - 1) / 2.0
    if problem.nominal is not None:
        vector = problem.nominal.vector.copy()
    vector[problem.free] = start.vector[problem.free]
    return Estimate(vector, start.rotations, start.translations)
