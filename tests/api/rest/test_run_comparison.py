"""Runs compared, their maps and histories, over HTTP."""

from typing import Any
from uuid import UUID

import numpy as np
import pytest

from service.storage.columns import new_id
from service.storage.models import CalibrationRow, Row, RunRow
from tests.plant import Plant, problem, revision


@pytest.fixture
def two_runs(plant: Plant) -> tuple[str, str]:
    """Two finished runs with the same pictures, of two serials."""
    plant.publish_sku()
    return plant.finished_run("VIN-1"), plant.finished_run("VIN-2")


def test_the_maps_of_a_result_agree_with_its_figures(plant: Plant) -> None:
    plant.publish_sku()
    run_id = plant.finished_run()

    maps = plant.expect(200, plant.get(f"/runs/{run_id}/result/maps"))

    result = plant.get(f"/runs/{run_id}/result").json()
    assert maps["image_size"] == [640, 400]
    sd = np.array(maps["sd_px"], dtype=float)
    assert sd.shape == np.shape(maps["sd_mdeg"]) == (25, 40)
    zone = maps["working_zone"]
    columns = (np.arange(40) + 0.5) * 16 - 0.5
    rows = (np.arange(25) + 0.5) * 16 - 0.5
    inside = np.ix_(
        (rows > zone["top_px"]) & (rows < zone["bottom_px"]),
        (columns > zone["left_px"]) & (columns < zone["right_px"]),
    )
    mean = float(np.sqrt(np.mean(sd[inside] ** 2)))
    assert mean == pytest.approx(result["mapping"]["zone_mean_px"], rel=0.15)
    corners = np.array(maps["corners"])
    rms = np.array(maps["residual_rms_px"], dtype=float)
    assert corners.sum() == 8 * 35
    assert np.isnan(rms[corners == 0]).all()
    squares = np.nansum(np.where(corners > 0, rms, 0.0) ** 2 * corners)
    assert np.sqrt(squares / corners.sum()) == pytest.approx(result["rms_px"], rel=1e-3)


def test_a_run_against_itself_is_the_same_camera(plant: Plant, two_runs: tuple[str, str]) -> None:
    found = plant.expect(200, plant.get("/runs/{}/comparison/{}".format(*two_runs)))

    assert (found["a"], found["b"]) == two_runs
    assert [row["name"] for row in found["parameters"]] == list(revision().intrinsics.parameters)
    assert {row["difference"] for row in found["parameters"]} == {0.0}
    assert found["parameters"][0]["sd"] > 0
    assert found["distance_sd"] == 0.0
    assert found["working_zone"]["worst_px"] < 1e-6 < found["working_zone"]["expected_px"]
    assert np.shape(found["maps"]["offset_u_px"]) == (25, 40)


def test_pictures_in_two_runs_are_named_in_both(plant: Plant, two_runs: tuple[str, str]) -> None:
    first, second = two_runs

    shared = plant.get(f"/runs/{second}/shared-pictures").json()

    assert [row["number"] for row in shared] == [row["other_number"] for row in shared] == list(range(1, 9))
    assert {(row["other_run_id"], row["other_serial"]) for row in shared} == {(first, "VIN-1")}
    assert len(plant.get(f"/runs/{first}/shared-pictures").json()) == 8


def test_a_history_tells_what_each_run_came_to(plant: Plant) -> None:
    plant.publish_sku()
    runs = [plant.finished_run("VIN-1") for _ in range(2)]
    plant.open_run("VIN-1")

    history = plant.expect(200, plant.get("/vehicles/VIN-1/calibrations"))

    assert [one["run_id"] for one in history["calibrations"]] == runs
    result = plant.get(f"/runs/{runs[0]}/result").json()
    for name in ("verdict", "lens", "rms_px", "intrinsics", "sd"):
        assert history["calibrations"][0][name] == result[name]
    problem(plant.get("/vehicles/NOBODY/calibrations"), 404, "not-found")


def test_a_serial_without_a_finished_run_has_an_empty_history(small_plant: Plant) -> None:
    small_plant.publish_sku()
    run_id = small_plant.open_run("VIN-1")

    assert small_plant.get("/vehicles/VIN-1/calibrations").json()["calibrations"] == []
    problem(small_plant.get(f"/runs/{run_id}/result/maps"), 404, "not-found")
    problem(small_plant.get(f"/runs/{run_id}/comparison/{run_id}"), 404, "not-found")


def test_cameras_of_two_image_sizes_are_refused_with_the_reason(plant: Plant) -> None:
    plant.publish_sku()
    run_id = plant.finished_run()
    other = _stored_again(plant, run_id, image_size=[1280, 800])

    refused = problem(plant.get(f"/runs/{run_id}/comparison/{other}"), 422, "wrong-image-size")

    assert "640x400 and 1280x800" in refused["detail"]


def test_lens_models_that_differ_are_compared_by_their_mapping(plant: Plant) -> None:
    plant.publish_sku()
    run_id = plant.finished_run()
    other = _stored_again(plant, run_id, lens="rational8")

    found = plant.expect(200, plant.get(f"/runs/{run_id}/comparison/{other}"))

    assert (found["lens_a"], found["lens_b"]) == ("pinhole5", "rational8")
    assert (found["parameters"], found["distance_sd"]) == ([], None)
    assert found["working_zone"]["worst_px"] < 1e-6


def _stored_again(plant: Plant, run_id: str, **changed: Any) -> str:
    """Store a run's calibration once more under a run of its own, as another lens or image size leaves it."""
    with plant.app.state.services.database.write() as session:
        run = session.get_one(RunRow, UUID(run_id))
        again = RunRow(**_values(run), id=new_id())
        row = session.query(CalibrationRow).filter_by(run_id=run.id).one()
        covariance = np.zeros((12, 12))
        size = len(row.covariance)
        covariance[:size, :size] = row.covariance
        values = {
            **_values(row),
            "run_id": again.id,
            "lens": changed.get("lens", row.lens),
            "covariance": covariance.tolist() if "lens" in changed else row.covariance,
            "document": {**row.document, **changed},
        }
        session.add_all([again, CalibrationRow(**values)])
        return str(again.id)


def _values(row: Row) -> dict[str, Any]:
    return {column.key: getattr(row, column.key) for column in row.__table__.columns if column.key != "id"}
