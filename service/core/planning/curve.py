"""How many poses: the expected error against the number of poses, and the smallest number that is enough.

Each set grows from the one before it, so that the whole curve costs little more than one plan. Not here: the
set that is then really planned (`plan`).
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from service.core.errors import PoseSetInfeasible
from service.core.planning.criterion import Criterion
from service.core.planning.optimiser import select_poses
from service.core.planning.pose_space import Mask
from service.core.planning.scoring import expected_covariance
from service.core.vision.transforms import Array

FEWEST: Final = 3
MOST: Final = 30


@dataclass(frozen=True)
class CurvePoint:
    """The best set of so many poses: √E‖Ĉ − C‖² px, and the mean and worst mapping error over the zone,
    px."""

    poses: int
    norm_px: float
    mapping_mean_px: float
    mapping_worst_px: float


def error_curve(
    information: Array,
    image_points: Array,
    separation_px: float,
    criterion: Criterion,
    places: Callable[[int], Sequence[Mask]],
    *,
    progress: Callable[[float], None],
) -> tuple[CurvePoint, ...]:
    """Return the curve over 3…30 poses; it ends where the candidates do not hold more poses.

    information: (m, p, p) at the nominal camera; image_points: (m, n, 2) px; places: for a number of poses,
    which candidates (m,) may take the first places.
    """
    return tuple(_points(information, image_points, separation_px, criterion, places, progress=progress))


def smallest_count(curve: Sequence[CurvePoint], required_mapping_px: float) -> int | None:
    """Return the smallest number of poses whose mean mapping error is small enough; None where none is."""
    return next((point.poses for point in curve if point.mapping_mean_px <= required_mapping_px), None)


def _points(
    information: Array,
    image_points: Array,
    separation_px: float,
    criterion: Criterion,
    places: Callable[[int], Sequence[Mask]],
    *,
    progress: Callable[[float], None],
) -> Iterator[CurvePoint]:
    chosen: list[int] = []
    for count in range(FEWEST, MOST + 1):
        slots = places(count)
        # A place that is asked for anew goes to a pose that fits it, or the set is made from scratch.
        fitting = all(slots[i][pose] for i, pose in enumerate(chosen[: len(slots)]))
        try:
            found = select_poses(
                information,
                image_points,
                count,
                separation_px,
                criterion,
                starts=1,
                slots=slots,
                begin=chosen if fitting else (),
            )
            covariance = expected_covariance(information[found].sum(axis=0))
        except PoseSetInfeasible:
            if chosen:
                return
            continue
        chosen = [int(i) for i in found]
        variances = criterion.variances(covariance[None])[0]
        yield CurvePoint(
            count,
            float(np.sqrt(np.trace(covariance))),
            float(np.sqrt(variances.mean())),
            float(np.sqrt(variances.max())),
        )
        progress((count - FEWEST + 1) / (MOST - FEWEST + 1))
