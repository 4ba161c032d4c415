"""The fit gate: do views, board and lens model agree with each other as well as corners can be located?

Necessary and never sufficient: a duplicated view, a wrong board and two mixed cameras all fit well.

Pictures rendered without noise, whose corners are off by their rounding to 8 bits only, still leave an RMS of
0.003 px, rendered ones with a sensor's noise 0.007 px, the best real ones 0.08 px. What fits better than half
of the first was never in a picture: corners that were computed, or a file that was made up.
"""

import numpy as np

from service.core.quality.evidence import Evidence
from service.core.quality.gates import OTHER_LENS, Measurement, check_limit, report_value
from service.core.quality.gates_frame import some_views
from service.core.quality.reasons import Facts, Reason
from service.core.quality.residual_causes import Causes, explain_residuals
from service.core.vision.residuals import outlier_share, view_rms

GATE = "fit"
# Views that fit better than this differ by rounding only, and not by anything an operator could do better.
VIEW_FLOOR_PX = 0.02
CLEAR_SHARE = 0.3  # of the squared residuals; real boards of printed paper reach it, noise stays below 0.05


def measure_fit(evidence: Evidence) -> tuple[Measurement, ...]:
    """Return the measurements of the fit gate."""
    causes = explain_residuals(evidence)
    return (
        _rms(evidence, causes),
        _smallest_rms(evidence),
        _worst_view(evidence),
        _outliers(evidence),
        _bend(evidence, causes),
    )


def _rms(evidence: Evidence, causes: Causes) -> Measurement:
    remedy, reason, facts = _remedy(evidence, causes)
    return check_limit(
        GATE,
        "rms_px",
        evidence.result.rms_px,
        "<=",
        evidence.limits,
        unit="px",
        good="Board, lens model and corners agree.",
        bad="The corners do not fit the model.",
        remedy=remedy,
        reason=reason,
        facts=facts,
    )


def _remedy(evidence: Evidence, causes: Causes) -> tuple[str, Reason, Facts]:
    """Return the likely cause of large residuals and what to do about it, with its code and facts."""
    lens = evidence.result.intrinsics.lens
    if not evidence.result.converged:
        said = f"See the model gate first: the lens model {lens} may not describe this lens."
        return said, Reason.RMS_NO_OPTIMUM, {"lens": lens}
    if causes.board_share > max(CLEAR_SHARE, causes.lens_share):
        bend = causes.bend_m / evidence.target.square_m
        said = (
            "The residuals repeat with the corners of the board, which is probably not flat "
            f"(bent by about {bend:.0%} of a square). Mount the pattern on a rigid, flat plate."
        )
        return said, Reason.RMS_BENT_BOARD, {"bend": bend}
    if causes.lens_share > CLEAR_SHARE:
        said = (
            f"The residuals repeat with the distance from the image centre, so the lens model {lens} does "
            f"not describe this lens (a fisheye or a very wide lens?). {OTHER_LENS}"
        )
        return said, Reason.RMS_OTHER_LENS, {"lens": lens}
    said = (
        "Check that all images are of one camera and unscaled, that the board is the declared one, rigid and "
        "flat, and that nothing moved while the pictures were taken."
    )
    return said, Reason.RMS, {}


def _smallest_rms(evidence: Evidence) -> Measurement:
    return check_limit(
        GATE,
        "smallest_rms_px",
        evidence.result.rms_px,
        ">=",
        evidence.limits.smallest_rms_px,
        unit="px",
        good="The residuals are as large as real corners make them.",
        bad="The corners fit better than corners of real images can: they were computed or copied.",
        remedy="Use images of the camera.",
    )


def _worst_view(evidence: Evidence) -> Measurement:
    views = view_rms(evidence.result.residuals)
    worst = evidence.names[int(views.argmax())]
    return check_limit(
        GATE,
        "worst_view_ratio",
        float(views.max() / max(np.median(views), VIEW_FLOOR_PX)),
        "<=",
        evidence.limits,
        good="No view fits much worse than the others.",
        bad=f"{worst} fits much worse than the other views.",
        remedy=f"Look at the corners of {worst} and take it again.",
        facts=some_views([worst]),
    )


def _outliers(evidence: Evidence) -> Measurement:
    share = outlier_share(evidence.result.residuals, evidence.result.sigma_px)
    return check_limit(
        GATE,
        "outlier_share",
        share,
        "<=",
        evidence.limits,
        good="Hardly any corner lies off.",
        bad=f"{share:.1%} of the corners lie more than four sigma off.",
        remedy="Look for reflections, dirt or something in front of the board.",
    )


def _bend(evidence: Evidence, causes: Causes) -> Measurement:
    return report_value(
        GATE,
        "board_bend",
        causes.bend_m / evidence.target.square_m,
        unit="squares",
        advice="Out-of-plane shape of the board that fits best, peak to peak; "
        f"it explains {causes.board_share:.0%} of the squared residuals.",
        facts={"share": causes.board_share},
    )
