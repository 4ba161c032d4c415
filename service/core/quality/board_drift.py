"""What became of a plate since its shape was certified: how far corners moved, and what it does to cameras.

Not here: how a shape is learnt (`vision.board_shape`).
"""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from service.core.quality.coverage import default_working_zone, zone_grid
from service.core.vision.board_shape import BoardShape, ShapeRun, camera_by_board
from service.core.vision.calibration import CalibrationResult
from service.core.vision.transforms import Array
from service.core.vision.uncertainty import parameter_metric

NEAR_SHARE = 0.8  # of the limit, from which on somebody should look at the plate
KNOWN_SHARE = 0.2  # of the limit, that a shape's own uncertainty may be


class DriftState(StrEnum):
    """What is said about a plate's drift."""

    STEADY = "steady"
    NEAR = "near"
    OVER = "over"


@dataclass(frozen=True)
class Drift:
    """How two shapes of one plate differ.

    worst_mm, rms_mm: distances of the corners. focal_px, mapping_px: what a camera's focal length, and its
    map of the working zone, would be off by if the one were taken for the other. limit_mm: on worst_mm.
    """

    worst_mm: float
    rms_mm: float
    focal_px: float
    mapping_px: float
    limit_mm: float

    @property
    def state(self) -> DriftState:
        """STEADY, NEAR its limit, or OVER it."""
        if self.worst_mm > self.limit_mm:
            return DriftState.OVER
        return DriftState.NEAR if self.worst_mm > NEAR_SHARE * self.limit_mm else DriftState.STEADY


def compare_shapes(
    object_points: Array,
    certified: Array,
    learnt: Array,
    run: ShapeRun,
    result: CalibrationResult,
    *,
    limit_mm: float,
) -> Drift:
    """Return the drift from certified to learnt deviations (n, 3) m of the pattern's object_points (n, 3) m.

    run, result: a run that was solved with the learnt shape; its camera and poses stand for all.
    """
    change = certified - learnt
    moved = np.linalg.norm(change, axis=1)
    shift = camera_by_board(object_points + learnt, run, result) @ change.ravel()
    H = _metric(result)
    return Drift(
        worst_mm=1e3 * float(moved.max()),
        rms_mm=1e3 * float(np.sqrt(np.mean(moved**2))),
        focal_px=float(np.abs(shift[:2]).max()),
        mapping_px=float(np.sqrt(max(float(shift @ H @ shift), 0.0))),
        limit_mm=limit_mm,
    )


@dataclass(frozen=True)
class ShapeCertainty:
    """What the uncertainty of a shape does to every camera that is solved with it, alike: sd.

    corner_mm: root of the mean over the corners. focal_px, centre_px: the larger of both axes. mapping_px: of
    the map over the working zone.
    """

    corner_mm: float
    focal_px: float
    centre_px: float
    mapping_px: float

    def suits(self, limit_mm: float) -> bool:
        """Whether the corners are certain enough for a limit on their drift."""
        return self.corner_mm <= KNOWN_SHARE * limit_mm


def measure_certainty(
    object_points: Array, shape: BoardShape, run: ShapeRun, result: CalibrationResult
) -> ShapeCertainty:
    """Return how certain a shape of the pattern's object_points (n, 3) m is.

    run, result: a run that was solved with the shape; its camera and poses stand for all.
    """
    moves = camera_by_board(object_points + shape.deviations, run, result)
    shared = moves @ shape.covariance @ moves.T
    sd = np.sqrt(np.maximum(np.diagonal(shared), 0.0))
    return ShapeCertainty(
        corner_mm=1e3 * float(np.sqrt(np.mean(shape.sd**2))),
        focal_px=float(sd[:2].max()),
        centre_px=float(sd[2:4].max()),
        mapping_px=float(np.sqrt(max(float(np.trace(_metric(result) @ shared)), 0.0))),
    )


def _metric(result: CalibrationResult) -> Array:
    intrinsics = result.intrinsics
    return parameter_metric(intrinsics, zone_grid(default_working_zone(intrinsics.image_size)))
