"""The model gate: did the solver find the optimum, and is what it found a possible lens?

A solver that stops early returns numbers that look like a camera; so does a distortion polynomial that folds
back inside the image. Neither shows in the residuals.
"""

import math

import numpy as np

from service.core.quality.evidence import Evidence
from service.core.quality.gates import OTHER_LENS, Measurement, check_limit
from service.core.vision.camera import Intrinsics, reach_share, unproject
from service.core.vision.transforms import stack_poses

GATE = "model"
OTHER = (
    "The views do not determine this camera, or the lens model does not suit it: "
    "take other views, with the board tilted, fix the coefficients that this lens does not need, "
    "or choose another lens model."
)
RATIO_CAP = 10.0  # a polynomial that never folds has an infinite ratio, which no report can show


def measure_model(evidence: Evidence) -> tuple[Measurement, ...]:
    """Return the measurements of the model gate."""
    agreement = _agreement(evidence)
    return (
        _converged(evidence),
        *((agreement,) if agreement else ()),
        _monotone(evidence),
        _square_pixels(evidence),
    )


def _converged(evidence: Evidence) -> Measurement:
    return check_limit(
        GATE,
        "converged",
        float(evidence.result.converged),
        "==",
        1.0,
        good="The solver proved that it reached the optimum.",
        bad="The solver did not reach one optimum from every start.",
        remedy=OTHER,
    )


def _agreement(evidence: Evidence) -> Measurement | None:
    """Return how far the starts are apart; None where one failed, which is what `converged` says."""
    if not math.isfinite(evidence.result.agreement_px):
        return None
    return check_limit(
        GATE,
        "agreement_px",
        evidence.result.agreement_px,
        "<=",
        evidence.limits,
        unit="px",
        good="All starts of the solver lead to the same camera.",
        bad="Different starts of the solver lead to different cameras.",
        remedy=OTHER,
    )


def _monotone(evidence: Evidence) -> Measurement:
    return check_limit(
        GATE,
        "monotone_ratio",
        _monotone_ratio(evidence),
        ">=",
        evidence.limits,
        good="The distortion grows steadily beyond the farthest corner.",
        bad="The distortion folds back inside the image, so that two directions share a pixel.",
        remedy="The lens is wider than this lens model can describe, or no corner was seen near the border: "
        f"add views with the board in the corners of the image. {OTHER_LENS}",
    )


def _monotone_ratio(evidence: Evidence) -> float:
    """Return the reach of the lens over the farthest radius in use, both in the lens's own measure.

    In use are the corners that were seen and the valid region; 0 where the lens does not reach a point of it.
    """
    intrinsics = evidence.result.intrinsics
    rotations, translations = stack_poses(evidence.result.poses)
    boards = np.swapaxes(rotations @ evidence.board.T, 1, 2) + translations[:, None]
    # What a view does not show of its board may be anywhere.
    ids = [view.detection.corner_ids for view in evidence.views]
    points = np.concatenate([board[seen] for board, seen in zip(boards, ids, strict=True)])
    valid = unproject(intrinsics, evidence.valid_grid)
    if not np.all(np.isfinite(valid)):
        return 0.0
    farthest = max(float(reach_share(intrinsics, seen).max()) for seen in (points, valid))
    return 1.0 / max(farthest, 1.0 / RATIO_CAP)


def _aspect(intrinsics: Intrinsics) -> float:
    return float(intrinsics.camera_matrix[0, 0] / intrinsics.camera_matrix[1, 1])


def _square_pixels(evidence: Evidence) -> Measurement:
    """Compare fx/fy with the SKU's own ratio, without a SKU with 1: not all pixels are quite square."""
    nominal = _aspect(evidence.expectation.nominal) if evidence.expectation else 1.0
    deviation = abs(_aspect(evidence.result.intrinsics) / nominal - 1.0)
    return check_limit(
        GATE,
        "square_pixels",
        deviation,
        "<=",
        evidence.limits,
        good="fx and fy are in the ratio that the pixels give them.",
        bad=f"The ratio of fx to fy is {deviation:.2%} off: image or squares were stretched.",
        remedy="Measure the board, and record without scaling.",
    )
