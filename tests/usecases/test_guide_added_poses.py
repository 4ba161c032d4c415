"""Poses beyond the set in a guided run: stored before they are asked for, and counted by the gates."""

from typing import Any
from uuid import UUID

import pytest
from numpy.typing import NDArray
from sqlalchemy import select

from service.core.vision.camera import project
from service.core.vision.transforms import Pose
from service.storage.models import CalibrationRow
from service.usecases import guide
from service.usecases.finish import recompute
from service.usecases.guide import GuidedSession, open_session, resume_session
from service.usecases.guide_frames import RawFrame
from service.usecases.guide_views import GuidedRunView, VerdictView, WantedFrame
from service.usecases.planning import PlanRequest, plan_for
from tests.guiding import add_station
from tests.plant import Plant, encode, pose_set, revision, shown_at
from tests.usecases.test_guide import WISH
from tests.usecases.test_guide_next_pose import facts

POSES = pose_set().poses
COUNT = len(POSES)


class Hand:
    """Holds the board in a pose until something else is asked for."""

    def __init__(self) -> None:
        self.sequence = 0

    def hold(self, session: GuidedSession, pose: Pose, frames: int = 6) -> list[Any]:
        """Everything that is told meanwhile."""
        image: NDArray[Any] = shown_at(pose, self.sequence)
        told: list[Any] = []
        for _ in range(frames):
            if session.is_over:
                break
            self.sequence += 1
            told += session.see(RawFrame(self.sequence, image, 1, self.sequence * 0.25))
            for wanted in [one for one in told if isinstance(one, WantedFrame)]:
                told.remove(wanted)
                told += session.keep(wanted.sequence, image)
        return told


def published(plant: Plant, **changes: Any) -> guide.Plant:
    plant.publish_sku(**changes)
    add_station(plant, source="browser")
    services = plant.app.state.services
    return guide.Plant(
        services.database, services.blobs, services.clock, services.signing_keys, services.max_image_pixels
    )


def with_captures(plant: Plant, indices: range, **blurred: float) -> str:
    run_id = plant.open_run("VIN-1", station="cal1")
    for index in indices:
        image = shown_at(POSES[index], index, blurred.get(f"pose{index}", 0.5))
        plant.expect(201, plant.send(run_id, encode(image), pose_index=index))
    return run_id


def asked(session: GuidedSession) -> Pose:
    current = session._state.current
    assert current is not None
    return session._state.expected[current]


def is_recomputed(guided: guide.Plant, run_id: UUID) -> bool:
    with guided.database.read() as session:
        stored = session.scalars(select(CalibrationRow).where(CalibrationRow.run_id == run_id)).one()
        return bool(recompute(session, run_id) == stored.document)


def test_a_run_short_of_accuracy_asks_for_a_new_pose_and_again_after_a_restart(small_plant: Plant) -> None:
    guided = published(small_plant, required_mapping_px=1e-4, extra_poses=1)
    with_captures(small_plant, range(COUNT))

    first = open_session(guided, "cal1", WISH, "test")
    shown = first.begin()[-1]
    resumed = resume_session(guided, first.run.id, "elsewhere")
    again = resumed.begin()[-1]

    assert isinstance(shown, GuidedRunView)
    assert again == shown
    assert (shown.pose_index, shown.total, len(shown.poses)) == (COUNT, COUNT + 1, COUNT + 1)
    assert (shown.poses[-1].added_for, shown.poses[-1].replaces) == ("accuracy", None)
    told = Hand().hold(resumed, asked(resumed))
    assert isinstance(told[-1], VerdictView)
    assert told[-1].verdict == "PASS"
    stored = small_plant.get(f"/runs/{first.run.id}").json()
    assert [one["pose_index"] for one in stored["added_poses"]] == [COUNT]
    assert stored["captures"] == COUNT + 1
    assert facts(guided, "run.add_pose") == [{"pose_index": COUNT, "reason": "accuracy"}]
    assert is_recomputed(guided, first.run.id)


def test_of_two_sessions_of_a_run_both_ask_for_the_pose_of_the_faster_one(small_plant: Plant) -> None:
    guided = published(small_plant, required_mapping_px=1e-4)
    with_captures(small_plant, range(COUNT))
    fast, slow = (open_session(guided, "cal1", WISH, name) for name in ("fast", "slow"))
    slow._hand = POSES[0]

    fast.begin()
    slow.begin()

    assert asked(slow).tvec.tolist() == asked(fast).tvec.tolist()
    assert len(facts(guided, "run.add_pose")) == 1


def test_a_weak_capture_is_withdrawn_and_a_new_pose_taken_in_its_place(small_plant: Plant) -> None:
    guided = published(small_plant)
    run_id = with_captures(small_plant, range(COUNT), pose3=1.5)

    session = open_session(guided, "cal1", WISH, "test")
    shown = session.begin()[-1]

    assert isinstance(shown, GuidedRunView)
    assert 3 not in shown.captured
    assert (shown.poses[-1].added_for, shown.poses[-1].replaces) == ("weak-capture", 3)
    assert (len(shown.captured), shown.total) == (COUNT - 1, COUNT)
    assert Hand().hold(session, asked(session))[-1].verdict == "PASS"
    assert is_recomputed(guided, UUID(run_id))


def test_a_pose_out_of_reach_is_replaced_by_one_well_away_from_it(small_plant: Plant) -> None:
    guided = published(small_plant)
    with_captures(small_plant, range(COUNT - 1))
    session, hand = open_session(guided, "cal1", WISH, "test"), Hand()
    unreached = asked(session)

    told = hand.hold(session, POSES[0], 90)

    changed = next(one for one in told if isinstance(one, GuidedRunView))
    assert (changed.pose_index, changed.poses[-1].replaces) == (COUNT, COUNT - 1)
    assert changed.poses[-1].added_for == "out-of-reach"
    (entry,) = facts(guided, "run.add_pose")
    assert entry["tried_s"] > 20
    moved = distance_px(unreached, asked(session))
    assert moved > 0.12 * revision().intrinsics.image_size[0]
    assert hand.hold(session, asked(session))[-1].verdict == "PASS"
    gates = small_plant.get(f"/runs/{session.run.id}/result").json()["gates"]
    (missing,) = [gate for gate in gates if gate["name"] == "missing_poses"]
    assert (missing["value"], missing["verdict"]) == (0.0, "PASS")


def test_a_run_ends_early_once_its_accuracy_is_proven_and_every_gate_passes(small_plant: Plant) -> None:
    planned = plan_for(revision(), PlanRequest(seed=2, candidates=300, draws=1), count=12)
    poses = [{"rvec": list(pose.rvec), "tvec": list(pose.tvec)} for pose in planned.poses]
    guided = published(small_plant, poses=poses, early_finish_poses=8, pose_count=12)
    session, hand = open_session(guided, "cal1", WISH, "test"), Hand()

    told: list[Any] = []
    while not session.is_over:
        told = hand.hold(session, asked(session))

    taken = small_plant.get(f"/runs/{session.run.id}").json()["captures"]
    result = small_plant.get(f"/runs/{session.run.id}/result").json()
    assert 8 <= taken < 12
    assert told[-1].verdict == "PASS"
    assert result["early_finish"]["taken"] == taken
    assert result["early_finish"]["proven_px"] <= result["early_finish"]["required_px"]
    (finished,) = facts(guided, "run.finish")
    assert (finished["taken"], finished["not_needed"]) == (taken, 12 - taken)
    assert is_recomputed(guided, session.run.id)


def test_the_estimate_grows_with_the_captures_and_ends_where_the_result_is(small_plant: Plant) -> None:
    guided = published(small_plant)
    with_captures(small_plant, range(COUNT - 1))
    session = open_session(guided, "cal1", WISH, "test")

    before = session.show_run().estimate
    told = Hand().hold(session, asked(session))
    after = session.show_run().estimate
    result = small_plant.get(f"/runs/{session.run.id}/result").json()

    assert before is not None
    assert after is not None
    assert isinstance(told[-1], VerdictView)
    assert (before.captures, after.captures) == (COUNT - 1, COUNT)
    assert after.mapping_mean_px == pytest.approx(result["mapping"]["zone_mean_px"], rel=1e-3)
    for name, value in result["intrinsics"].items():
        assert abs(after.parameters[name] - value) <= 0.02 * result["sd"][name]
    assert after.reached == 1.0


def distance_px(first: Pose, second: Pose) -> float:
    """The mean distance of the corners of two poses in the nominal image."""
    sku = revision()
    seen = [project(sku.intrinsics, p.rotation, p.tvec, sku.target.object_points) for p in (first, second)]
    return float(((seen[0] - seen[1]) ** 2).sum(axis=1).mean() ** 0.5)
