"""The shape of a station's board: learnt from its runs, certified, used by solves, watched."""

import time
from datetime import timedelta
from uuid import UUID

import numpy as np
import pytest
from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.quality.gates import Verdict
from service.core.run import Outcome, Purpose, RunState
from service.core.vision.camera import project
from service.core.vision.tolerance import Tolerance, draw_camera
from service.core.vision.transforms import Array
from service.storage.learnt import BoardShapeRow
from service.storage.models import CalibrationRow, JobRow, MeasurementRow, RunRow, SkuRevisionRow, TargetRow
from service.storage.words import CaptureRole, Role, ShapeState
from service.usecases.board_learning import WATCH_EVERY, teaching_runs, watch_board
from service.usecases.finish import recompute
from tests.fakes import START
from tests.plant import JsonObject, Plant, pose_set, problem, revision
from tests.storage.make import make_capture

POINTS = revision().target.object_points
ALONG = POINTS[:, 0] / POINTS[:, 0].max() - 0.5
SIGMA_PX = 0.05


def bowed(bow_mm: float) -> Array:
    """Corners (n, 3), m, of a plate that is bowed by so much, peak to peak."""
    return POINTS + np.outer(1e-3 * bow_mm * ALONG**2 / np.ptp(ALONG**2), [0.0, 0.0, 1.0])


def add_run(session: Session, serial: str, board: Array, seed: int, *, is_open: bool = False) -> RunRow:
    """Add a run at the station with the board, with computed corners of a camera of its own."""
    rng = np.random.default_rng(seed)
    camera = draw_camera(revision().intrinsics, Tolerance(), rng)
    target = session.scalars(select(TargetRow)).one()
    run = RunRow(
        sku_revision_id=session.scalars(select(SkuRevisionRow.id)).one(),
        target_id=target.id,
        serial=serial,
        purpose=Purpose.TRIAL,
        state=RunState.OPEN if is_open else RunState.FINISHED,
        verdict=None if is_open else Verdict.FAIL,
        outcome=None if is_open else Outcome.COMPLETED,
        created_by="test",
        created_at=START + timedelta(minutes=seed),
        finished_at=None if is_open else START + timedelta(minutes=seed),
    )
    session.add(run)
    for i, pose in enumerate(pose_set().poses):
        seen = project(camera, pose.rotation, pose.tvec, board) + rng.normal(0.0, SIGMA_PX, (len(board), 2))
        capture = make_capture(run, i + 1, f"{seed:032x}{i:032x}")
        capture.image_size, capture.pose_index = list(camera.image_size), i
        capture.corners, capture.corner_ids = seen.tolist(), list(range(len(board)))
        capture.sharpness = {"edge_width_px": 2.0, "quadrants_px": [2.0] * 4, "centre_px": 2.0}
        session.add(capture)
    return run


def add_result(session: Session, run: RunRow, failed: str) -> None:
    """Add a result in which one measurement failed."""
    calibration = CalibrationRow(
        run_id=run.id,
        verdict=Verdict.FAIL,
        lens="pinhole5",
        intrinsics={},
        covariance=[],
        rms_px=0.1,
        sigma_px=0.1,
        document={},
        versions={},
        created_at=START,
    )
    measurement = MeasurementRow(
        calibration_id=calibration.id,
        gate="",
        name=failed,
        value=1.0,
        unit="",
        limit=0.5,
        comparison="<=",
        margin=-0.5,
        verdict=Verdict.FAIL,
        advice="",
    )
    session.add_all([calibration, measurement])


def learn(plant: Plant, runs: int) -> JsonObject:
    """Have the board's shape learnt, wait for it, and return it."""
    asked = plant.post("/targets/BOARD-1/shape", {"runs": runs}, role=Role.ENGINEER)
    job = plant.expect(202, asked)
    deadline = time.monotonic() + 60
    while job["state"] in {"queued", "running"} and time.monotonic() < deadline:
        time.sleep(0.05)
        job = plant.expect(200, plant.get(f"/jobs/{job['id']}"))
    assert job["state"] == "done", job
    return plant.expect(200, plant.get(f"/board-shapes/{job['result']['board_shape_id']}"))


@pytest.fixture
def line(small_plant: Plant) -> Plant:
    """A station with a board, at which six cameras were calibrated; the board is bowed by 0.8 mm."""
    small_plant.publish_sku()
    body = {"serial": "BOARD-1", "spec": revision().target.spec}
    target = small_plant.expect(201, small_plant.post("/targets", body))
    station = {"code": "cal1", "name": "Station", "target_id": target["id"]}
    small_plant.expect(201, small_plant.post("/stations", station))
    with small_plant.app.state.services.database.write() as session:
        for seed in range(6):
            add_result(session, add_run(session, f"V{seed}", bowed(0.8), seed), "bias_ratio")
    return small_plant


def finish_one(plant: Plant, serial: str, board: Array, seed: int) -> tuple[UUID, JsonObject]:
    with plant.app.state.services.database.write() as session:
        run_id = add_run(session, serial, board, seed, is_open=True).id
    return run_id, plant.expect(200, plant.finish(str(run_id)))


def gate(result: JsonObject, name: str) -> JsonObject:
    return next(one for one in result["gates"] if one["name"] == name)


def test_a_shape_is_learnt_certified_used_and_named_by_the_result(line: Plant) -> None:
    flat_id, flat = finish_one(line, "FLAT", bowed(0.8), 50)
    assert flat["board_shape"] is None
    assert gate(flat, "bias_ratio")["verdict"] == "FAIL"

    shape = learn(line, 30)
    assert (shape["state"], shape["version"], shape["runs"], shape["drift"]) == ("draft", 1, 7, None)
    assert shape["bend_mm"] == pytest.approx(0.8, abs=0.05)
    certainty = shape["certainty"]
    assert certainty["corner_mm"] < 0.02
    assert 0.0 < certainty["mapping_px"] < certainty["centre_px"] < 1.0
    assert shape["sigma_px"] < 0.07 < shape["sigma_flat_px"]
    assert len(shape["deviations_mm"]) == len(shape["sd_mm"]) == len(shape["corners_mm"]) == 35
    assert shape["corners_mm"][8] == pytest.approx([30.0, 30.0])
    assert line.get("/targets/BOARD-1").json()["certified_shape"] is None

    certified = line.expect(200, line.post(f"/board-shapes/{shape['id']}/certify", role=Role.ENGINEER))
    assert (certified["state"], certified["certified_by"]) == ("certified", "engineer")
    assert certified["certified_at"] is not None

    shaped_id, shaped = finish_one(line, "SHAPED", bowed(0.8), 51)
    assert shaped["board_shape"] == {"id": shape["id"], "target": "BOARD-1", "version": 1}
    assert gate(shaped, "bias_ratio")["verdict"] == "PASS"

    # A board that curls is not excused by its certificate.
    _, curled = finish_one(line, "CURLED", bowed(2.0), 52)
    assert gate(curled, "bias_ratio")["verdict"] == "FAIL"

    line.expect(200, line.post(f"/board-shapes/{shape['id']}/retire", role=Role.ENGINEER))
    with line.app.state.services.database.read() as session:
        for run_id in (flat_id, shaped_id):
            stored = session.scalars(select(CalibrationRow).where(CalibrationRow.run_id == run_id)).one()
            assert recompute(session, run_id) == stored.document


def test_drift_is_told_on_the_board_and_its_station_before_and_beyond_its_limit(line: Plant) -> None:
    first = learn(line, 6)
    line.expect(200, line.post(f"/board-shapes/{first['id']}/certify"))
    assert line.get("/targets/BOARD-1").json()["drift"] is None

    with line.app.state.services.database.write() as session:
        for seed in range(100, 106):
            add_run(session, f"W{seed}", bowed(1.1), seed)
    second = learn(line, 6)
    assert (second["version"], second["drift"]["state"]) == (2, "over")
    assert 0.15 < second["drift"]["worst_mm"] < 0.3
    assert second["drift"]["limit_mm"] == 0.1
    assert second["drift"]["focal_px"] > 0.1
    assert second["drift"]["mapping_px"] > 0.0

    told = line.get("/targets/BOARD-1").json()
    assert told["certified_shape"]["version"] == 1
    assert told["drift"]["state"] == "over"
    (standing,) = line.get("/statistics/stations").json()["items"]
    assert standing["board_drift"]["state"] == "over"
    assert standing["board"]["serial"] == "BOARD-1"
    assert standing["board"]["certified_shape"]["version"] == 1

    line.expect(200, line.post(f"/board-shapes/{second['id']}/certify"))
    states = [one["state"] for one in line.get("/targets/BOARD-1/shapes").json()["items"]]
    assert states == ["certified", "retired"]
    assert line.get("/targets/BOARD-1").json()["drift"] is None
    problem(line.post(f"/board-shapes/{first['id']}/certify"), 409, "state-forbids")


def test_runs_whose_corners_are_wrong_do_not_teach(line: Plant) -> None:
    with line.app.state.services.database.write() as session:
        add_result(session, add_run(session, "MOVED", bowed(0.8), 60), "outlier_share")
        simulated = add_run(session, "SIM", bowed(0.0), 61)
        simulated.purpose = Purpose.SIMULATED
        add_run(session, "OPEN", bowed(0.8), 62, is_open=True)
        session.flush()
        target = session.scalars(select(TargetRow)).one()
        assert len(teaching_runs(session, target, 30)) == 6
        assert len(teaching_runs(session, target, 4)) == 4


def test_pictures_of_a_fixed_target_do_not_teach(line: Plant) -> None:
    before = learn(line, 6)
    with line.app.state.services.database.write() as session:
        run = session.scalars(select(RunRow).where(RunRow.serial == "V0")).one()
        picture = make_capture(run, 99, f"{99:064x}")
        picture.role, picture.fixture = CaptureRole.EXTRINSICS, {}
        picture.image_size = list(revision().intrinsics.image_size)
        picture.corners, picture.corner_ids = [[10.0, 20.0]] * 4, [0, 1, 2, 3]
        session.add(picture)

    assert learn(line, 6)["deviations_mm"] == before["deviations_mm"]


def test_a_shape_that_is_not_known_well_enough_is_not_certified(line: Plant) -> None:
    shape = learn(line, 6)
    with line.app.state.services.database.write() as session:
        row = session.get_one(BoardShapeRow, UUID(shape["id"]))
        row.certainty = {**row.certainty, "corner_mm": 0.05}
    refused = problem(line.post(f"/board-shapes/{shape['id']}/certify"), 409, "state-forbids")
    assert refused["facts"] == {"corner_mm": 0.05, "needed_mm": 0.02}


def test_a_certified_board_is_looked_at_again_after_many_runs(line: Plant) -> None:
    with line.app.state.services.database.write() as session:
        target = session.scalars(select(TargetRow)).one()
        run = session.scalars(select(RunRow).where(RunRow.serial == "V0")).one()
        shape = BoardShapeRow(
            target_id=target.id,
            version=1,
            deviations=(0.0 * POINTS).tolist(),
            sd=(0.0 * POINTS).tolist(),
            run_ids=[],
            bend_mm=0.0,
            in_plane_mm=0.0,
            sigma_flat_px=0.1,
            sigma_px=0.1,
            certainty={},
            created_at=START + timedelta(days=1),
            created_by="test",
        )
        session.add(shape)
        session.flush()

        def waiting() -> int:
            watch_board(session, run, START)
            session.flush()
            return len(session.scalars(select(JobRow)).all())

        for i in range(WATCH_EVERY - 1):
            late = add_bare_run(session, target.id, i)
            session.add(late)
        session.flush()
        assert waiting() == 0  # nothing is certified
        shape.state, shape.certified_at = ShapeState.CERTIFIED, START
        session.flush()
        assert waiting() == 0
        session.add(add_bare_run(session, target.id, WATCH_EVERY))
        session.flush()
        assert waiting() == 1
        assert waiting() == 1  # it is on its way


def add_bare_run(session: Session, target_id: UUID, number: int) -> RunRow:
    """Return a finished run of the day after the shape was learnt."""
    return RunRow(
        sku_revision_id=session.scalars(select(SkuRevisionRow.id)).one(),
        target_id=target_id,
        serial=f"L{number}",
        state=RunState.FINISHED,
        verdict=Verdict.PASS,
        outcome=Outcome.COMPLETED,
        created_by="test",
        created_at=START + timedelta(days=2),
        finished_at=START + timedelta(days=2),
    )


def test_what_cannot_be_learnt_is_refused(small_plant: Plant) -> None:
    small_plant.publish_sku(with_poses=False)
    body = {"serial": "BOARD-1", "spec": "chessboard:7x5:30mm", "drift_limit_mm": 0.2}
    made = small_plant.expect(201, small_plant.post("/targets", body))
    assert made["drift_limit_mm"] == 0.2
    refused = problem(small_plant.post("/targets/BOARD-1/shape", {}), 409, "state-forbids")
    assert refused["facts"] == {"runs": 0, "needed": 5}
    problem(small_plant.post("/targets/NONE/shape", {}), 404, "not-found")
    problem(small_plant.get(f"/board-shapes/{made['id']}"), 404, "not-found")
    assert small_plant.get(f"/targets/{made['id']}").json() == small_plant.get("/targets/BOARD-1").json()
    problem(small_plant.post("/targets/BOARD-1/shape", {"runs": 3}), 422, "validation-failed")
