"""A pose that is not reached: another one first, written down, and known again after a restart."""

from typing import Any

from sqlalchemy import select

from service.storage.models import AuditEntryRow
from service.usecases import guide
from service.usecases.guide import GuidedSession, open_session, resume_session
from service.usecases.guide_frames import RawFrame
from service.usecases.guide_next_pose import POSTPONE
from service.usecases.guide_views import AcceptedView, RefusedView, StateView, VerdictView, WantedFrame
from tests.guiding import pixels
from tests.plant import pose_set
from tests.usecases.test_guide import WISH, guided

__all__ = ["guided"]
POSES = len(pose_set().poses)
HELD = 3  # the pose in which this operator keeps the board


class Stubborn:
    """Holds the board in one pose and does not move."""

    def __init__(self) -> None:
        self.sequence = 0

    def see(self, session: GuidedSession, frames: int, pose: int = HELD) -> list[Any]:
        told = []
        for _ in range(frames):
            self.sequence += 1
            told += session.see(RawFrame(self.sequence, pixels(pose), 1, self.sequence * 0.25))
            for wanted in [one for one in told if isinstance(one, WantedFrame)]:
                told.remove(wanted)
                told += session.keep(wanted.sequence, pixels(pose))
        return told


def facts(plant: guide.Plant, action: str) -> list[dict[str, Any]]:
    with plant.database.read() as session:
        query = select(AuditEntryRow).where(AuditEntryRow.action == action).order_by(AuditEntryRow.id)
        return [row.facts for row in session.scalars(query)]


def test_whoever_does_not_reach_a_pose_gets_the_one_that_the_board_is_in(guided: guide.Plant) -> None:
    session = open_session(guided, "cal1", WISH, "test")

    told = Stubborn().see(session, 95)

    (entry,) = facts(guided, POSTPONE)
    assert (entry["pose_index"], entry["next_index"]) == (0, HELD)
    assert entry["tried_s"] > 20
    changed = next(one for one in told if isinstance(one, StateView) and one.instead_of is not None)
    assert (changed.pose_index, changed.instead_of) == (HELD, 0)
    assert [one.pose_index for one in told if isinstance(one, AcceptedView)] == [HELD]


def test_the_pose_that_was_put_off_comes_last_also_in_a_resumed_run(guided: guide.Plant) -> None:
    first = open_session(guided, "cal1", WISH, "test")
    Stubborn().see(first, 95)

    session, hand, asked = resume_session(guided, first.run.id, "test"), Stubborn(), []
    told: list[Any] = []
    while not any(isinstance(one, VerdictView) for one in told):
        wanted = session.show_run().pose_index
        assert wanted is not None
        asked.append(wanted)
        told = hand.see(session, 6, wanted)

    assert asked == [i for i in range(1, POSES) if i != HELD] + [0]


def test_a_forced_capture_is_recorded_with_what_it_did_not_meet(guided: guide.Plant) -> None:
    session = open_session(guided, "cal1", WISH, "test")
    Stubborn().see(session, 4)

    (refused,) = session.capture()
    (wanted,) = session.capture(is_forced=True)
    assert isinstance(wanted, WantedFrame)
    (accepted, *_) = session.keep(wanted.sequence, pixels(HELD))

    assert isinstance(refused, RefusedView)
    assert refused.error.code == "pose-not-matched"
    assert isinstance(accepted, AcceptedView)
    (entry,) = facts(guided, "capture.add")
    assert (entry["trigger"], entry["overridden"]) == ("manual", ["not-matched"])


def test_an_automatic_capture_is_recorded_as_one(guided: guide.Plant) -> None:
    Stubborn().see(open_session(guided, "cal1", WISH, "test"), 6, pose=0)

    (entry,) = facts(guided, "capture.add")
    assert entry["trigger"] == "automatic"
    assert "overridden" not in entry


def test_an_empty_picture_is_refused_with_what_to_do(guided: guide.Plant) -> None:
    session = open_session(guided, "cal1", WISH, "test")
    session.see(RawFrame(1, 0 * pixels(0) + 100, 1, 0.1))

    (refused,) = session.capture(is_forced=True)

    assert isinstance(refused, RefusedView)
    assert refused.error.code == "picture-unfit"
    assert refused.error.facts == {"reason": "absent", "hint": "show-board"}
