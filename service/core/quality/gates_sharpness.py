"""The sharpness gate: is the lens in focus, and is it in focus everywhere?

RMS is blind to a defocused lens until the blur has a sigma of four pixels; the width of the edges is not. A
tilted or decentred lens is soft in one part of the image only. Near and far parts of one tilted board differ
as well, so that quadrants are compared by their median over the views, while the width itself must hold in
each view.
"""

import numpy as np
from numpy.typing import NDArray

from service.core.quality.evidence import Evidence
from service.core.quality.gates import Measurement, check_limit
from service.core.quality.gates_frame import some_views
from service.core.quality.reasons import Facts, Reason

GATE = "sharpness"
QUADRANTS = ("top left", "top right", "bottom right", "bottom left")


def measure_sharpness(evidence: Evidence) -> tuple[Measurement, ...]:
    """Return the measurements of the sharpness gate."""
    quadrants = _quadrant_ratio(evidence)
    return (_edge_width(evidence), *((quadrants,) if quadrants else ()))


def _edge_width(evidence: Evidence) -> Measurement:
    # A view whose edges could not be measured is no sharper than the softest one.
    widths = [np.nan_to_num(v.detection.sharpness.edge_width_px, nan=np.inf) for v in evidence.views]
    limit = evidence.limits.edge_width_px
    blurred, remedy, reason, facts = _who_is_blurred(
        evidence, np.array(widths) > limit, int(np.argmax(widths))
    )
    return check_limit(
        GATE,
        "edge_width_px",
        float(max(widths)),
        "<=",
        limit,
        unit="px",
        share=evidence.limits.share("edge_width_px"),
        good="Every view is sharp.",
        bad=blurred,
        remedy=remedy,
        reason=reason,
        facts=facts,
    )


def _who_is_blurred(
    evidence: Evidence, is_blurred: NDArray[np.bool_], worst: int
) -> tuple[str, str, Reason, Facts]:
    """Say which views are blurred and what helps: one view is taken again, most of them mean the lens."""
    count, views = int(is_blurred.sum()), len(evidence.views)
    if count > views / 2:
        said = (f"{count} of {views} views are blurred.", "Focus the lens, then take the views again.")
        return *said, Reason.BLURRED_LENS, {"count": count, "of": views}
    names = evidence.views[worst].name + (f" and {count - 1} more" if count > 1 else "")
    return (
        f"{names} {'are' if count > 1 else 'is'} blurred.",
        f"Take {names} again: hold the board still, shorten the exposure, or keep it further away.",
        Reason.EDGE_WIDTH,
        {**some_views([evidence.views[worst].name]), "more": max(0, count - 1)},
    )


def _quadrant_ratio(evidence: Evidence) -> Measurement | None:
    """Compare each quadrant with the centre over all views; None where no view has edges in both."""
    ratios = np.array(
        [
            np.array(view.detection.sharpness.quadrants_px) / view.detection.sharpness.centre_px
            for view in evidence.views
        ]
    )
    seen = [column[np.isfinite(column)] for column in ratios.T]
    medians = [float(np.median(column)) if column.size else -np.inf for column in seen]
    worst = int(np.argmax(medians))
    if not np.isfinite(medians[worst]):
        return None
    return check_limit(
        GATE,
        "quadrant_ratio",
        medians[worst],
        "<=",
        evidence.limits,
        good="All quadrants are as sharp as the centre.",
        bad=f"The image is softer {QUADRANTS[worst]} than in its centre: the lens is tilted or decentred.",
        remedy="Check how the lens is mounted and focused.",
        facts={"quadrant": QUADRANTS[worst].replace(" ", "-")},
    )
