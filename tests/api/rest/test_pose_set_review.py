"""A pose set explained over HTTP, published and retired with who and when."""

from typing import Any
from uuid import UUID, uuid4

import pytest

from service.storage.models import AuditEntryRow, PoseSetRow
from service.storage.words import Role
from tests.plant import Plant, poses_json, problem

PATH = "/skus/tiny/revisions/1/pose-sets"


def drafted(plant: Plant, count: int = 8) -> str:
    """A draft of the first poses."""
    made = plant.expect(201, plant.post(PATH, {"poses": poses_json()[:count]}))
    return str(made["pose_set"]["id"])


def stored(plant: Plant, pose_set_id: str, **prediction: Any) -> None:
    """Let the planner have told more."""
    with plant.app.state.services.database.write() as session:
        row = session.get_one(PoseSetRow, UUID(pose_set_id))
        row.prediction = {**row.prediction, **prediction}


def test_a_review_explains_each_pose_and_the_image(plant: Plant) -> None:
    plant.publish_sku(with_poses=False)
    found = plant.get(f"/pose-sets/{drafted(plant)}").json()

    review = plant.expect(200, plant.get(f"/pose-sets/{found['id']}/review"))

    assert (review["sku"], review["image_size"]) == ({"code": "tiny", "revision": 1}, [640, 400])
    assert review["target"] == {"spec": "chessboard:7x5:30mm", "columns": 7, "rows": 5, "square_m": 0.03}
    assert [pose["index"] for pose in review["poses"]] == list(range(8))
    for pose, planned in zip(review["poses"], found["poses"], strict=True):
        assert pose["outline_px"][0] == pytest.approx(planned["outer_corners"][0], abs=1e-9)
        assert pose["smallest_square_px"] >= 14
        assert pose["loss_share"] > 0
    assert review["sd"] == pytest.approx(found["prediction"]["sd"], rel=1e-9)
    (left, top, depth), _, (right, bottom, _), _ = review["corner_rays"]
    assert left < -320 / 675 < 320 / 675 < right  # a barrel sees more than its focal length tells
    assert (top < 0 < bottom, depth) == (True, 1.0)
    maps = review["maps"]
    assert (maps["columns"], maps["rows"]) == (40, 25)
    for name in ("sd_px", "sd_mdeg", "boards", "corners"):
        assert (len(maps[name]), {len(row) for row in maps[name]}) == (25, {40})
    assert sum(map(sum, maps["corners"])) == 8 * 35
    working, valid = review["working_zone"], review["valid_region"]
    assert (working["left_px"], valid["left_px"]) == pytest.approx((0.15 * 639, 0.05 * 639))
    assert 0 < working["mean_px"] < working["worst_px"] < valid["worst_px"]
    assert 0.5 < working["covered_share"] <= 1
    assert (review["working_limit_px"], review["valid_limit_px"]) == (2.0, 5.0)


def test_the_noise_of_each_pose_is_used_where_the_planner_told_it(small_plant: Plant) -> None:
    small_plant.publish_sku(with_poses=False)
    pose_set_id = drafted(small_plant)
    path = f"/pose-sets/{pose_set_id}/review"
    before = small_plant.get(path).json()
    curve = [{"poses": 5, "norm_px": 1.5, "mapping_mean_px": 0.2, "mapping_worst_px": None}]
    stored(small_plant, pose_set_id, pose_sigma_px=[0.2] * 8, curve=curve, smallest_count=5)

    after = small_plant.get(path).json()

    assert len(set(before["sigma_px"])) == 8
    assert after["sigma_px"] == [0.2] * 8
    assert after["sd"]["fx"] == pytest.approx(2 * before["sd"]["fx"], rel=0.3)
    told = small_plant.get(f"/pose-sets/{pose_set_id}").json()["prediction"]
    assert (told["curve"], told["smallest_count"], told["required_mapping_px"]) == (curve, 5, 1.6)
    stored(small_plant, pose_set_id, pose_sigma_px=[0.2] * 7)
    assert small_plant.get(path).json()["sigma_px"] == [0.1] * 8


def test_a_set_that_is_still_planned_or_unknown_has_no_review(small_plant: Plant) -> None:
    small_plant.publish_sku(with_poses=False)
    with small_plant.app.state.services.database.write() as session:
        first = session.get_one(PoseSetRow, UUID(drafted(small_plant)))
        empty = PoseSetRow(
            sku_revision_id=first.sku_revision_id,
            poses=[],
            prediction={},
            provenance={},
            created_at=first.created_at,
        )
        session.add(empty)
        empty_id = empty.id

    problem(small_plant.get(f"/pose-sets/{empty_id}/review"), 409, "state-forbids")
    problem(small_plant.get(f"/pose-sets/{uuid4()}/review"), 404, "not-found")


def test_publishing_and_retiring_say_who_and_when(plant: Plant) -> None:
    plant.publish_sku(with_poses=False)
    pose_set_id = drafted(plant)

    published = plant.expect(200, plant.post(f"/pose-sets/{pose_set_id}/publish", role=Role.ENGINEER))
    retired = plant.expect(200, plant.post(f"/pose-sets/{pose_set_id}/retire", role=Role.ADMIN))
    again = plant.expect(200, plant.post(f"/pose-sets/{pose_set_id}/retire", role=Role.ENGINEER))

    assert (published["published_by"], published["retired_at"]) == ("engineer", None)
    assert (retired["state"], retired["published_by"], retired["retired_by"]) == (
        "retired",
        "engineer",
        "admin",
    )
    assert retired["retired_at"] >= published["published_at"]
    assert again == retired
    with plant.app.state.services.database.read() as session:
        actions = [row.action for row in session.query(AuditEntryRow).order_by(AuditEntryRow.at)]
    assert actions[-2:] == ["pose-set.publish", "pose-set.retire"]


def test_runs_that_are_open_keep_a_retired_set_and_new_ones_get_none(small_plant: Plant) -> None:
    small_plant.publish_sku()
    run_id = small_plant.open_run("VIN-1")
    pose_set_id = small_plant.get(f"/runs/{run_id}").json()["pose_set_id"]

    small_plant.expect(200, small_plant.post(f"/pose-sets/{pose_set_id}/retire"))

    assert small_plant.get(f"/runs/{run_id}").json()["pose_set_id"] == pose_set_id
    small_plant.expect(201, small_plant.upload(run_id, 0))
    problem(small_plant.post("/runs", {"sku": "tiny", "serial": "VIN-2"}), 409, "pose-set-not-published")
    problem(small_plant.post(f"/pose-sets/{pose_set_id}/publish"), 409, "state-forbids")


def test_the_next_publication_retires_with_its_name(small_plant: Plant) -> None:
    small_plant.publish_sku()
    first = small_plant.get("/skus/tiny/pose-sets").json()["items"][0]["id"]

    second = drafted(small_plant, 5)
    published = small_plant.expect(200, small_plant.post(f"/pose-sets/{second}/publish", role=Role.ENGINEER))

    old = small_plant.get(f"/pose-sets/{first}").json()
    assert (old["state"], old["retired_by"], old["retired_at"]) == (
        "retired",
        "engineer",
        published["published_at"],
    )


def test_a_draft_cannot_be_retired_nor_an_operator_retire(small_plant: Plant) -> None:
    small_plant.publish_sku(with_poses=False)
    pose_set_id = drafted(small_plant)

    problem(small_plant.post(f"/pose-sets/{pose_set_id}/retire", role=Role.OPERATOR), 403, "role-missing")
    refused = problem(small_plant.post(f"/pose-sets/{pose_set_id}/retire"), 409, "state-forbids")
    assert refused["facts"] == {"state": "draft"}
    problem(small_plant.post(f"/pose-sets/{uuid4()}/retire"), 404, "not-found")
