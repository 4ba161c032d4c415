"""A pose set as a file: exported, imported again, and refused where it is for another camera."""

import json
import time
from typing import Any
from uuid import uuid4

import pytest

from service.core.planning.document import pose_set_from_dict, pose_set_to_dict
from service.core.planning.noise import FITTED_NOISE
from service.storage.words import Role
from service.usecases.pose_set_document import pose_set_document
from tests.plant import SKU, Plant, pose_set, problem, revision

PATH = "/skus/tiny/revisions/1/pose-sets"


def planned_document() -> dict[str, Any]:
    """What `dmscal plan --out` writes for the plant's SKU."""
    document: dict[str, Any] = json.loads(
        json.dumps(pose_set_document(revision(), None, pose_set_to_dict(pose_set())))
    )
    return document


def wait_for_poses(plant: Plant, pose_set_id: str) -> None:
    """Return when the job has planned the set."""
    deadline = time.monotonic() + 60
    while not plant.get(f"/pose-sets/{pose_set_id}").json()["poses"]:
        assert time.monotonic() < deadline, "the job did not end"
        time.sleep(0.02)


def test_a_planned_file_is_imported_and_exported_as_it_was(plant: Plant) -> None:
    plant.publish_sku(with_poses=False)
    document = planned_document()

    made = plant.expect(201, plant.post(PATH, document))["pose_set"]
    answer = plant.get(f"/pose-sets/{made['id']}/export")
    exported = plant.expect(200, answer)

    assert list(exported) == ["sku", "revision", "image_size", "target", "poses", "prediction", "provenance"]
    assert (exported["poses"], exported["revision"]) == (document["poses"], 1)
    assert [exported[name] for name in ("sku", "image_size", "target")] == ["tiny", [640, 400], SKU["target"]]
    assert exported["prediction"]["norm_px"] == pytest.approx(document["prediction"]["norm_px"], rel=1e-9)
    assert answer.headers["content-disposition"].startswith('attachment; filename="tiny-r1-')
    origin = {"planner": pose_set().planner, "seed": 1, "candidates": 300, "objective": "balanced"}
    assert exported["provenance"].pop("noise_source") == FITTED_NOISE.source
    assert exported["provenance"] == {"planner": "imported", "sigma_px": 0.1, "origin": origin}
    again = plant.expect(201, plant.post(PATH, exported))["pose_set"]
    assert again["poses"] == made["poses"]
    assert again["provenance"]["origin"] == {"revision": 1, "planner": "imported"}


def test_an_export_of_a_set_planned_here_reads_back_as_the_very_set(small_plant: Plant) -> None:
    small_plant.publish_sku(with_poses=False)
    asked = small_plant.expect(202, small_plant.post(PATH, {"seed": 1, "candidates": 300}))["pose_set"]["id"]
    problem(small_plant.get(f"/pose-sets/{asked}/export"), 409, "state-forbids")
    wait_for_poses(small_plant, asked)

    exported = small_plant.expect(200, small_plant.get(f"/pose-sets/{asked}/export"))

    assert pose_set_to_dict(pose_set_from_dict(exported)) == pose_set_to_dict(pose_set())
    problem(small_plant.get(f"/pose-sets/{uuid4()}/export"), 404, "not-found")


def test_a_set_for_a_lens_that_does_not_reach_the_whole_image_is_imported_and_reviewed(plant: Plant) -> None:
    # So strong a barrel, with nothing to counter it, folds before the corner of the image.
    folding = {**SKU, "nominal": {**SKU["nominal"], "k1": -0.55, "k2": 0.0}}
    plant.expect(201, plant.post("/skus", folding))
    asked = plant.expect(202, plant.post(PATH, {"seed": 1, "candidates": 300}))["pose_set"]["id"]
    wait_for_poses(plant, asked)

    made = plant.expect(201, plant.post(PATH, plant.get(f"/pose-sets/{asked}/export").json()))["pose_set"]
    review = plant.expect(200, plant.get(f"/pose-sets/{made['id']}/review"))

    assert made["prediction"]["mapping"] == {"mean_px": None, "worst_px": None}
    assert review["maps"]["sd_px"][0][0] is None
    assert review["maps"]["sd_px"][12][20] > 0
    assert review["corner_rays"] is None
    assert review["working_zone"]["mean_px"] > 0


def test_a_file_of_before_names_no_image_size_and_is_read(small_plant: Plant) -> None:
    small_plant.publish_sku(with_poses=False)
    document = planned_document()
    del document["revision"], document["image_size"]

    small_plant.expect(201, small_plant.post(PATH, document))


@pytest.mark.parametrize(
    ("field", "value", "said"),
    [
        ("sku", "lens1", "sku is lens1, here it is tiny"),
        ("image_size", [1280, 800], "image_size is 1280x800 px, here it is 640x400 px"),
        ("target", "chessboard:9x6:25mm", "target is chessboard:9x6:25mm, here it is chessboard:7x5:30mm"),
    ],
)
def test_a_set_for_another_camera_is_refused_by_field(
    small_plant: Plant, field: str, value: Any, said: str
) -> None:
    small_plant.publish_sku(with_poses=False)

    refused = problem(small_plant.post(PATH, {**planned_document(), field: value}), 422, "pose-set-mismatch")

    assert said in refused["detail"]
    assert "plan one for this SKU" in refused["detail"]
    assert refused["facts"] == {"pointer": f"/{field}", "fields": [field]}
    assert small_plant.get("/skus/tiny/pose-sets").json()["items"] == []


def test_all_that_differs_is_named_at_once(small_plant: Plant) -> None:
    small_plant.publish_sku(with_poses=False)
    other = {"sku": "lens1", "image_size": [1280, 800], "target": "chessboard:9x6:25mm"}

    refused = problem(small_plant.post(PATH, {**planned_document(), **other}), 422, "pose-set-mismatch")

    assert refused["facts"]["fields"] == ["sku", "image_size", "target"]


def test_a_board_outside_of_the_image_is_refused_by_its_place(small_plant: Plant) -> None:
    small_plant.publish_sku(with_poses=False)
    document = planned_document()
    document["poses"][3]["tvec"] = [0.9, 0.0, 1.0]

    refused = problem(small_plant.post(PATH, document), 422, "pose-set-infeasible")

    assert refused["facts"] == {"pointer": "/poses/3", "poses": [3]}
    assert "poses[3]" in refused["detail"]
    assert "640x400" in refused["detail"]


@pytest.mark.parametrize(
    ("change", "pointer"),
    [
        ({"target": 7}, "/target"),
        ({"image_size": [640]}, "/image_size/1"),
        ({"provenance": {"seed": "one"}}, "/provenance/seed"),
        ({"provenance": {"planner": "a\u0000b"}}, "/provenance/planner"),
        ({"poses": [{"rvec": [0, 0, 0]}] * 3}, "/poses/0/tvec"),
        ({"extra": 1}, "/extra"),
        ({"poses": None}, ""),
    ],
)
def test_a_file_with_a_wrong_field_is_refused_by_its_name(
    small_plant: Plant, change: dict[str, Any], pointer: str
) -> None:
    small_plant.publish_sku(with_poses=False)

    refused = problem(small_plant.post(PATH, {**planned_document(), **change}), 422, "validation-failed")

    assert pointer in [error["pointer"] for error in refused["errors"]]


def test_a_viewer_may_export_and_an_operator_may_not_import(small_plant: Plant) -> None:
    small_plant.publish_sku()
    listed = small_plant.get("/skus/tiny/pose-sets").json()["items"]

    small_plant.expect(200, small_plant.get(f"/pose-sets/{listed[0]['id']}/export", role=Role.VIEWER))
    problem(small_plant.post(PATH, planned_document(), role=Role.OPERATOR), 403, "role-missing")
