"""The frame gate: is every image of this camera and this board, the right way round, and bright enough?

An image without a board is refused and costs a clean PASS; one of another board fails the calibration,
because then nobody knows which board the other images show.
"""

import math
from collections.abc import Sequence

import numpy as np

from service.core.errors import WrongTarget
from service.core.quality.evidence import Evidence, Refusal
from service.core.quality.gates import Measurement, Verdict, check_limit
from service.core.quality.reasons import Facts
from service.core.vision.transforms import stack_poses

GATE = "frame"
NAMES_SHOWN = 4


def measure_frame(evidence: Evidence) -> tuple[Measurement, ...]:
    """Return the measurements of the frame gate."""
    wrong = [refusal for refusal in evidence.refused if refusal.code == WrongTarget.code]
    other = [refusal for refusal in evidence.refused if refusal.code != WrongTarget.code]
    return (
        _wrong_target(wrong),
        _refused_images(other),
        *_facing(evidence),
        _parity(evidence),
        _contrast(evidence),
        *_saturation(evidence),
    )


def name_some(names: Sequence[str]) -> str:
    """Return up to four names as words, and how many more there are."""
    shown = ", ".join(name or "an unnamed image" for name in names[:NAMES_SHOWN])
    more = len(names) - NAMES_SHOWN
    return f"{shown} and {more} more" if more > 0 else shown


def some_views(names: Sequence[str]) -> Facts:
    """Return the same as facts."""
    return {"views": list(names[:NAMES_SHOWN]), "more": max(0, len(names) - NAMES_SHOWN)}


def _wrong_target(wrong: Sequence[Refusal]) -> Measurement:
    return check_limit(
        GATE,
        "wrong_target",
        float(len(wrong)),
        "<=",
        0.0,
        unit="images",
        good="No image shows another board than the declared one.",
        bad=f"Another board than the declared one is in {name_some([r.name for r in wrong])}.",
        remedy="Use the declared board, or declare the one that is used.",
        facts=some_views([r.name for r in wrong]),
    )


def _refused_images(refused: Sequence[Refusal]) -> Measurement:
    return check_limit(
        GATE,
        "refused_images",
        float(len(refused)),
        "<=",
        0.0,
        unit="images",
        worst=Verdict.MARGINAL,
        good="Every image could be used.",
        bad=f"Not used: {name_some([r.name for r in refused])}.",
        remedy="Take those images again or leave them out.",
        facts=some_views([r.name for r in refused]),
    )


def _facing(evidence: Evidence) -> tuple[Measurement, Measurement]:
    # Along the line of sight to the board's centre, not along the camera's axis: a fisheye looks sideways.
    rotations, translations = stack_poses(evidence.result.poses)
    centres = rotations @ evidence.target.centre + translations
    sight = centres / np.linalg.norm(centres, axis=1, keepdims=True)
    points = evidence.board @ np.swapaxes(rotations, 1, 2) + translations[:, None]
    facing = np.sum(rotations[:, :, 2] * sight, axis=1)
    depth = (points @ sight[:, :, None])[..., 0].min(axis=1)
    return (
        check_limit(
            GATE,
            "facing",
            float(facing.min()),
            ">=",
            0.0,
            good="The board faces the camera in every view.",
            bad=f"The solution shows the back of the board in {evidence.names[facing.argmin()]}.",
            remedy="Take that image again; if it is mirrored, switch off mirroring in the camera.",
            facts=some_views([evidence.names[facing.argmin()]]),
        ),
        check_limit(
            GATE,
            "nearest_corner",
            float(depth.min()),
            ">=",
            0.0,
            unit="m",
            good="The board is in front of the camera in every view.",
            bad=f"The solution puts the board behind the camera in {evidence.names[depth.argmin()]}.",
            remedy="Take that image again.",
            facts=some_views([evidence.names[depth.argmin()]]),
        ),
    )


def _parity(evidence: Evidence) -> Measurement:
    worst = min(evidence.views, key=lambda view: view.detection.parity_separation)
    return check_limit(
        GATE,
        "parity_separation",
        worst.detection.parity_separation,
        ">=",
        evidence.limits,
        good="Dark and bright squares are clearly apart in every view.",
        bad=f"In {worst.name} dark and bright squares are hard to tell apart.",
        remedy="Light the board evenly, without reflections, and check that it is the declared one.",
        facts=some_views([worst.name]),
    )


def _contrast(evidence: Evidence) -> Measurement:
    worst = min(evidence.views, key=lambda view: view.detection.contrast)
    return check_limit(
        GATE,
        "contrast",
        worst.detection.contrast,
        ">=",
        evidence.limits,
        unit="grey levels",
        good="The contrast is sufficient in every view.",
        bad=f"Dark and bright squares differ too little in {worst.name}.",
        remedy="Give more light or a longer exposure.",
        facts=some_views([worst.name]),
    )


def _saturation(evidence: Evidence) -> tuple[Measurement, ...]:
    """Judge the most saturated view; nothing where no view tells, as in runs of before it was measured."""
    known = [view for view in evidence.views if not math.isnan(view.detection.saturated_share)]
    if not known:
        return ()
    worst = max(known, key=lambda view: view.detection.saturated_share)
    return (
        check_limit(
            GATE,
            "saturated_share",
            worst.detection.saturated_share,
            "<=",
            evidence.limits,
            good="Hardly any bright square is saturated.",
            bad=f"In {worst.name} bright squares are saturated, which hides how the light fell.",
            remedy="Dim the lamp, shade the window or shorten the exposure, then take it again.",
            facts=some_views([worst.name]),
        ),
    )
