"""A plan for a SKU's nominal against the published figures of guided peers, in the simulation of theirs.

HFOV 80 at 1280x800, units spread by 0.5 %, 8x5 inner corners of 28 mm, corner noise 0.1 px. The set is
planned once, for the nominal; every unit is calibrated from the poses that its hand makes of it, none known
before. In the same simulation pose_calib reached an sd of fx of 0.65 px with 10.5 views, the ROS calibrator
0.74 px with 14.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from service.core.planning.plan import plan_pose_set
from service.core.planning.pose_space import PoseSpace
from service.core.vision.calibration import View, calibrate_intrinsics
from service.core.vision.camera import Intrinsics, project
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.tolerance import Tolerance, draw_camera
from service.core.vision.transforms import Array, Pose
from service.simulator.scene import clean_scene
from service.simulator.vehicle import Mismatch, hold_board

NOMINAL = Intrinsics.from_parameters(
    "pinhole5",
    {
        "fx": 920.55,
        "fy": 919.6,
        "cx": 648.3,
        "cy": 395.6,
        "k1": -0.31,
        "k2": 0.105,
        "p1": 4e-4,
        "p2": -3e-4,
        "k3": -0.015,
    },
    (1280, 800),
)
TARGET = Chessboard(8, 5, 0.028)
TOLERANCE = Tolerance(focal_share=0.005, aspect_share=0.0003, centre_px=4.0)
SIGMA_PX = 0.1
SEED = 7
COUNTS = (6, 10)
PUBLISHED = {"pose_calib": (10.5, 0.65), "ROS": (14, 0.74)}


@dataclass(frozen=True)
class Effort:
    """How many units are calibrated."""

    units: int


def run(quick: bool) -> dict[str, Any]:
    """Return the standard deviations of the errors over all units, by number of poses."""
    effort = Effort(15 if quick else 60)
    return {
        "by_n": {str(count): measure(count, effort) for count in COUNTS},
        "published_sd_fx_px": {name: sd for name, (_, sd) in PUBLISHED.items()},
        "units": effort.units,
        "sigma_px": SIGMA_PX,
        "seeds": [SEED],
    }


def table(result: Mapping[str, Any]) -> str:
    """Return the comparison as lines of text."""
    lines = [f"{'who':<14}{'views':>8}{'sd fx px':>12}{'sd fy px':>12}{'sd cx px':>12}{'sd cy px':>12}"]
    for count, row in result["by_n"].items():
        lines.append(
            f"{'ours':<14}{count:>8}" + "".join(f"{row[name]:>12.3f}" for name in ("fx", "fy", "cx", "cy"))
        )
    lines += [f"{name:<14}{views:>8}{sd:>12.3f}" for name, (views, sd) in PUBLISHED.items()]
    return "\n".join(lines)


def measure(count: int, effort: Effort) -> dict[str, float]:
    """Return the sd of each parameter's error over units, px."""
    planned = plan_pose_set(NOMINAL, TARGET, PoseSpace(), count, SEED, objective="parameters")
    rng = np.random.default_rng((SEED, count))
    errors = np.array([_calibrate_unit(planned.poses, rng) for _ in range(effort.units)])
    return dict(zip(NOMINAL.parameters, map(float, errors.std(axis=0, ddof=1)), strict=True))


def _calibrate_unit(poses: tuple[Pose, ...], rng: np.random.Generator) -> Array:
    """Return the errors (p,) of a unit's parameters."""
    true = draw_camera(NOMINAL, TOLERANCE, rng)
    scene = clean_scene(true, TARGET)
    views = []
    for pose in poses:
        held = hold_board(scene, pose, Mismatch(), rng)
        pixels = project(true, held.rotation, held.tvec, TARGET.object_points)
        views.append(View(TARGET.object_points, pixels + rng.normal(0.0, SIGMA_PX, pixels.shape)))
    found = calibrate_intrinsics(views, true.image_size, true.lens, nominal=NOMINAL)
    return found.intrinsics.vector - true.vector
