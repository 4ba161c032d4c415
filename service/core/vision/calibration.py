"""Views in, intrinsics with their covariance out; never without saying whether the optimum is proven.

The solve runs from two starts that know nothing of each other: the SKU's nominal (without one: a sweep of
focal lengths) and blind, from the views alone. The better end is the result; it counts as converged only
where the gradient says so and both ends are the same camera. Not here: judging the result
(`service.core.quality`), detecting corners.
"""

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from service.core.errors import DegenerateViews, IntrinsicsInvalid
from service.core.vision.camera import Intrinsics, parameter_names, project
from service.core.vision.levenberg_marquardt import Fit
from service.core.vision.multi_start import (
    AGREEMENT_PX,
    Ends,
    Problem,
    solve_from_nominal,
    solve_from_starts,
)
from service.core.vision.normal_equations import NormalEquations, Reduced, reduce, unit_scale
from service.core.vision.transforms import Array, Pose, rotation_vector
from service.core.vision.view_stack import View, stack_views

__all__ = ["CalibrationResult", "StartReport", "View", "calibrate_intrinsics", "refine_intrinsics"]

LARGEST_CONDITION = 1e13


@dataclass(frozen=True)
class StartReport:
    """How the solve went from one start: `nominal`, `sweep` or `blind`."""

    name: str
    rms_px: float
    iterations: int
    converged: bool


@dataclass(frozen=True)
class CalibrationResult:
    """A solved camera.

    covariance: (p, p) in the order of parameter_names(lens), σ²(JᵀJ)⁻¹ with the fitted σ, zero where fixed.
    poses: `T_cam_board` per view. residuals: detected − projected (n, 2) px per view. equations: those of the
    free parameters at the optimum, view by view; reduced: without the poses.
    sigma_px: √(Σe²/(2N − free unknowns)). rms_px: √(Σ|e|²/N). agreement_px: the largest difference at the
    corners between the ends of the starts, inf where one of them failed. converged: the optimum is proven and
    the starts agree.
    """

    intrinsics: Intrinsics
    covariance: Array
    fixed: tuple[str, ...]
    poses: tuple[Pose, ...]
    residuals: tuple[Array, ...]
    equations: NormalEquations
    reduced: Reduced
    sigma_px: float
    rms_px: float
    starts: tuple[StartReport, ...]
    agreement_px: float
    converged: bool

    @property
    def sd(self) -> dict[str, float]:
        """Standard deviation of each parameter by name; zero where fixed."""
        deviations = np.sqrt(np.maximum(np.diagonal(self.covariance), 0.0))
        return dict(zip(parameter_names(self.intrinsics.lens), map(float, deviations), strict=True))


def calibrate_intrinsics(
    views: Sequence[View],
    image_size: tuple[int, int],
    lens: str = "pinhole5",
    nominal: Intrinsics | None = None,
    fixed: Collection[str] = (),
) -> CalibrationResult:
    """Return the camera that explains the views best.

    image_size: (width, height) px. fixed: names of parameters that are not estimated; they keep the nominal's
    value, without a nominal zero for coefficients and the middle of the image for cx, cy.
    Raises TooFewViews (fewer than three), DegenerateViews (they leave a parameter undetermined),
    IntrinsicsInvalid (a nominal of another lens or image size, an unknown fixed name, fx or fy fixed without
    a nominal).
    """
    check_request(image_size, lens, nominal, fixed)
    problem = _problem(views, image_size, lens, nominal, fixed)
    return _best_result(problem, solve_from_starts(problem), fixed)


def refine_intrinsics(
    views: Sequence[View], nominal: Intrinsics, fixed: Collection[str] = ()
) -> CalibrationResult:
    """Return the camera near a nominal one that explains the views best: fast, for an estimate on the way.

    One start proves no optimum, so that `converged` is False. Raises as `calibrate_intrinsics`.
    """
    check_request(nominal.image_size, nominal.lens, nominal, fixed)
    problem = _problem(views, nominal.image_size, nominal.lens, nominal, fixed)
    return _best_result(problem, solve_from_nominal(problem, nominal), fixed)


def check_request(
    image_size: tuple[int, int], lens: str, nominal: Intrinsics | None, fixed: Collection[str]
) -> None:
    """Raise IntrinsicsInvalid where a nominal or the fixed names do not fit the lens and the image."""
    names = parameter_names(lens)
    unknown = sorted(set(fixed) - set(names))
    if unknown:
        raise IntrinsicsInvalid(f"Cannot fix {', '.join(unknown)}; this lens has {', '.join(names)}.")
    if nominal is None and {"fx", "fy"} & set(fixed):
        raise IntrinsicsInvalid(
            "Give nominal intrinsics to fix fx or fy at; without them they must be estimated."
        )
    if nominal is not None and (nominal.lens, tuple(nominal.image_size)) != (lens, tuple(image_size)):
        raise IntrinsicsInvalid(
            f"The nominal is a {nominal.lens} lens at {nominal.image_size[0]}x{nominal.image_size[1]} px, "
            f"the views are {lens} at {image_size[0]}x{image_size[1]} px; give the nominal of this camera."
        )


def _problem(
    views: Sequence[View],
    image_size: tuple[int, int],
    lens: str,
    nominal: Intrinsics | None,
    fixed: Collection[str],
) -> Problem:
    free = [i for i, name in enumerate(parameter_names(lens)) if name not in fixed]
    return Problem(lens, image_size, stack_views(views), np.array(free, dtype=np.intp), nominal)


def _best_result(problem: Problem, ends: Ends, fixed: Collection[str]) -> CalibrationResult:
    """Return the public result of the end of least cost; DegenerateViews where there is none."""
    solved = [fit for fit in ends.fits.values() if fit]
    if not solved:
        raise DegenerateViews(
            "No camera of this lens can see the views; check the target and the lens model."
        )
    best = min(solved, key=lambda fit: float(fit.equations.cost))
    return _result(problem, best, ends, tuple(n for n in parameter_names(problem.lens) if n in fixed))


def _result(problem: Problem, best: Fit, ends: Ends, fixed: tuple[str, ...]) -> CalibrationResult:
    """Return the public result of the best fit."""
    stack, estimate = problem.stack, best.estimate
    intrinsics = problem.intrinsics(estimate.vector)
    unknowns = len(problem.free) + 6 * len(stack.counts)
    variance = float(best.equations.cost) / max(stack.measurements - unknowns, 1)
    pixels = project(intrinsics, estimate.rotations, estimate.translations, stack.object_points)
    errors = stack.image_points - pixels
    cofactor, reduced = _cofactor(problem, best)
    return CalibrationResult(
        intrinsics=intrinsics,
        covariance=variance * cofactor,
        fixed=fixed,
        poses=tuple(
            Pose(*pair)
            for pair in zip(rotation_vector(estimate.rotations), estimate.translations, strict=True)
        ),
        residuals=tuple(error[:count] for error, count in zip(errors, stack.counts, strict=True)),
        equations=best.equations,
        reduced=reduced,
        sigma_px=float(np.sqrt(variance)),
        rms_px=_rms(problem, best),
        starts=tuple(_report(problem, name, fit) for name, fit in ends.fits.items()),
        agreement_px=ends.agreement_px,
        converged=best.converged and ends.agreement_px <= AGREEMENT_PX,
    )


def _report(problem: Problem, name: str, fit: Fit | None) -> StartReport:
    """Return how the solve went from a start; its rms is inf where no solve was possible."""
    if fit is None:
        return StartReport(name, float("inf"), 0, converged=False)
    return StartReport(name, _rms(problem, fit), fit.iterations, fit.converged)


def _rms(problem: Problem, fit: Fit) -> float:
    """Return √(Σ|e|²/N) px of a fit."""
    return float(np.sqrt(float(fit.equations.cost) / sum(problem.stack.counts)))


def _cofactor(problem: Problem, fit: Fit) -> tuple[Array, Reduced]:
    """Return (JᵀJ)⁻¹ of the parameters (p, p), zero where fixed, and its parts, or raise DegenerateViews."""
    cofactor = np.zeros((len(parameter_names(problem.lens)),) * 2)
    try:
        reduced = reduce(fit.equations)
        cofactor[np.ix_(problem.free, problem.free)] = _inverse(reduced.information.sum(axis=0))
    except np.linalg.LinAlgError as error:
        raise DegenerateViews(
            "The views do not determine all parameters; add views with the target tilted in different "
            "directions, near and far, all over the image, or fix the parameters that are not needed."
        ) from error
    return cofactor, reduced


def _inverse(information: Array) -> Array:
    """Return the inverse of an information matrix, or raise LinAlgError where rounding alone fills it."""
    scale = unit_scale(information)
    scaled = information * np.outer(scale, scale)
    if np.linalg.cond(scaled) > LARGEST_CONDITION:
        raise np.linalg.LinAlgError("the information is singular")
    inverse: Array = np.linalg.inv(scaled) * np.outer(scale, scale)
    return inverse
