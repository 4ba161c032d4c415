"""A solve from starts that know nothing of each other, so that a false optimum shows.

From each start the solve runs on a few corners of each view first, which is cheap and ends close to the
optimum. Where those ends are one camera, the last steps on all corners are taken once, for from there both
would be the same; where they are not, each start is solved on all corners. Not here: how a start is found
(`calibration_start`), what becomes of the ends (`calibration`).
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from service.core.vision.blind_start import blind_start
from service.core.vision.calibration_start import nominal_start, sweep_starts
from service.core.vision.camera import LENSES, Intrinsics, parameter_names
from service.core.vision.levenberg_marquardt import Fit, minimise
from service.core.vision.normal_equations import Estimate
from service.core.vision.transforms import Array, turn_points
from service.core.vision.uncertainty import difference_of_rays
from service.core.vision.view_stack import ViewStack

AGREEMENT_PX = 0.05
THINNED_CORNERS = 16
# The optimum of a few corners is itself several sd of all unknowns away from that of all corners.
COARSE_DISTANCE_SD = 0.3
# On the way an estimate is shown, and must come soon: where it takes longer, too few views determine it.
QUICK_STEPS = 15
QUICK_DISTANCE_SD = 0.01
FIRST_PARAMETERS = (0, 1, 4)
COMPARED_CORNERS = 5  # of each view at least


@dataclass(frozen=True)
class Problem:
    """What is to be solved: views of one camera, its free parameters (indices), its nominal if any."""

    lens: str
    image_size: tuple[int, int]
    stack: ViewStack
    free: NDArray[np.intp]
    nominal: Intrinsics | None

    @cached_property
    def weak(self) -> NDArray[np.intp]:
        """The free parameters that a few corners hardly determine."""
        return np.array([i for i in self.free if self._is_weak(i)], dtype=np.intp)

    @cached_property
    def firm(self) -> NDArray[np.intp]:
        """The other free parameters."""
        return np.array([i for i in self.free if not self._is_weak(i)], dtype=np.intp)

    def _is_weak(self, index: int) -> bool:
        return parameter_names(self.lens)[index] in LENSES[self.lens].weak

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
    blind = blind_start(problem.lens, problem.image_size, thinned)
    if problem.nominal is None:
        end, *_ = _coarse(problem, thinned, [blind])
        return _finish(problem, {"sweep": _sweep(problem, thinned), "blind": end})
    if blind is not None:
        # On a few corners the weak ones stay: from other values, ends of one optimum would differ by them.
        blind.vector[problem.weak] = problem.nominal.vector[problem.weak]
    nominal, end = _coarse(problem, thinned, [nominal_start(problem.nominal, thinned), blind])
    ends = _finish(problem, {"nominal": nominal, "blind": end})
    if ends.agreement_px <= AGREEMENT_PX:
        return ends
    return _finish(problem, {"nominal": nominal, "blind": _cheapest([end, _sweep(problem, thinned)])})


def solve_from_nominal(problem: Problem, nominal: Intrinsics) -> Ends:
    """Return the end of the start `nominal` alone, near enough to be shown; with nothing to agree with it."""
    thinned = problem.stack.thinned(THINNED_CORNERS)
    start = _held(problem, nominal_start(nominal, thinned))
    quick = partial(minimise, iterations=QUICK_STEPS)
    (coarse,) = quick(problem.lens, thinned, [start], problem.firm, distance_sd=COARSE_DISTANCE_SD)
    (fine,) = _fine(problem, [coarse], partial(quick, distance_sd=QUICK_DISTANCE_SD))
    return Ends({"nominal": _counted(fine, coarse)}, float("inf"))


def _sweep(problem: Problem, thinned: ViewStack) -> Fit | None:
    """Return the end of a sweep of focal lengths on a few corners: the most promising until one is proven."""
    starts = sweep_starts(problem.lens, problem.image_size, thinned)
    ahead = _ahead(problem, thinned, starts)
    ends: list[Fit | None] = []
    for fit in sorted((fit for fit in ahead if fit), key=lambda fit: float(fit.equations.cost)):
        end, *_ = _coarse(problem, thinned, [fit.estimate])
        ends.append(end)
        if end and end.converged:
            break
    return _cheapest(ends)


def _ahead(problem: Problem, thinned: ViewStack, starts: Sequence[Estimate]) -> list[Fit | None]:
    """Return starts with their focal length and first coefficient improved."""
    first = np.intersect1d(problem.free, FIRST_PARAMETERS)
    return minimise(problem.lens, thinned, [_held(problem, start) for start in starts], first, iterations=12)


def _coarse(problem: Problem, thinned: ViewStack, starts: Sequence[Estimate | None]) -> list[Fit | None]:
    """Return the ends of starts on a few corners of each view.

    Where one sticks at the fold of the lens, it is tried again on a path that may lead through the fold.
    """
    held = [_held(problem, start) if start else None for start in starts]
    solve = partial(
        minimise, problem.lens, thinned, free=problem.firm, iterations=60, distance_sd=COARSE_DISTANCE_SD
    )
    ends = solve(held)
    stuck = [start if not (end and end.converged) else None for start, end in zip(held, ends, strict=True)]
    if not any(stuck):
        return ends
    through = solve(stuck, may_fold=True)
    return [
        folded if folded and folded.converged else _cheapest([end, folded])
        for end, folded in zip(ends, through, strict=True)
    ]


def _cheapest(fits: Sequence[Fit | None]) -> Fit | None:
    """Return the fit of least cost; None where there is none."""
    return min((fit for fit in fits if fit), key=lambda fit: float(fit.equations.cost), default=None)


def _finish(problem: Problem, coarse: Mapping[str, Fit | None]) -> Ends:
    """Return the ends on all corners of the ends on a few."""
    agreement = _largest_difference(problem, coarse)
    if agreement <= AGREEMENT_PX:
        (common,) = _fine(problem, list(coarse.values())[:1])
        return Ends({name: _counted(common, fit) for name, fit in coarse.items()}, agreement)
    ends = _fine(problem, list(coarse.values()))
    fits = {name: _counted(end, fit) for (name, fit), end in zip(coarse.items(), ends, strict=True)}
    return Ends(fits, _largest_difference(problem, fits))


def _fine(
    problem: Problem, near: Sequence[Fit | None], solver: Callable[..., list[Fit | None]] = minimise
) -> list[Fit | None]:
    """Return the ends on all corners from those on a few; None where there is none.

    solver: `minimise`, with options of its own.
    """
    solve = partial(solver, problem.lens, problem.stack, free=problem.free, damping=0.0)
    ends = solve([fit.estimate if fit else None for fit in near])
    beyond = [fit.stood if fit and not end else None for fit, end in zip(near, ends, strict=True)]
    return [end or other for end, other in zip(ends, solve(beyond), strict=True)] if any(beyond) else ends


def _counted(fit: Fit | None, coarse: Fit | None) -> Fit | None:
    """Return a fit with the steps of its coarse part added."""
    return replace(fit, iterations=fit.iterations + coarse.iterations) if fit and coarse else fit


def _largest_difference(problem: Problem, fits: Mapping[str, Fit | None]) -> float:
    """Return the largest difference of ends, px at the corners; inf without an end or a common corner.

    Where there are no corners the views say nothing: there, ends of one optimum differ as well.
    """
    ends = [fit.estimate for fit in fits.values() if fit]
    if len(ends) < len(fits):
        return float("inf")
    points = problem.stack.object_points[
        :, :: max(problem.stack.object_points.shape[1] // COMPARED_CORNERS, 1)
    ]
    rays = (turn_points(ends[0].rotations, points) + ends[0].translations[:, None]).reshape(-1, 3)
    cameras = [problem.intrinsics(end.vector) for end in ends]
    differences = np.array([difference_of_rays(a, b, rays) for a, b in combinations(cameras, 2)])
    return float(np.nanmax(differences, initial=0.0)) if np.any(np.isfinite(differences)) else float("inf")


def _held(problem: Problem, start: Estimate) -> Estimate:
    """Return the start with the fixed parameters at the values they are to keep."""
    vector = np.zeros_like(start.vector)
    vector[2:4] = (np.array(problem.image_size) - 1) / 2.0
    if problem.nominal is not None:
        vector = problem.nominal.vector.copy()
    vector[problem.free] = start.vector[problem.free]
    return Estimate(vector, start.rotations, start.translations)
