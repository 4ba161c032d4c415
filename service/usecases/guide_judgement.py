"""What a guidance session is told of its captures: whether the run may end, and what one pose more may mend.

Judged as the finished run would be, so that both say the same. Not here: what follows from it (the session's
reducer), and the result itself (`finish`).
"""

from service.core.errors import DegenerateViews, TooFewViews
from service.core.guidance.actions import AddedFor, CapturesJudged
from service.core.guidance.session_state import SessionState
from service.core.quality.gates import Verdict
from service.core.quality.shortfall import find_shortfall
from service.storage.database import Database
from service.usecases.calibration_input import CalibrationInput, calibrate, load_input
from service.usecases.guide_estimate import Estimate
from service.usecases.guide_runs import GuidedRun
from service.usecases.runs import get_run

NOT_YET = CapturesJudged()


def judge_captures(
    database: Database, run: GuidedRun, state: SessionState, estimate: Estimate | None
) -> CapturesJudged:
    """Return what the captures of a run are worth.

    Looked at only where every pose is taken, or where the running estimate proves the accuracy of a run that
    may end early; such a run ends only if every gate passes.
    """
    early = run.revision.early_finish
    proves = estimate is not None and estimate.is_proven
    may_end = early is not None and proves and len(state.captured) >= early.smallest_poses
    if state.current is not None and not may_end:
        return NOT_YET
    with database.read() as session:
        source = load_input(session, get_run(session, run.id))
    try:
        judged = calibrate(source)
    except (TooFewViews, DegenerateViews):
        return CapturesJudged(lacks=AddedFor.ACCURACY)
    is_enough = judged.verdict is Verdict.PASS
    shortfall = find_shortfall(judged, run.revision.required_mapping_px)
    if shortfall is None:
        return CapturesJudged(is_enough)
    weak = None if shortfall.weak_view is None else _pose_of(source, shortfall.weak_view)
    return CapturesJudged(is_enough, AddedFor.ACCURACY if weak is None else AddedFor.WEAK_CAPTURE, weak)


def _pose_of(source: CalibrationInput, view: str) -> int | None:
    """Return the pose that a view was taken for; None for an image that was sent without one."""
    answers = source.expectation.pose_of_view or ()
    names = [detection.name for detection in source.detections]
    return dict(zip(names, answers, strict=False)).get(view)
