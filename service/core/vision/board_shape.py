"""The true shape of one plate, learnt from the corners of many runs: a plate is never flat.

Every corner is released in all three directions and estimated together with each run's camera and each view's
pose; the released-object method of Strobl and Hirzinger (ICCV Workshops 2011), pooled over runs. A solve per
run with the shape held, then a Gauss–Newton step of the shape from which poses and cameras are eliminated, in
turns. A similarity of the plate (where it is, how it is turned, how large it is) shows in no picture and is
taken out; a weak prior holds what the views hardly determine. Not here: what a shape is worth (`quality`).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from service.core.vision.calibration import CalibrationResult, View, calibrate_intrinsics
from service.core.vision.camera import Intrinsics, parameter_names, project_with_jacobians
from service.core.vision.transforms import Array, stack_poses

PRIOR_HEIGHT_M = 2e-3  # sd of a corner's height, far beyond any plate's
PRIOR_IN_PLANE_M = 2e-4  # and of its place in the plane: patterns are printed better than plates are flat
ITERATIONS = 6
SMALL_STEP_M = 1e-7
SMALLEST_SIGMA_PX = 1e-3


@dataclass(frozen=True)
class ShapeRun:
    """What a run tells about the plate: corner ids (n,) and image points (n, 2) px by view, and its camera.

    nominal: where the solve of the camera starts. fixed: names of parameters that are not estimated.
    """

    corner_ids: tuple[NDArray[np.int64], ...]
    image_points: tuple[Array, ...]
    nominal: Intrinsics
    fixed: tuple[str, ...] = ()


@dataclass(frozen=True)
class BoardShape:
    """How the corners of a plate lie off the pattern's: deviations (n, 3) m and their covariance (3n, 3n).

    sigma_flat_px, sigma_px: noise of the corners about the solves with the pattern as it is meant, and with
    the shape; root of the mean over runs.
    """

    deviations: Array
    covariance: Array
    sigma_flat_px: float
    sigma_px: float

    @property
    def sd(self) -> Array:
        """Standard deviations of the corners (n, 3), m."""
        return np.sqrt(np.maximum(np.diagonal(self.covariance), 0.0)).reshape(-1, 3)

    @property
    def bend_m(self) -> float:
        """Height of the plate, peak to peak, m."""
        return float(np.ptp(self.deviations[:, 2]))

    @property
    def in_plane_m(self) -> float:
        """Farthest that a corner is from its place within the plane, m."""
        return float(np.linalg.norm(self.deviations[:, :2], axis=1).max())


def estimate_board_shape(
    object_points: Array, runs: Sequence[ShapeRun], progress: Callable[[float], None] = lambda _: None
) -> BoardShape:
    """Return the shape of the plate whose pattern has corners object_points (n, 3) m.

    Raises what `calibrate_intrinsics` raises.
    """
    basis = _without_similarities(object_points)
    precision = np.tile(
        np.array([PRIOR_IN_PLANE_M, PRIOR_IN_PLANE_M, PRIOR_HEIGHT_M]) ** -2, len(object_points)
    )
    prior = basis.T @ (precision[:, None] * basis)
    q: Array = np.zeros(basis.shape[1])
    covariance: Array = prior
    nominals = [run.nominal for run in runs]
    sigmas: list[float] = []
    for iteration in range(ITERATIONS):
        board = object_points + (basis @ q).reshape(-1, 3)
        results = []
        for i, (run, nominal) in enumerate(zip(runs, nominals, strict=True)):
            results.append(solve_run(board, replace(run, nominal=nominal)))
            progress((iteration + (i + 1) / len(runs)) / ITERATIONS)
        M, g = _pooled(board, runs, results)
        covariance = np.asarray(np.linalg.inv(prior + basis.T @ M @ basis), dtype=np.float64)
        step = covariance @ (basis.T @ g - prior @ q)
        q += step
        nominals = [result.intrinsics for result in results]
        sigmas.append(float(np.sqrt(np.mean([result.sigma_px**2 for result in results]))))
        if np.abs(basis @ step).max() < SMALL_STEP_M:
            break
    deviations: Array = (basis @ q).reshape(-1, 3)
    return BoardShape(deviations, basis @ covariance @ basis.T, sigmas[0], sigmas[-1])


def solve_run(board: Array, run: ShapeRun) -> CalibrationResult:
    """Return the camera of a run whose plate has corners board (n, 3) m."""
    views = [View(board[i], p) for i, p in zip(run.corner_ids, run.image_points, strict=True)]
    return calibrate_intrinsics(views, run.nominal.image_size, run.nominal.lens, run.nominal, run.fixed)


def _pooled(
    board: Array, runs: Sequence[ShapeRun], results: Sequence[CalibrationResult]
) -> tuple[Array, Array]:
    """Return JᵀJ (3n, 3n) and Jᵀe (3n,) of the corners over all runs, each by its own noise."""
    information, gradient = np.zeros((board.size, board.size)), np.zeros(board.size)
    for run, result in zip(runs, results, strict=True):
        M, g = released_equations(board, run, result)
        weight = 1.0 / max(result.sigma_px, SMALLEST_SIGMA_PX) ** 2
        information += weight * M
        gradient += weight * g
    return information, gradient


def released_equations(board: Array, run: ShapeRun, result: CalibrationResult) -> tuple[Array, Array]:
    """Return what a run tells of its plate once camera and poses are eliminated: JᵀJ (3n, 3n), Jᵀe (3n,).

    board: corners (n, 3) m at which the run was solved.
    """
    whole, free = _with_camera(board, run, result)
    camera, shape = slice(0, free), slice(free, -1)
    by_camera = np.linalg.solve(whole[camera, camera], whole[camera, free:])
    reduced = whole[shape, free:] - whole[shape, camera] @ by_camera
    return reduced[:, :-1], reduced[:, -1]


def camera_by_board(board: Array, run: ShapeRun, result: CalibrationResult) -> Array:
    """Return how the parameters of a run's camera move with the corners that its plate is said to have.

    (p, 3n), to first order. board: corners (n, 3) m at which the run was solved.
    """
    whole, free = _with_camera(board, run, result)
    moves = np.zeros((len(result.intrinsics.vector), board.size))
    moves[_free(result)] = np.linalg.solve(whole[:free, :free], -whole[:free, free:-1])
    return moves


def _with_camera(board: Array, run: ShapeRun, result: CalibrationResult) -> tuple[Array, int]:
    """Return JᵀJ of free parameters, all corners (3n) and the error (1) without poses; how many are free."""
    free = _free(result)
    rotations, translations = stack_poses(result.poses)
    size = len(free) + board.size + 1
    whole = np.zeros((size, size))
    for i, (ids, image_points) in enumerate(zip(run.corner_ids, run.image_points, strict=True)):
        pixels, by_parameters, by_pose = project_with_jacobians(
            result.intrinsics.lens,
            result.intrinsics.vector,
            rotations[i : i + 1],
            translations[i : i + 1],
            board[ids],
        )
        by_corner = np.zeros((len(ids), 2, len(board), 3))
        by_corner[np.arange(len(ids)), :, ids] = by_pose[0, :, :, 3:] @ rotations[i]
        rows = np.concatenate(
            [
                by_parameters[0][..., free],
                by_corner.reshape(len(ids), 2, -1),
                (image_points - pixels[0])[..., None],
            ],
            axis=-1,
        ).reshape(-1, size)
        of_pose, _ = np.linalg.qr(by_pose[0].reshape(-1, 6))
        rows = rows - of_pose @ (of_pose.T @ rows)
        whole += rows.T @ rows
    return whole, len(free)


def _free(result: CalibrationResult) -> NDArray[np.intp]:
    names = parameter_names(result.intrinsics.lens)
    return np.array([i for i, name in enumerate(names) if name not in result.fixed], dtype=np.intp)


def _without_similarities(object_points: Array) -> Array:
    """Return an orthonormal basis (3n, 3n − 7) of changes that neither move nor turn nor scale the plate."""
    about = object_points - object_points.mean(axis=0)
    moves = [np.tile(axis, (len(about), 1)) for axis in np.eye(3)]
    turns = [np.cross(axis, about) for axis in np.eye(3)]
    seven = np.stack([change.ravel() for change in (*moves, *turns, about)], axis=1)
    full, _ = np.linalg.qr(seven, mode="complete")
    basis: Array = full[:, 7:]
    return basis
