"""Detections in, a judged calibration out: solve, measure every gate, let the worst measurement decide.

The command and the service judge through `calibrate_and_judge` and nothing else, so that the same images get
the same verdict everywhere. Not here: what is measured (gates_*.py) and images (vision.detection).
"""

from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from service.core.errors import TooFewViews, WrongImageSize
from service.core.quality.coverage import default_valid_region, default_working_zone, seen_grid, zone_grid
from service.core.quality.evidence import (
    Evidence,
    Expectation,
    FixedTargetViews,
    NamedDetection,
    Refusal,
)
from service.core.quality.gates import Measurement, Verdict, worst_verdict
from service.core.quality.gates_bias import measure_bias
from service.core.quality.gates_certainty import measure_certainty
from service.core.quality.gates_cross_check import measure_cross_check
from service.core.quality.gates_extrinsics import measure_extrinsics
from service.core.quality.gates_fit import measure_fit
from service.core.quality.gates_frame import measure_frame
from service.core.quality.gates_identity import measure_identity
from service.core.quality.gates_model import measure_model
from service.core.quality.gates_population import measure_population
from service.core.quality.gates_poses import measure_poses
from service.core.quality.gates_score import Score, measure_score, score_against
from service.core.quality.gates_sharpness import measure_sharpness
from service.core.quality.limits import Limits, default_limits
from service.core.quality.place import find_place
from service.core.vision.calibration import CalibrationResult, View, calibrate_intrinsics
from service.core.vision.extrinsics import Extrinsics
from service.core.vision.residuals import mean_reprojection_error
from service.core.vision.target import Target
from service.core.vision.transforms import Array
from service.core.vision.uncertainty import MappingError, mapping_error

__all__ = ["Expectation", "Judged", "NamedDetection", "Refusal", "calibrate_and_judge"]

VIEWS_NEEDED = 3
REASONS_SHOWN = 12


@dataclass(frozen=True)
class Judged:
    """A calibration with all that was measured on it.

    views: those used, in the order of the result's poses and residuals. refused: those that were not, with
    reasons. zone_mapping, valid_mapping: expected mapping error over the working zone and the valid region.
    extrinsics: where the camera is in the vehicle; None without pictures of a fixed target; fixed_views:
    their names.
    score: the paper's S against the SKU's nominal; score_difference_px: the same difference as a map; None
    without.
    """

    result: CalibrationResult
    measurements: tuple[Measurement, ...]
    verdict: Verdict
    score: float | None
    score_difference_px: float | None
    limits: Limits
    views: tuple[NamedDetection, ...]
    refused: tuple[Refusal, ...]
    zone_mapping: MappingError
    valid_mapping: MappingError
    extrinsics: Extrinsics | None = None
    fixed_views: tuple[str, ...] = ()


def calibrate_and_judge(
    detections: Sequence[NamedDetection],
    target: Target,
    lens: str = "pinhole5",
    expectation: Expectation | None = None,
    *,
    fixed: Collection[str] = (),
    refused: Sequence[Refusal] = (),
    board: Array | None = None,
    fixed_target: FixedTargetViews | None = None,
) -> Judged:
    """Calibrate from detections and judge the outcome by every gate.

    refused: images that gave no detection; they count in the frame gate. Detections of another image size
    than the SKU's (without SKU: than the majority's) join them. board: where the corners of the plate itself
    are, (n, 3) m; by default where the target has them. fixed_target: pictures that say where the camera is
    in the vehicle. Gates that need a SKU are left out without an expectation. Raises TooFewViews (naming each
    refused image with its reason), DegenerateViews; WrongImageSize
    and PoseUndetermined of the fixed target.
    """
    image_size = _image_size(detections, expectation)
    kept = [i for i, named in enumerate(detections) if named.detection.image_size == image_size]
    odd = [
        _refuse_size(named, image_size) for named in detections if named.detection.image_size != image_size
    ]
    refusals = (*refused, *odd)
    views = tuple(detections[i] for i in kept)
    _check_enough(views, refusals)
    _check_sizes(() if fixed_target is None else fixed_target.views, image_size)
    answers = expectation.pose_of_view if expectation else None
    nominal = expectation.nominal if expectation else None
    corners = target.object_points if board is None else board
    result = calibrate_intrinsics(
        _solver_views(views, corners), image_size, lens, nominal=nominal, fixed=fixed
    )
    evidence = Evidence(
        target=target,
        board=corners,
        views=views,
        refused=refusals,
        result=result,
        limits=(expectation and expectation.limits) or default_limits(image_size),
        expectation=expectation,
        pose_of_view=None if answers is None else tuple(answers[i] for i in kept),
        working_grid=_working_grid(views, image_size, expectation),
        valid_grid=_valid_grid(views, image_size, expectation),
        fixed_target=fixed_target,
    )
    return _judge(evidence)


def _judge(evidence: Evidence) -> Judged:
    result, expectation = evidence.result, evidence.expectation
    zone = mapping_error(result.intrinsics, result.covariance, evidence.working_grid)
    valid = mapping_error(result.intrinsics, result.covariance, evidence.valid_grid)
    score: Score | None = None
    if expectation is not None:
        mean_px = mean_reprojection_error(result.residuals)
        score = score_against(result, expectation.nominal, evidence.working_grid, mean_px)
    extrinsics = _extrinsics(evidence)
    mounting = None if expectation is None else expectation.mounting
    measurements = (
        *measure_frame(evidence),
        *measure_sharpness(evidence),
        *measure_poses(evidence, zone),
        *measure_fit(evidence),
        *measure_certainty(evidence, zone, valid),
        *measure_bias(evidence),
        *measure_cross_check(evidence),
        *measure_model(evidence),
        *measure_identity(evidence),
        *measure_population(evidence),
        *(() if extrinsics is None else measure_extrinsics(extrinsics, evidence.limits, mounting)),
        *measure_score(score),
    )
    return Judged(
        result=result,
        measurements=measurements,
        verdict=worst_verdict(measurement.verdict for measurement in measurements),
        score=score.value if score else None,
        score_difference_px=score.difference_px if score else None,
        limits=evidence.limits,
        views=evidence.views,
        refused=evidence.refused,
        zone_mapping=zone,
        valid_mapping=valid,
        extrinsics=extrinsics,
        fixed_views=() if evidence.fixed_target is None else _names(evidence.fixed_target.views),
    )


def _names(views: Sequence[NamedDetection]) -> tuple[str, ...]:
    return tuple(view.name for view in views)


def _extrinsics(evidence: Evidence) -> Extrinsics | None:
    fixed, result = evidence.fixed_target, evidence.result
    if fixed is None:
        return None
    return find_place(fixed, result.intrinsics, result.covariance)


def _solver_views(views: Sequence[NamedDetection], board: Array) -> list[View]:
    return [View(board[v.detection.corner_ids], v.detection.image_points, v.name) for v in views]


def _image_size(detections: Sequence[NamedDetection], expectation: Expectation | None) -> tuple[int, int]:
    """Return the size that views must have: the SKU's, else that of most images."""
    if expectation is not None:
        return expectation.nominal.image_size
    sizes = Counter(named.detection.image_size for named in detections)
    return sizes.most_common(1)[0][0] if sizes else (0, 0)


def _refuse_size(named: NamedDetection, image_size: tuple[int, int]) -> Refusal:
    width, height = named.detection.image_size
    detail = (
        f"The image has {width}x{height} px, this camera {image_size[0]}x{image_size[1]} px; leave it out."
    )
    return Refusal(named.name, WrongImageSize.code, detail)


def _check_sizes(views: Sequence[NamedDetection], image_size: tuple[int, int]) -> None:
    """Raise WrongImageSize where a picture of the fixed target has not the size of the camera's images."""
    for view in views:
        if view.detection.image_size != image_size:
            width, height = view.detection.image_size
            raise WrongImageSize(
                f"{view.name} has {width}x{height} px, the camera's images {image_size[0]}x{image_size[1]}. "
                "Take the picture of the fixed target with this camera, at its full size.",
                found=[width, height],
                expected=list(image_size),
            )


def _check_enough(views: Sequence[NamedDetection], refused: Sequence[Refusal]) -> None:
    """Raise TooFewViews unless there are enough views for a solve."""
    if len(views) >= VIEWS_NEEDED:
        return
    reasons = " ".join(f"{refusal.name}: {refusal.detail}" for refusal in refused[:REASONS_SHOWN])
    more = len(refused) - REASONS_SHOWN
    raise TooFewViews(
        f"{len(views)} of {len(views) + len(refused)} images can be used, and at least {VIEWS_NEEDED} are "
        "needed. Take more images that show the whole target. "
        f"{reasons}{f' And {more} more.' if more > 0 else ''}".rstrip(),
        views_found=len(views),
        views_needed=VIEWS_NEEDED,
        refused=[refusal.name for refusal in refused],
        reasons=[refusal.code for refusal in refused],
    )


def _working_grid(
    views: Sequence[NamedDetection], image_size: tuple[int, int], expectation: Expectation | None
) -> Array:
    if expectation is None:
        return _seen(views)
    return zone_grid(expectation.working_zone or default_working_zone(image_size))


def _valid_grid(
    views: Sequence[NamedDetection], image_size: tuple[int, int], expectation: Expectation | None
) -> Array:
    if expectation is None:
        return _seen(views)
    return zone_grid(expectation.valid_region or default_valid_region(image_size))


def _seen(views: Sequence[NamedDetection]) -> Array:
    return seen_grid(np.concatenate([view.detection.image_points for view in views]))
