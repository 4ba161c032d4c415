"""The minimiser: it proves optima, refuses impossible starts, and says when it did not arrive."""

import numpy as np

from service.core.vision.blind_start import blind_start
from service.core.vision.calibration_start import nominal_start
from service.core.vision.levenberg_marquardt import minimise
from service.core.vision.normal_equations import Estimate, is_feasible, linearise, reduce, solve_step
from service.core.vision.view_stack import stack_views
from tests.core.vision.cameras import LENS1, WIDE, board_poses, views_of

ALL = np.arange(9)


def test_at_a_proven_optimum_a_newton_step_moves_nothing_that_matters() -> None:
    stack = stack_views(views_of(LENS1, 10, seed=1))
    (fit,) = minimise("pinhole5", stack, [nominal_start(LENS1, stack)], ALL)
    assert fit is not None
    assert fit.converged
    step = solve_step(linearise("pinhole5", stack, fit.estimate, ALL))
    sd = 0.1 * np.sqrt(np.diagonal(np.linalg.inv(reduce(fit.equations).information.sum(axis=0))))
    assert np.abs(step.parameters / sd).max() < 1e-4


def test_too_few_iterations_are_not_called_convergence() -> None:
    stack = stack_views(views_of(WIDE, 10, seed=2))
    start = blind_start("pinhole5", WIDE.image_size, stack)
    assert start is not None
    (fit,) = minimise("pinhole5", stack, [start], ALL, iterations=2)
    assert fit is not None
    assert not fit.converged


def test_a_start_with_a_board_behind_the_camera_is_refused() -> None:
    stack = stack_views(views_of(LENS1, 5, seed=3))
    start = nominal_start(LENS1, stack)
    behind = Estimate(start.vector, start.rotations, start.translations * [1.0, 1.0, -1.0])
    assert minimise("pinhole5", stack, [behind], ALL) == [None]


def test_a_corner_beyond_the_fold_is_not_feasible_unless_it_may_be() -> None:
    rotations, translations = board_poses(WIDE, 5, seed=4)
    points = stack_views(views_of(WIDE, 5, seed=4)).object_points
    folding = Estimate(np.r_[WIDE.vector[:4], -0.6, 0.0, 0.0, 0.0, 0.0], rotations, translations)
    assert is_feasible("pinhole5", Estimate(WIDE.vector, rotations, translations), points)
    assert not is_feasible("pinhole5", folding, points)
    assert is_feasible("pinhole5", folding, points, may_fold=True)


def test_a_way_through_the_fold_must_end_before_it() -> None:
    stack = stack_views(views_of(WIDE, 12, seed=5))
    rotations, translations = board_poses(WIDE, 12, seed=5)
    folding = Estimate(np.r_[WIDE.vector[:4], -0.5, 0.0, 0.0, 0.0, 0.0], rotations, translations)
    assert minimise("pinhole5", stack, [folding], ALL) == [None]
    (fit,) = minimise("pinhole5", stack, [folding], ALL, may_fold=True)
    assert fit is None or is_feasible("pinhole5", fit.estimate, stack.object_points)


def test_starts_side_by_side_end_where_each_ends_alone() -> None:
    stack = stack_views(views_of(WIDE, 12, seed=6))
    near, blind = nominal_start(WIDE, stack), blind_start("pinhole5", WIDE.image_size, stack)
    together = minimise("pinhole5", stack, [near, None, blind], ALL)
    assert together[1] is None
    for start, end in ((near, together[0]), (blind, together[2])):
        (alone,) = minimise("pinhole5", stack, [start], ALL)
        assert alone is not None
        assert end is not None
        assert (end.converged, end.iterations) == (alone.converged, alone.iterations)
        np.testing.assert_allclose(end.estimate.vector, alone.estimate.vector, rtol=1e-9)


def test_what_the_last_step_leaves_is_what_a_look_from_there_finds() -> None:
    stack = stack_views(views_of(LENS1, 10, seed=7))
    (fit,) = minimise("pinhole5", stack, [nominal_start(LENS1, stack)], ALL)
    assert fit is not None
    looked = linearise("pinhole5", stack, fit.estimate, ALL)
    np.testing.assert_allclose(fit.equations.squared_errors, looked.squared_errors, rtol=1e-4)
    kept, fresh = (reduce(equations).information.sum(axis=0) for equations in (fit.equations, looked))
    np.testing.assert_allclose(
        kept, fresh, rtol=1e-3, atol=1e-3 * np.sqrt(np.outer(*2 * [np.diagonal(fresh)])).max()
    )
