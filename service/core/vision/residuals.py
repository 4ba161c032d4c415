"""What the residuals of a solve say: how large, how even over the views, how many outliers.

Residuals are detected minus projected, (n, 2) px for each view. Not here: limits (`service.core.quality`).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from service.core.vision.transforms import Array

OUTLIER_SIGMA = 4.0
OUTLIER_FLOOR_PX = 0.05  # nearer than that nothing in front of a board can be told from a soft edge


@dataclass(frozen=True)
class ResidualSummary:
    """The figures of a solve's residuals; see the functions of the same names."""

    rms_px: float
    mean_error_px: float
    max_error_px: float
    worst_view_rms_px: float
    worst_view: int
    worst_to_median_view: float
    outlier_share: float


def summarise_residuals(residuals: Sequence[Array], sigma_px: float) -> ResidualSummary:
    """Return the figures of residuals, v times (n, 2) px, whose coordinates scatter by sigma_px."""
    views = view_rms(residuals)
    return ResidualSummary(
        rms_px=rms(residuals),
        mean_error_px=mean_reprojection_error(residuals),
        max_error_px=max(float(np.linalg.norm(view, axis=1).max()) for view in residuals),
        worst_view_rms_px=float(views.max()),
        worst_view=int(views.argmax()),
        worst_to_median_view=worst_to_median_view(residuals),
        outlier_share=outlier_share(residuals, sigma_px),
    )


def rms(residuals: Sequence[Array]) -> float:
    """Return √(Σ|e|²/N) px over the N corners of all views: OpenCV's RMS."""
    errors = np.concatenate([np.sum(view * view, axis=1) for view in residuals])
    return float(np.sqrt(errors.mean()))


def mean_reprojection_error(residuals: Sequence[Array]) -> float:
    """Return Σ|e|/N px over the N corners of all views: the paper's MRE."""
    return float(np.concatenate([np.linalg.norm(view, axis=1) for view in residuals]).mean())


def view_rms(residuals: Sequence[Array]) -> Array:
    """Return √(Σ|e|²/n) px of each view (v,)."""
    return np.array([np.sqrt(np.mean(np.sum(view * view, axis=1))) for view in residuals])


def worst_to_median_view(residuals: Sequence[Array]) -> float:
    """Return the ratio of the worst view's rms to the median view's; 1 where all are exact."""
    views = view_rms(residuals)
    median = float(np.median(views))
    return float(views.max()) / median if median > 0 else (1.0 if views.max() == 0 else float("inf"))


def outlier_share(residuals: Sequence[Array], sigma_px: float) -> float:
    """Return the share of corners with a coordinate beyond four sigma_px and OUTLIER_FLOOR_PX."""
    largest = np.concatenate([np.abs(view).max(axis=1) for view in residuals])
    return float(np.mean(largest > max(OUTLIER_SIGMA * sigma_px, OUTLIER_FLOOR_PX)))
