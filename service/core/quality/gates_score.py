"""The score of the paper, S = 1 / (α·MRE + β·‖Ĉ − C‖) with the SKU's C, and the same difference as a map.

Reported without a limit. ‖Ĉ − C‖ adds pixels to plain numbers: a k3 that is off by 0.08 moves corners by 12
px and hardly shows. √(ΔCᵀHΔC) says in px what such a difference does to the image.
"""

from dataclasses import dataclass

import numpy as np

from service.core.quality.gates import Measurement, report_value
from service.core.vision.calibration import CalibrationResult
from service.core.vision.camera import Intrinsics
from service.core.vision.transforms import Array
from service.core.vision.uncertainty import parameter_metric

GATE = "score"


@dataclass(frozen=True)
class Score:
    """The paper's S, and the distance to the nominal camera as a map, px (RMS over the working zone)."""

    value: float
    difference_px: float


def score_against(result: CalibrationResult, nominal: Intrinsics, grid: Array, mean_px: float) -> Score:
    """Return the score (α = β = 1, the paper's Table 1) and the map's difference over a grid (m, 2) px.

    mean_px: the mean reprojection error, px.
    """
    difference = result.intrinsics.vector - nominal.vector
    H = parameter_metric(result.intrinsics, grid)
    squared = max(float(difference @ H @ difference), 0.0)
    return Score(
        value=1.0 / max(mean_px + float(np.linalg.norm(difference)), 1e-12),
        difference_px=squared**0.5,
    )


def measure_score(score: Score | None) -> tuple[Measurement, ...]:
    """Return the measurements of the score gate; none without a SKU."""
    if score is None:
        return ()
    return (
        report_value(
            GATE,
            "paper_score",
            score.value,
            unit="1/px",
            advice="The paper's score against the SKU's nominal camera; higher is nearer.",
        ),
        report_value(
            GATE,
            "nominal_difference_px",
            score.difference_px,
            unit="px",
            advice="How far this camera maps the working zone from the SKU's nominal camera.",
        ),
    )
