"""The same request from several sides at the same moment: one of them counts, and nothing is there twice."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import httpx2
from sqlalchemy import func, select

from service.storage.models import CalibrationRow, CaptureRow, OutboxEventRow, RunRow
from tests.plant import Plant, picture, pose_set

SIDES = 6


def at_once(ask: Callable[[int], httpx2.Response]) -> list[httpx2.Response]:
    with ThreadPoolExecutor(SIDES) as threads:
        return list(threads.map(ask, range(SIDES)))


def count(plant: Plant, row: type) -> int:
    with plant.app.state.services.database.read() as session:
        return session.scalar(select(func.count()).select_from(row)) or 0


def test_one_order_opens_one_run(plant: Plant) -> None:
    plant.publish_sku()
    body, key = {"sku": "tiny", "serial": "VIN-1"}, {"Idempotency-Key": "order"}

    answers = at_once(lambda _: plant.post("/runs", body, headers=key))

    assert {answer.status_code for answer in answers} <= {201, 409}
    assert len({answer.json()["id"] for answer in answers if answer.status_code == 201}) == 1
    assert count(plant, RunRow) == 1


def test_one_image_becomes_one_capture(plant: Plant) -> None:
    plant.publish_sku()
    run_id = plant.open_run()

    answers = at_once(lambda _: plant.upload(run_id, 0))

    assert sorted(answer.status_code for answer in answers) == [200] * (SIDES - 1) + [201]
    assert len({answer.json()["id"] for answer in answers}) == count(plant, CaptureRow) == 1


def test_several_images_get_numbers_of_their_own(plant: Plant) -> None:
    plant.publish_sku()
    run_id = plant.open_run()
    contents = [picture(index) for index in range(SIDES)]

    answers = at_once(lambda index: plant.send(run_id, contents[index], pose_index=index))

    assert sorted(answer.json()["number"] for answer in answers) == list(range(1, SIDES + 1))


def test_one_pose_keeps_one_of_several_images(plant: Plant) -> None:
    plant.publish_sku()
    run_id = plant.open_run()
    contents = [picture(index) for index in range(SIDES)]

    answers = at_once(lambda index: plant.send(run_id, contents[index], pose_index=0))

    assert sorted(answer.status_code for answer in answers) == [201] + [409] * (SIDES - 1)


def test_a_run_is_finished_once(plant: Plant) -> None:
    plant.publish_sku()
    run_id = plant.open_run()
    for index in range(len(pose_set().poses)):
        plant.upload(run_id, index)

    answers = at_once(lambda _: plant.finish(run_id))

    assert sorted(answer.status_code for answer in answers) == [200] + [409] * (SIDES - 1)
    assert (count(plant, CalibrationRow), count(plant, OutboxEventRow)) == (1, 1)


def test_a_finish_and_an_upload_at_once_leave_a_result_of_what_it_was_made_from(plant: Plant) -> None:
    plant.publish_sku()
    run_id = plant.open_run()
    last = len(pose_set().poses) - 1
    for index in range(last):
        plant.upload(run_id, index)
    content = picture(last)

    at_once(lambda side: plant.finish(run_id) if side % 2 else plant.send(run_id, content, pose_index=last))
    plant.finish(run_id)

    run = plant.get(f"/runs/{run_id}").json()
    assert len(run["result"]["views"]) == run["captures"]


def test_two_revisions_published_at_once_leave_one_published(plant: Plant) -> None:
    plant.publish_sku(with_poses=False)
    document = plant.get("/skus/tiny/revisions/1").json()["document"]
    for _ in range(SIDES):
        plant.expect(201, plant.post("/skus/tiny/revisions", document))

    at_once(lambda side: plant.post(f"/skus/tiny/revisions/{side + 2}/publish"))

    states = [one["state"] for one in plant.get("/skus/tiny/revisions").json()["items"]]
    assert states.count("published") == 1
