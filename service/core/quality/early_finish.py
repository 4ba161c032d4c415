"""When a run may end before all its poses are taken: the required accuracy is proven by those that are.

Pure rule on a solve. Not here: when it is looked at (guidance), and what else must hold (every other gate).
"""

from dataclasses import dataclass

from scipy.stats import chi2

from service.core.vision.calibration import CalibrationResult
from service.core.vision.uncertainty import MappingError

CONFIDENCE = 0.95


@dataclass(frozen=True)
class EarlyFinish:
    """What a SKU asks before a run may end early: so many captured poses, and this mean mapping error, px."""

    smallest_poses: int
    required_px: float


def proven_mapping_px(result: CalibrationResult, mapping: MappingError) -> float:
    """Return the mean mapping error, px, that is not exceeded with 95 % confidence.

    The noise comes from the residuals of the same few views, whose sum of squares over σ² is chi-square
    distributed; whoever stops when the figure is small enough picks the runs whose noise came out small.
    """
    measurements = 2 * sum(len(view) for view in result.residuals)
    free = len(result.covariance) - len(result.fixed)
    freedom = measurements - free - 6 * len(result.residuals)
    if freedom < 1:
        return float("inf")
    return float(mapping.mean_px * (freedom / chi2.ppf(1.0 - CONFIDENCE, freedom)) ** 0.5)
