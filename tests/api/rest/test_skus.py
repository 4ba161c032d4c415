import pytest

from service.storage.words import Role
from tests.plant import SKU, Plant, problem


def test_a_sku_begins_as_a_draft(plant: Plant) -> None:
    made = plant.expect(201, plant.post("/skus", SKU, role=Role.ENGINEER))

    assert (made["latest_revision"], made["published_revision"]) == (1, None)
    assert made["revisions"][0]["document"]["nominal"] == SKU["nominal"]
    assert plant.get("/skus/tiny").json() == made
    assert plant.get("/skus").json()["items"][0]["code"] == "tiny"


def test_publishing_a_revision_retires_the_one_before(plant: Plant) -> None:
    plant.post("/skus", SKU)
    plant.post("/skus/tiny/revisions/1/publish")
    second = plant.expect(201, plant.post("/skus/tiny/revisions", {**SKU, "pose_count": 9}))
    assert plant.get("/skus/tiny").json()["published_revision"] == 1

    plant.expect(200, plant.post("/skus/tiny/revisions/2/publish"))

    states = {r["number"]: r["state"] for r in plant.get("/skus/tiny/revisions").json()["items"]}
    assert (second["number"], states) == (2, {1: "retired", 2: "published"})
    problem(plant.post("/skus/tiny/revisions/1/publish"), 409, "state-forbids")


def test_publishing_again_changes_nothing(small_plant: Plant) -> None:
    small_plant.post("/skus", SKU)
    first = small_plant.post("/skus/tiny/revisions/1/publish").json()

    assert small_plant.expect(200, small_plant.post("/skus/tiny/revisions/1/publish")) == first


def test_a_published_revision_is_never_edited(small_plant: Plant) -> None:
    small_plant.publish_sku(with_poses=False)
    before = small_plant.get("/skus/tiny/revisions/1").json()

    for method in ("PUT", "PATCH", "DELETE"):
        problem(small_plant.call(method, "/skus/tiny/revisions/1", json=SKU), 405, "method-not-allowed")
    problem(small_plant.post("/skus", {**SKU, "pose_count": 5}), 409, "already-exists")

    assert small_plant.get("/skus/tiny/revisions/1").json() == before


def test_a_run_keeps_the_revision_that_it_was_opened_on(small_plant: Plant) -> None:
    small_plant.publish_sku()
    run_id = small_plant.open_run()
    small_plant.post("/skus/tiny/revisions", {**SKU, "image_size": [1280, 800]})
    small_plant.post("/skus/tiny/revisions/2/publish")

    assert small_plant.upload(run_id, 0).status_code == 201
    assert small_plant.get(f"/runs/{run_id}").json()["sku"] == {"code": "tiny", "revision": 1}


def test_the_document_of_another_sku_is_no_revision(small_plant: Plant) -> None:
    small_plant.post("/skus", SKU)

    problem(small_plant.post("/skus/tiny/revisions", {**SKU, "code": "other"}), 422, "validation-failed")


@pytest.mark.parametrize("path", ["/skus/none", "/skus/none/revisions", "/skus/tiny/revisions/7"])
def test_what_is_not_there_is_not_found(small_plant: Plant, path: str) -> None:
    small_plant.post("/skus", SKU)

    problem(small_plant.get(path), 404, "not-found")
