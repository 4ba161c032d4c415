"""The poses gate: were the prescribed poses taken, is no view there twice, and is the working zone covered?

One view given ten times has the best RMS of all and a focal length that is 45 % off: only this gate and the
uncertainty see it.
"""

from collections.abc import Sequence, Set

import numpy as np
from scipy.optimize import linear_sum_assignment

from service.core.quality.coverage import covered_share, default_working_zone
from service.core.quality.early_finish import proven_mapping_px
from service.core.quality.evidence import Evidence, Expectation, NamedDetection
from service.core.quality.gates import Measurement, check_limit, report_value
from service.core.quality.gates_frame import NAMES_SHOWN, name_some, some_views
from service.core.quality.reasons import Reason
from service.core.vision.camera import project
from service.core.vision.half_turn import mean_distances
from service.core.vision.outer_features import outer_places
from service.core.vision.target import Target
from service.core.vision.transforms import Array, Pose, stack_poses
from service.core.vision.uncertainty import MappingError, whole_image

GATE = "poses"


def measure_poses(evidence: Evidence, zone_mapping: MappingError) -> tuple[Measurement, ...]:
    """Return the measurements of the poses gate; those of prescribed poses only where there are any.

    zone_mapping: over the working zone, by which a run that ended early must have proven its accuracy.
    """
    return (*_prescribed(evidence, zone_mapping), _separation(evidence), _coverage(evidence))


def match_distances(
    view: NamedDetection, poses: tuple[Pose, ...], expectation: Expectation, target: Target
) -> Array:
    """Return the mean distance of the four outer corners, px (m,), of a view to each of m prescribed poses.

    Outer corners that the view lacks are where the pose of its others puts them. Expected corners are
    projected by the nominal intrinsics, as they are on the operator's screen.
    """
    outer, detection = list(target.outer_corners), view.detection
    seen = outer_places(detection.image_points, detection.corner_ids, target, expectation.nominal)
    expected = project(expectation.nominal, *stack_poses(poses), target.object_points[outer])
    present = np.isfinite(seen[:, 0])
    if not present.any():
        return np.full(len(poses), np.nan)
    if present.all():
        return mean_distances(seen, expected, target)
    mean: Array = np.linalg.norm(expected - seen, axis=-1)[:, present].mean(axis=1)
    return mean


def _prescribed(evidence: Evidence, zone_mapping: MappingError) -> tuple[Measurement, ...]:
    expectation = evidence.expectation
    if expectation is None or not expectation.poses:
        return ()
    poses = (*expectation.poses, *(added.pose for added in expectation.added))
    errors = _match_errors(evidence, expectation, poses)
    limit = evidence.limits.match_share * evidence.image_size[0]
    taken = {pose for pose, (_, error) in errors.items() if error <= limit}
    worst = max(errors.values(), key=lambda named: named[1], default=("", float("nan")))
    return (
        _missing(evidence, expectation, taken, zone_mapping),
        check_limit(
            GATE,
            "match_px",
            worst[1],
            "<=",
            limit,
            unit="px",
            share=evidence.limits.share("match_share"),
            good="Every view lies on its prescribed pose.",
            bad=f"{worst[0] or 'No view'} is too far from its prescribed pose.",
            remedy="Take it again, closer to the pose that is shown.",
            facts=some_views([worst[0]] if worst[0] else []),
        ),
    )


def _missing(
    evidence: Evidence, expectation: Expectation, taken: Set[int], zone_mapping: MappingError
) -> Measurement:
    """Say which prescribed poses were neither taken nor replaced, unless a proven accuracy excuses it."""
    answered = _with_replaced(expectation, taken)
    missing = [pose + 1 for pose in range(len(expectation.poses or ())) if pose not in answered]
    early = expectation.early_finish
    if missing and early is not None and len(taken) >= early.smallest_poses:
        proven_px = proven_mapping_px(evidence.result, zone_mapping)
        if proven_px <= early.required_px:
            return _not_needed(len(taken), len(missing), proven_px, early.required_px)
    return check_limit(
        GATE,
        "missing_poses",
        float(len(missing)),
        "<=",
        0.0,
        unit="poses",
        good="Every prescribed pose was taken.",
        bad=f"Not taken: {name_some([f'pose {number}' for number in missing])}.",
        remedy="Take a picture at each of these poses.",
        facts={"poses": missing[:NAMES_SHOWN], "more": max(0, len(missing) - NAMES_SHOWN)},
    )


def _not_needed(taken: int, not_needed: int, proven_px: float, required_px: float) -> Measurement:
    return check_limit(
        GATE,
        "missing_poses",
        0.0,
        "<=",
        0.0,
        unit="poses",
        good=f"{taken} poses proved the required accuracy ({proven_px:.3f} px of {required_px:.3f} px); "
        f"{not_needed} prescribed ones were not needed.",
        bad="",
        remedy="",
        reason=Reason.EARLY_FINISH,
        facts={"taken": taken, "not_needed": not_needed, "proven_px": proven_px, "required_px": required_px},
    )


def _with_replaced(expectation: Expectation, taken: Set[int]) -> set[int]:
    """Return the poses that were taken, and those that one of these stands in for."""
    answered, first = set(taken), len(expectation.poses or ())
    # Backwards, for a pose may stand in for one that was itself added.
    for place, added in reversed(list(enumerate(expectation.added))):
        if first + place in answered and added.replaces is not None:
            answered.add(added.replaces)
    return answered


def _match_errors(
    evidence: Evidence, expectation: Expectation, poses: tuple[Pose, ...]
) -> dict[int, tuple[str, float]]:
    """Return for each answered pose the name of its best view and the distance, px."""
    distances = np.array(
        [match_distances(view, poses, expectation, evidence.target) for view in evidence.views]
    )
    distances = np.nan_to_num(distances, nan=1e9)
    if evidence.pose_of_view is None:
        rows, columns = linear_sum_assignment(distances)
        pairs = list(zip(rows.tolist(), columns.tolist(), strict=True))
    else:
        pairs = [(view, pose) for view, pose in enumerate(evidence.pose_of_view) if pose is not None]
    errors: dict[int, tuple[str, float]] = {}
    for view, pose in pairs:
        error = float(distances[view, pose])
        if pose not in errors or error < errors[pose][1]:
            errors[pose] = (evidence.names[view], error)
    return errors


def _separation(evidence: Evidence) -> Measurement:
    smallest, first, second = nearest_views(evidence.views, len(evidence.target.object_points))
    return check_limit(
        GATE,
        "view_separation_px",
        smallest,
        ">=",
        evidence.limits,
        unit="px",
        good="No view is there twice.",
        bad=f"{first} and {second} show the board in the same place: together they tell no more than one.",
        remedy="Leave one of them out, and move the board between pictures.",
        facts=some_views([first, second]),
    )


def nearest_views(views: Sequence[NamedDetection], corners: int) -> tuple[float, str, str]:
    """Return the smallest mean distance, px, of two views' corners, and their names; 0 for the same file.

    Infinite where no two views share a corner.
    """
    points = np.full((len(views), corners, 2), np.nan)
    for i, view in enumerate(views):
        points[i, view.detection.corner_ids] = view.detection.image_points
    nearest = (float("inf"), views[0].name, views[1].name)
    for i, view in enumerate(views[:-1]):
        apart = np.linalg.norm(points[i + 1 :] - points[i], axis=-1)
        shared = np.isfinite(apart)
        means = np.where(shared, apart, 0.0).sum(axis=1) / np.maximum(shared.sum(axis=1), 1)
        means[~shared.any(axis=1)] = np.inf
        means[[view.sha256 != "" and view.sha256 == other.sha256 for other in views[i + 1 :]]] = 0.0
        k = int(means.argmin())
        if means[k] < nearest[0]:
            nearest = (float(means[k]), view.name, views[i + 1 + k].name)
    return nearest


def _coverage(evidence: Evidence) -> Measurement:
    corners = np.concatenate([view.detection.image_points for view in evidence.views])
    if evidence.expectation is None:
        return report_value(
            GATE,
            "image_coverage",
            covered_share(corners, whole_image(evidence.image_size)),
            advice="The share of the image in which corners were seen; the calibration is valid there only.",
        )
    zone = evidence.expectation.working_zone or default_working_zone(evidence.image_size)
    return check_limit(
        GATE,
        "coverage",
        covered_share(corners, zone),
        ">=",
        evidence.limits,
        good="The views cover the working zone.",
        bad="Parts of the working zone were never seen.",
        remedy="Add views with the board towards the border of the image.",
    )
