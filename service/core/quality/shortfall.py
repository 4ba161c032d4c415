"""What the captures of all poses lack, where one pose more may mend it.

A weak capture spoils the result by itself: a pose in its place mends that. Too little accuracy is mended by
more information. Whatever else fails (a wrong lens, two cameras) is no matter of one pose more. Not here:
which pose that would be (`planning`).
"""

from dataclasses import dataclass

from service.core.quality.gates import Measurement, Verdict
from service.core.quality.gates_certainty import GATE as CERTAINTY
from service.core.quality.reasons import Reason
from service.core.quality.verdict import Judged

OF_ONE_VIEW = {
    Reason.PARITY_SEPARATION,
    Reason.CONTRAST,
    Reason.EDGE_WIDTH,
    Reason.MATCH,
    Reason.WORST_VIEW_RATIO,
}


@dataclass(frozen=True)
class Shortfall:
    """What is lacking: the required accuracy, or, with the name of a view, a capture worth keeping."""

    weak_view: str | None = None


def find_shortfall(judged: Judged, required_px: float) -> Shortfall | None:
    """Return what one pose more may mend, None where nothing is lacking or it would not help.

    required_px: the mean mapping error over the working zone that the SKU asks for.
    """
    failed = [one for one in judged.measurements if one.verdict is Verdict.FAIL]
    for one in failed:
        views = one.facts.get("views")
        if one.reason in OF_ONE_VIEW and isinstance(views, list) and views:
            return Shortfall(str(views[0]))
    if any(not _is_of_accuracy(one) for one in failed):
        return None
    return Shortfall() if failed or not judged.zone_mapping.mean_px <= required_px else None


def _is_of_accuracy(measurement: Measurement) -> bool:
    return measurement.gate == CERTAINTY or measurement.reason is Reason.COVERAGE
