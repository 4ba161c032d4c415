import struct
import time
import zlib
from collections.abc import Callable
from uuid import uuid4

import cv2
import numpy as np
import pytest

from service.core.vision.camera import project
from service.storage.words import Role
from tests.plant import Plant, encode, picture, pose_set, problem, revision


def grey(width: int = 640, height: int = 400) -> np.ndarray:
    return np.full((height, width), 128, np.uint8)


def seen() -> np.ndarray:
    return np.asarray(cv2.imdecode(np.frombuffer(picture(0), np.uint8), cv2.IMREAD_UNCHANGED))


def half_hidden() -> np.ndarray:
    """The first picture with everything to the right of the board's middle covered."""
    sku, pose = revision(), pose_set().poses[0]
    middle = project(sku.intrinsics, pose.rotation, pose.tvec, sku.target.centre[None])[0, 0]
    return np.where(np.arange(640) < middle, seen(), 128).astype(np.uint8)


def declared(width: int, height: int) -> bytes:
    """A small PNG whose header declares another size."""
    png = encode(grey())
    header = b"IHDR" + struct.pack(">II", width, height) + png[24:29]
    return png[:12] + header + struct.pack(">I", zlib.crc32(header)) + png[33:]


@pytest.fixture
def run_id(small_plant: Plant) -> str:
    small_plant.publish_sku()
    return small_plant.open_run()


def test_an_upload_tells_what_was_seen(small_plant: Plant, run_id: str) -> None:
    capture = small_plant.expect(201, small_plant.upload(run_id, 0))

    assert (capture["number"], capture["pose_index"], capture["image_size"]) == (1, 0, [640, 400])
    assert capture["match_error_px"] < 0.5
    assert len(capture["corners"]) == 35
    assert capture["reprojected"] is None
    assert small_plant.get(f"/captures/{capture['id']}").json() == capture


def test_a_board_in_too_much_light_is_refused_with_what_to_do(small_plant: Plant, run_id: str) -> None:
    glaring = np.where(seen() > 110, 255, seen()).astype(np.uint8)

    refused = problem(small_plant.send(run_id, encode(glaring), pose_index=0), 422, "target-overexposed")

    assert refused["facts"]["saturated_share"] > 0.9
    assert "Dim the lamp" in refused["detail"]
    assert small_plant.get(f"/runs/{run_id}").json()["captures"] == 0
    accepted = small_plant.expect(201, small_plant.upload(run_id, 0))
    assert accepted["saturated_share"] < 0.05


def test_an_image_may_come_as_a_form(small_plant: Plant, run_id: str) -> None:
    files = {"image": ("first.png", picture(0), "image/png")}

    capture = small_plant.expect(201, small_plant.call("POST", f"/runs/{run_id}/captures", files=files))

    assert (capture["file_name"], capture["pose_index"], capture["match_error_px"]) == (
        "first.png",
        None,
        None,
    )


def test_the_image_comes_back_as_it_was_sent(small_plant: Plant, run_id: str) -> None:
    capture = small_plant.upload(run_id, 0).json()

    image = small_plant.get(capture["image_url"].removeprefix("/api/v1"))

    assert image.content == picture(0)
    assert (image.headers["content-type"], image.headers["x-content-type-options"]) == (
        "image/png",
        "nosniff",
    )
    assert "immutable" in image.headers["cache-control"]


def test_an_image_that_browsers_do_not_show_comes_back_as_png(small_plant: Plant, run_id: str) -> None:
    pgm = encode(seen(), ".pgm")
    capture = small_plant.expect(201, small_plant.send(run_id, pgm, media_type="application/octet-stream"))

    image = small_plant.get(f"/captures/{capture['id']}/image")

    assert image.headers["content-type"] == "image/png"
    shown = cv2.imdecode(np.frombuffer(image.content, np.uint8), cv2.IMREAD_UNCHANGED)
    np.testing.assert_array_equal(shown, seen())


def test_a_repeated_upload_gives_the_same_capture(plant: Plant) -> None:
    plant.publish_sku()
    run_id = plant.open_run()

    first, again = plant.upload(run_id, 0), plant.upload(run_id, 0)

    assert (first.status_code, again.status_code) == (201, 200)
    assert again.json() == first.json()
    assert plant.get(f"/runs/{run_id}").json()["captures"] == 1


def test_a_repeated_upload_is_answered_even_after_the_finish(small_plant: Plant) -> None:
    small_plant.publish_sku()
    run_id = small_plant.finished_run()

    again = small_plant.upload(run_id, 0)

    assert again.status_code == 200
    assert again.json()["rms_px"] < 0.3
    assert len(again.json()["reprojected"]) == 35
    problem(small_plant.send(run_id, encode(seen(), ".bmp")), 409, "run-already-finished")


def test_one_image_does_not_serve_two_poses(small_plant: Plant, run_id: str) -> None:
    first = small_plant.upload(run_id, 0).json()

    facts = problem(small_plant.send(run_id, picture(0), pose_index=1), 409, "duplicate-image")["facts"]

    assert facts["capture"] == f"/api/v1/captures/{first['id']}"


def test_a_pose_is_taken_again_only_after_its_capture_is_withdrawn(small_plant: Plant, run_id: str) -> None:
    first = small_plant.upload(run_id, 0).json()
    problem(small_plant.send(run_id, picture(1), pose_index=0), 409, "pose-taken")

    gone = small_plant.call("DELETE", f"/runs/{run_id}/captures/{first['id']}", Role.OPERATOR)

    assert (gone.status_code, gone.content) == (204, b"")
    problem(small_plant.get(f"/captures/{first['id']}"), 404, "not-found")
    assert small_plant.send(run_id, picture(1), pose_index=0).json()["number"] == 1


def test_a_capture_of_another_run_is_not_withdrawn(small_plant: Plant, run_id: str) -> None:
    capture = small_plant.upload(run_id, 0).json()
    other = small_plant.open_run("VIN-2")

    problem(small_plant.call("DELETE", f"/runs/{other}/captures/{capture['id']}"), 404, "not-found")
    assert small_plant.get(f"/captures/{capture['id']}").status_code == 200


def test_a_finished_run_keeps_its_captures(small_plant: Plant) -> None:
    small_plant.publish_sku()
    run_id = small_plant.finished_run()
    capture = small_plant.get(f"/runs/{run_id}").json()["capture_list"][0]

    refused = small_plant.call("DELETE", f"/runs/{run_id}/captures/{capture['id']}")

    problem(refused, 409, "run-already-finished")


BAD_IMAGES: dict[str, tuple[Callable[[], bytes], int, str]] = {
    "empty": (lambda: b"", 400, "bad-request"),
    "text": (lambda: b"no image at all", 422, "image-format-unsupported"),
    "gif": (lambda: b"GIF89a" + bytes(50), 422, "image-format-unsupported"),
    "truncated": (lambda: picture(0)[:2000], 422, "image-unreadable"),
    "head only": (lambda: picture(0)[:30], 422, "image-unreadable"),
    "damaged": (lambda: picture(0)[:500] + bytes(99) + picture(0)[599:], 422, "image-unreadable"),
    "16 bits": (lambda: encode(seen().astype(np.uint16) * 257), 422, "image-format-unsupported"),
    "wrong size": (lambda: encode(grey(639, 400)), 422, "wrong-image-size"),
    "bomb": (lambda: declared(100_000, 100_000), 413, "image-too-large"),
    "no board": (lambda: encode(grey()), 422, "target-not-visible"),
    "half a board": (lambda: encode(half_hidden()), 422, "target-not-visible"),
}


@pytest.mark.parametrize("name", BAD_IMAGES)
def test_a_bad_image_is_refused_with_its_reason_and_changes_nothing(
    small_plant: Plant, run_id: str, name: str
) -> None:
    make, status, code = BAD_IMAGES[name]

    answer = small_plant.send(run_id, make(), pose_index=0)

    assert (answer.status_code, answer.headers["content-type"]) == (status, "application/problem+json"), (
        answer.text
    )
    assert answer.json()["code"] == code
    assert small_plant.get(f"/runs/{run_id}").json()["captures"] == 0
    assert small_plant.upload(run_id, 0).status_code == 201


def test_a_colour_image_is_taken_in_grey(small_plant: Plant, run_id: str) -> None:
    colour = encode(cv2.cvtColor(seen(), cv2.COLOR_GRAY2BGR))

    assert small_plant.send(run_id, colour, pose_index=0).status_code == 201


def test_another_board_is_not_taken_for_the_declared_one(small_plant: Plant) -> None:
    small_plant.post("/skus", {**SMALLER_BOARD})
    small_plant.post("/skus/other/revisions/1/publish")
    opened = small_plant.post("/runs", {"sku": "other", "serial": "A", "purpose": "trial"}).json()

    refused = problem(small_plant.send(opened["id"], picture(0)), 422, "wrong-target")

    assert (refused["facts"]["found_columns"], refused["facts"]["found_rows"]) == (7, 5)


SMALLER_BOARD = {
    "code": "other",
    "name": "Other board",
    "lens": "pinhole5",
    "image_size": [640, 400],
    "nominal": {name: revision().intrinsics.parameters[name] for name in ("fx", "fy", "cx", "cy")},
    "target": "chessboard:6x5:30mm",
}


def test_a_body_over_the_limit_is_refused_before_it_is_read(small_plant: Plant, run_id: str) -> None:
    start = time.perf_counter()

    problem(small_plant.send(run_id, bytes(33_000_000)), 413, "too-large")

    assert time.perf_counter() - start < 2.0


def test_a_body_over_the_limit_in_pieces_is_refused_too(small_plant: Plant, run_id: str) -> None:
    pieces = (bytes(1_000_000) for _ in range(40))

    answer = small_plant.call(
        "POST", f"/runs/{run_id}/captures", content=pieces, headers={"Content-Type": "image/png"}
    )

    problem(answer, 413, "too-large")


@pytest.mark.parametrize("index", [8, 999])
def test_a_pose_that_the_set_has_not_is_refused(small_plant: Plant, run_id: str, index: int) -> None:
    problem(small_plant.send(run_id, picture(0), pose_index=index), 422, "pose-index-unknown")


@pytest.mark.parametrize("index", ["-1", "1000", "1e3", "x", "99999999999999999999"])
def test_a_pose_index_that_is_none_is_refused(small_plant: Plant, run_id: str, index: str) -> None:
    path = f"/runs/{run_id}/captures?pose_index={index}"

    answer = small_plant.call("POST", path, content=picture(0), headers={"Content-Type": "image/png"})

    assert problem(answer, 422, "validation-failed")["errors"][0]["pointer"] == "query/pose_index"


@pytest.mark.parametrize("media_type", ["application/json", "text/plain", ""])
def test_a_body_of_another_type_is_refused(small_plant: Plant, run_id: str, media_type: str) -> None:
    problem(small_plant.send(run_id, picture(0), media_type=media_type), 415, "media-type-unsupported")


@pytest.mark.parametrize("files", [{"photo": ("a.png", b"x")}, {"image": (None, "text")}])
def test_a_form_without_the_image_is_refused(
    small_plant: Plant, run_id: str, files: dict[str, object]
) -> None:
    problem(small_plant.call("POST", f"/runs/{run_id}/captures", files=files), 400, "bad-request")


def test_a_broken_form_is_refused(small_plant: Plant, run_id: str) -> None:
    for content_type in ("multipart/form-data", "multipart/form-data; boundary=x"):
        problem(small_plant.send(run_id, b"--y\r\nbroken", media_type=content_type), 400, "bad-request")


def test_an_unknown_capture_is_not_found(small_plant: Plant) -> None:
    problem(small_plant.get(f"/captures/{uuid4()}"), 404, "not-found")
    problem(small_plant.get(f"/captures/{uuid4()}/image"), 404, "not-found")
    problem(small_plant.get("/captures/not-a-uuid"), 422, "validation-failed")
