"""Guided sessions on the small plant, without a socket."""

import pytest

from service.core.errors import PoseTaken, ServiceError
from service.core.guidance.problems import OtherSkuOpen
from service.core.run import Purpose
from service.usecases import guide
from service.usecases.guide import GuidedSession, open_session, resume_session
from service.usecases.guide_runs import Wish
from service.usecases.guide_views import (
    AcceptedView,
    ClosedView,
    GuidedRunView,
    RefusedView,
    StateView,
    Told,
    VerdictView,
    WantedFrame,
)
from tests.guiding import Film, add_station, pixels
from tests.plant import SKU, Plant, poses_json

POSES = len(poses_json())
WISH = Wish("VIN-1", "tiny")


@pytest.fixture
def guided(small_plant: Plant) -> guide.Plant:
    """What sessions work on, with a published SKU and a station."""
    small_plant.publish_sku()
    add_station(small_plant, source="browser")
    services = small_plant.app.state.services
    return guide.Plant(
        services.database,
        services.blobs,
        services.clock,
        services.signing_keys,
        services.max_image_pixels,
    )


def run_film(session: GuidedSession, film: Film, until: type, frames: int = 400) -> list[Told]:
    """Everything that is told until something of a kind is."""
    heard: list[Told] = []
    for _ in range(frames):
        told = session.see(film.next_frame(session.hints, 1 / 15))
        for wanted in [one for one in told if isinstance(one, WantedFrame)]:
            if until is WantedFrame:
                return [*heard, wanted]
            told = [*told, *session.keep(wanted.sequence, film.capture(wanted.sequence))]
        heard += told
        if any(isinstance(one, until) for one in told):
            return heard
    raise AssertionError(f"no {until.__name__} in {frames} frames")


def test_a_session_captures_every_pose_and_ends_with_the_verdict(guided: guide.Plant) -> None:
    session = open_session(guided, "cal1", WISH, "test")

    told = run_film(session, Film(), VerdictView)

    accepted = [one for one in told if isinstance(one, AcceptedView)]
    assert sorted(one.pose_index for one in accepted) == list(range(POSES))
    assert [len(one.captured) for one in accepted] == list(range(1, POSES + 1))
    assert isinstance(told[-1], VerdictView)
    assert told[-1].verdict == "PASS"
    assert session.is_over


def test_a_frame_is_told_as_a_state_with_the_board_and_its_ghost(guided: guide.Plant) -> None:
    session = open_session(guided, "cal1", WISH, "test")

    state = session.see(Film().next_frame((), 0.1))[0]

    assert isinstance(state, StateView)
    assert state.seen is not None
    assert state.ghost is not None
    assert state.difference is not None
    assert state.difference["corner_px"] < 5
    assert (state.captured, state.total) == (0, POSES)


def test_a_resumed_session_asks_for_the_pose_that_is_missing(guided: guide.Plant) -> None:
    first = open_session(guided, "cal1", WISH, "test")
    told = run_film(first, Film(), AcceptedView)
    accepted = next(one for one in told if isinstance(one, AcceptedView))

    again = open_session(guided, "cal1", WISH, "somebody else")
    shown = again.show_run()

    assert again.run.id == first.run.id
    assert shown.captured == [accepted.pose_index]
    assert shown.pose_index not in shown.captured


def test_a_run_that_was_killed_after_its_last_capture_is_finished_when_it_is_resumed(
    guided: guide.Plant, small_plant: Plant
) -> None:
    run_id = small_plant.open_run("VIN-1", station="cal1")
    for index in range(POSES):
        small_plant.upload(run_id, index)

    told = open_session(guided, "cal1", WISH, "test").begin()

    assert isinstance(told[-1], VerdictView)
    assert small_plant.get(f"/runs/{run_id}").json()["verdict"] == "PASS"


def test_an_undone_capture_is_withdrawn_and_asked_for_again(guided: guide.Plant, small_plant: Plant) -> None:
    session = open_session(guided, "cal1", WISH, "test")
    run_film(session, Film(), AcceptedView)

    (shown,) = session.undo()

    assert isinstance(shown, GuidedRunView)
    assert shown.captured == []
    assert small_plant.get(f"/runs/{session.run.id}").json()["captures"] == 0


def test_a_pose_that_came_over_another_interface_is_not_asked_for_again(
    guided: guide.Plant, small_plant: Plant
) -> None:
    session, film = open_session(guided, "cal1", WISH, "test"), Film()
    run_film(session, film, WantedFrame)
    small_plant.upload(str(session.run.id), 0)
    wanted = session._wanted
    assert wanted is not None

    refused, shown, *_ = session.keep(wanted.sequence, pixels(wanted.pose_index))

    assert isinstance(refused, RefusedView)
    assert isinstance(refused.error, PoseTaken)
    assert isinstance(shown, GuidedRunView)
    assert shown.captured == [0]


def test_a_full_frame_is_kept_only_once(guided: guide.Plant) -> None:
    session, film = open_session(guided, "cal1", WISH, "test"), Film()
    wanted = run_film(session, film, WantedFrame)[-1]
    assert isinstance(wanted, WantedFrame)

    first = session.keep(wanted.sequence, film.capture(wanted.sequence))
    second = session.keep(wanted.sequence, film.capture(wanted.sequence))

    assert isinstance(first[0], AcceptedView)
    assert second == []


def test_an_aborted_session_is_over(guided: guide.Plant, small_plant: Plant) -> None:
    session = open_session(guided, "cal1", WISH, "test")

    (closed,) = session.abort()

    assert isinstance(closed, ClosedView)
    assert session.is_over
    assert small_plant.get(f"/runs/{session.run.id}").json()["state"] == "aborted"


def test_an_open_run_of_another_sku_is_not_taken(guided: guide.Plant, small_plant: Plant) -> None:
    open_session(guided, "cal1", WISH, "test")
    small_plant.expect(201, small_plant.post("/skus", {**SKU, "code": "other"}))

    with pytest.raises(OtherSkuOpen, match="tiny"):
        open_session(guided, "cal1", Wish("VIN-1", "other"), "test")


@pytest.mark.parametrize(
    ("asked", "given"), [(None, Purpose.RETEST), (Purpose.GOLDEN, Purpose.GOLDEN)], ids=["scanned", "named"]
)
def test_a_serial_with_a_result_is_a_retest_unless_a_purpose_is_named(
    guided: guide.Plant, small_plant: Plant, asked: Purpose | None, given: Purpose
) -> None:
    first = open_session(guided, "cal1", Wish("VIN-1", "tiny"), "test")
    resumed = open_session(guided, "cal1", Wish("VIN-1", "tiny"), "test")
    run_film(resumed, Film(), VerdictView)

    again = open_session(guided, "cal1", Wish("VIN-1", "tiny", asked), "test")
    other = open_session(guided, "cal1", Wish("VIN-2", "tiny"), "test")

    assert resumed.run.id == first.run.id != again.run.id
    assert [one.show_run().purpose for one in (first, again, other)] == [
        Purpose.PRODUCTION,
        given,
        Purpose.PRODUCTION,
    ]


def test_a_run_without_a_result_makes_no_retest(guided: guide.Plant, small_plant: Plant) -> None:
    open_session(guided, "cal1", Wish("VIN-1", "tiny"), "test").abort()
    trial = small_plant.open_run("VIN-1", purpose="trial")
    for index in range(POSES):
        small_plant.upload(trial, index)
    small_plant.expect(200, small_plant.finish(trial))

    again = open_session(guided, "cal1", Wish("VIN-1", "tiny"), "test")

    assert again.run.purpose is Purpose.PRODUCTION


def test_a_run_without_a_pose_set_cannot_be_guided(guided: guide.Plant, small_plant: Plant) -> None:
    small_plant.expect(201, small_plant.post("/skus", {**SKU, "code": "bare"}))
    small_plant.expect(200, small_plant.post("/skus/bare/revisions/1/publish"))

    with pytest.raises(ServiceError, match="pose set"):
        open_session(guided, "cal1", Wish("VIN-2", "bare", Purpose.TRIAL), "test")

    assert small_plant.get("/runs").json()["items"] == []


def test_a_session_of_an_unknown_run_is_refused(guided: guide.Plant, small_plant: Plant) -> None:
    session = open_session(guided, "cal1", WISH, "test")

    assert resume_session(guided, session.run.id, "test").run.serial == "VIN-1"
    assert session.miss(5) == []
