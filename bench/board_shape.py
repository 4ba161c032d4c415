"""Learning the shape of a plate: how near it comes, and what the plate does to cameras without and with it.

Computed corners of planned poses: cameras of Lens 1, a 9x6 board of 25 mm that is bowed, twisted, or both and
badly printed. Not here: rendered pictures, real boards.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from bench.gate_faults import BOARD, NOMINAL, SEED, poses
from service.core.vision.board_shape import BoardShape, ShapeRun, estimate_board_shape, solve_run
from service.core.vision.camera import Intrinsics, project
from service.core.vision.tolerance import Tolerance, draw_camera
from service.core.vision.transforms import Array

SIGMA_PX = 0.1
HAND_M = 0.003
PROBES = 10  # cameras, other than those that taught, that are calibrated with and without the shape
NAMES = ("fx", "fy", "cx", "cy")
POINTS = BOARD.object_points


def run(quick: bool) -> dict[str, Any]:
    """Return error of the shape and bias of the cameras, by plate and number of runs that teach."""
    counts = (5,) if quick else (5, 20)
    plates = plates_to_learn()
    if quick:
        plates = {name: plates[name] for name in ("bow", "twist")}
    found = {name: {str(count): _measure(plate, count) for count in counts} for name, plate in plates.items()}
    return {"plates": found, "sigma_px": SIGMA_PX, "poses": len(poses()), "probes": PROBES, "seeds": [SEED]}


def table(result: Mapping[str, Any]) -> str:
    """Return the table as text."""
    lines = [
        f"{'plate':<16}{'runs':>5}{'error, mm':>11}{'sd, mm':>9}   "
        + "".join(f"{'bias of ' + name + ', px':>26}" for name in NAMES)
    ]
    for name, by_count in result["plates"].items():
        for count, row in by_count.items():
            biases = "".join(
                f"{row['bias_flat_px'][one]:>11.2f} to {row['bias_px'][one]:>5.2f} ± {row['sd_px'][one]:.2f}"
                for one in NAMES
            )
            lines.append(f"{name:<16}{count:>5}{row['error_mm']:>11.4f}{row['sd_mm']:>9.4f}   {biases}")
    return "\n".join(lines)


def plates_to_learn() -> dict[str, Array]:
    """Return deviations (n, 3), m, by the name of the plate."""
    x, y = (POINTS[:, axis] / POINTS[:, axis].max() - 0.5 for axis in (0, 1))
    bow, twist = (np.outer(1e-3 * z / np.ptp(z), [0.0, 0.0, 1.0]) for z in (x**2, x * y))
    print_error = np.random.default_rng(SEED).normal(0.0, 2e-5, POINTS.shape)
    return {"bow": 0.3 * bow, "twist": 0.3 * twist, "bow twist print": 0.3 * bow + 0.2 * twist + print_error}


def _measure(plate: Array, count: int) -> dict[str, Any]:
    rng = np.random.default_rng((SEED, count))
    shape = estimate_board_shape(POINTS, [_see(plate, rng)[1] for _ in range(count)])
    probes = [_see(plate, rng) for _ in range(PROBES)]
    flat = np.array([_off(POINTS, camera, seen) for camera, seen in probes])
    shaped = np.array([_off(POINTS + shape.deviations, camera, seen) for camera, seen in probes])
    return {
        "error_mm": _error_mm(shape, plate),
        "sd_mm": 1e3 * float(np.sqrt(np.mean(shape.sd**2))),
        "bend_mm": 1e3 * shape.bend_m,
        "bias_flat_px": dict(zip(NAMES, flat[:, 0].mean(axis=0).tolist(), strict=True)),
        "bias_px": dict(zip(NAMES, shaped[:, 0].mean(axis=0).tolist(), strict=True)),
        "sd_px": dict(zip(NAMES, shaped[:, 1].mean(axis=0).tolist(), strict=True)),
    }


def _see(plate: Array, rng: np.random.Generator) -> tuple[Intrinsics, ShapeRun]:
    """Return a camera and what it sees of a plate at every pose."""
    camera = draw_camera(NOMINAL, Tolerance(), rng)
    ids = np.arange(len(POINTS))
    seen = [
        project(camera, pose.rotation, pose.tvec + rng.uniform(-HAND_M, HAND_M, 3), POINTS + plate)
        + rng.normal(0.0, SIGMA_PX, (len(POINTS), 2))
        for pose in poses()
    ]
    return camera, ShapeRun(tuple(ids for _ in seen), tuple(seen), NOMINAL)


def _off(board: Array, camera: Intrinsics, seen: ShapeRun) -> Array:
    """Return errors and sd (2, 4) of a camera's focal lengths and centre, px."""
    found = solve_run(board, seen)
    return np.array([found.intrinsics.vector[:4] - camera.vector[:4], [found.sd[name] for name in NAMES]])


def _error_mm(shape: BoardShape, plate: Array) -> float:
    """Return the root mean square error of a shape after the best small similarity."""
    about = POINTS - POINTS.mean(axis=0)
    similar = [np.tile(axis, (len(about), 1)) for axis in np.eye(3)]
    similar += [np.cross(axis, about) for axis in np.eye(3)] + [about]
    basis, _ = np.linalg.qr(np.stack([one.ravel() for one in similar], axis=1))
    off = (shape.deviations - plate).ravel()
    return 1e3 * float(np.sqrt(np.mean((off - basis @ (basis.T @ off)) ** 2)))
