from uuid import UUID

from sqlalchemy import select

from service.storage.models import CalibrationRow, CaptureRow, MeasurementRow
from service.usecases.calibration_input import calibrate, load_input
from service.usecases.finish import recompute
from service.usecases.runs import get_run
from tests.plant import Plant, pose_set


def test_a_result_is_computed_again_to_the_last_digit(plant: Plant) -> None:
    plant.publish_sku()
    run_id = UUID(plant.finished_run())

    with plant.app.state.services.database.read() as session:
        stored = session.scalars(select(CalibrationRow)).one()
        again = recompute(session, run_id)

    assert again == stored.document
    assert again["covariance"] == stored.covariance
    assert again["intrinsics"] == stored.intrinsics


def test_gates_are_computed_again_to_the_last_digit(plant: Plant) -> None:
    plant.publish_sku()
    run_id = UUID(plant.finished_run())

    with plant.app.state.services.database.read() as session:
        rows = session.scalars(select(MeasurementRow).order_by(MeasurementRow.id)).all()
        judged = calibrate(load_input(session, get_run(session, run_id)))

    stored = [(row.gate, row.name, row.value, row.limit, row.margin, row.verdict) for row in rows]
    assert stored == [(m.gate, m.name, m.value, m.limit, m.margin, m.verdict) for m in judged.measurements]


def test_corners_are_stored_with_all_their_digits(plant: Plant) -> None:
    plant.publish_sku()
    run_id = plant.open_run()
    told = plant.upload(run_id, 0).json()["corners"]

    with plant.app.state.services.database.read() as session:
        row = session.scalars(select(CaptureRow)).one()
        source = load_input(session, get_run(session, UUID(run_id)))

    assert row.corners == told
    assert source.detections[0].detection.image_points.tolist() == told


def test_a_capture_at_the_wrong_pose_fails_the_poses_gate(small_plant: Plant) -> None:
    small_plant.publish_sku()
    run_id = small_plant.open_run()
    count = len(pose_set().poses)
    for index in range(count):
        small_plant.expect(201, small_plant.upload(run_id, index))
    swap = {0: count - 1, count - 1: 0}
    captures = small_plant.get(f"/runs/{run_id}").json()["capture_list"]
    for capture in captures:
        if capture["pose_index"] in swap:
            small_plant.call("DELETE", f"/runs/{run_id}/captures/{capture['id']}")

    with_wrong_pose = swap_uploads(small_plant, run_id, swap)

    assert min(with_wrong_pose) > 20.0
    result = small_plant.expect(200, small_plant.finish(run_id))
    assert result["verdict"] == "FAIL"
    assert "poses" in {gate["gate"] for gate in result["gates"] if gate["verdict"] == "FAIL"}
    (missing,) = [gate for gate in result["gates"] if gate["name"] == "missing_poses"]
    assert (missing["reason"], missing["facts"]) == ("missing_poses", {"poses": [1, count], "more": 0})


def swap_uploads(plant: Plant, run_id: str, swap: dict[int, int]) -> list[float]:
    """Send the pictures of two poses under each other's index; return their match errors, px."""
    errors = []
    for shown, told in swap.items():
        answer = plant.expect(201, plant.upload_as(run_id, shown, told))
        errors.append(answer["match_error_px"])
    return errors
