"""`dmscal calibrate` with a fixture: where the camera is in the vehicle, from a folder and a picture."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from service.cli import main
from tests.api.rest.test_extrinsics import FIXTURE, PICTURE, SEEN, T_VEHICLE_CAM, pose_json
from tests.plant import SKU, encode, picture, pose_set, shown_at

Printed = pytest.CaptureFixture[str]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Images of the poses, a picture of the fixed target among them, the fixture and the SKU."""
    path = tmp_path_factory.mktemp("mounted")
    for index in range(len(pose_set().poses)):
        (path / f"{index}.png").write_bytes(picture(index))
    (path / "fixed.png").write_bytes(PICTURE)
    (path / "fixture.json").write_text(json.dumps(FIXTURE))
    sku = {**SKU, "mounting": pose_json(T_VEHICLE_CAM)}
    (path / "sku.json").write_text(json.dumps(sku))
    return path


def run(folder: Path, *more: object) -> int:
    """Calibrate the folder with its SKU."""
    given = ("calibrate", folder, "--sku", folder / "sku.json", *more)
    return main([str(argument) for argument in given])


def with_fixture(folder: Path, *images: Path) -> list[object]:
    """The options that name the fixture and its pictures."""
    return ["--fixture", folder / "fixture.json", "--fixture-image", *(images or (folder / "fixed.png",))]


def printed_json(capsys: Printed) -> dict[str, Any]:
    """What was printed."""
    document: dict[str, Any] = json.loads(capsys.readouterr().out)
    return document


def test_a_picture_of_the_fixed_target_gives_the_place_in_the_vehicle(folder: Path, capsys: Printed) -> None:
    assert run(folder, *with_fixture(folder), "--json") == 0

    document = printed_json(capsys)
    found = document["extrinsics"]
    off_mm = 1000 * (np.array(found["pose"]["tvec"]) - T_VEHICLE_CAM.tvec)
    assert np.all(np.abs(off_mm) < 3 * np.array(found["translation_sd_mm"]))
    assert np.array(found["covariance"]).shape == (6, 6)
    assert found["fixture"] == FIXTURE
    assert [view["name"] for view in found["views"]] == ["fixed.png"]
    names = {gate["name"] for gate in document["gates"] if gate["gate"] == "extrinsics"}
    assert {"translation_sd_mm", "rotation_sd_mdeg", "mounting_off_mm", "extrinsics_rms_px"} <= names
    # The picture lies in the folder, and is none of the images that the intrinsics come from.
    assert [image["name"] for image in document["images"]] == [
        f"{index}.png" for index in range(len(pose_set().poses))
    ]


def test_the_report_for_people_holds_place_and_gates(folder: Path, capsys: Printed) -> None:
    assert run(folder, *with_fixture(folder)) == 0

    lines = capsys.readouterr().out.splitlines()
    at = next(i for i, line in enumerate(lines) if line.startswith("Extrinsics"))
    axis, place, sd, unit = lines[at + 1].split()
    assert (axis, unit) == ("x", "mm")
    assert abs(float(place) - 1000 * T_VEHICLE_CAM.tvec[0]) < 3 * float(sd)
    assert lines[at + 4].split()[-1] == "deg"
    assert any(line.split()[:2] == ["extrinsics", "translation_sd_mm"] for line in lines)
    assert any(line.startswith("1 picture(s) of chessboard:7x5:30mm") for line in lines)


def test_without_a_fixture_there_is_no_place(folder: Path, capsys: Printed) -> None:
    assert run(folder, "--json") in {0, 1}

    document = printed_json(capsys)
    assert document["extrinsics"] is None
    assert "extrinsics" not in {gate["gate"] for gate in document["gates"]}
    assert "fixed.png" in [image["name"] for image in document["images"]]


def test_a_camera_that_is_not_where_it_belongs_fails(folder: Path, tmp_path: Path, capsys: Printed) -> None:
    elsewhere = {**FIXTURE, "pose": {**FIXTURE["pose"], "tvec": [1.6, 0.2, 1.0]}}
    (tmp_path / "fixture.json").write_text(json.dumps(elsewhere))
    images = ["--fixture-image", folder / "fixed.png"]

    assert run(folder, "--fixture", tmp_path / "fixture.json", *images, "--json") == 1

    failed = {gate["name"] for gate in printed_json(capsys)["gates"] if gate["verdict"] == "FAIL"}
    assert failed == {"mounting_off_mm"}


def test_several_pictures_are_one_place(folder: Path, tmp_path: Path, capsys: Printed) -> None:
    (tmp_path / "again.png").write_bytes(encode(shown_at(SEEN, 78)))

    assert run(folder, *with_fixture(folder, folder / "fixed.png", tmp_path / "again.png"), "--json") == 0

    found = printed_json(capsys)["extrinsics"]
    assert [view["name"] for view in found["views"]] == ["fixed.png", "again.png"]
    assert found["image_agreement_px"] < 0.3


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("{", "Invalid JSON"),
        ("{}", "target: Field required"),
        (json.dumps({**FIXTURE, "target": "chess"}), "is not a target"),
        (json.dumps({**FIXTURE, "translation_sd_mm": -1}), "translation_sd_mm"),
    ],
)
def test_a_fixture_is_told_what_to_correct(
    folder: Path, tmp_path: Path, capsys: Printed, content: str, said: str
) -> None:
    path = tmp_path / "fixture.json"
    path.write_text(content)

    assert run(folder, "--fixture", path, "--fixture-image", folder / "fixed.png", "--json") == 2

    problem = printed_json(capsys)
    assert problem["code"] == "fixture-file-unreadable"
    assert said in problem["detail"]


def test_a_picture_that_cannot_be_used_is_named(folder: Path, tmp_path: Path, capsys: Printed) -> None:
    grey = np.full((400, 640), 128, np.uint8)
    (tmp_path / "grey.png").write_bytes(encode(grey))
    large = np.kron(shown_at(SEEN, 77), np.ones((2, 2), np.uint8))
    (tmp_path / "large.png").write_bytes(encode(large))
    for name, code in (
        ("absent.png", "image-unreadable"),
        ("grey.png", "target-not-visible"),
        ("large.png", "wrong-image-size"),
    ):
        assert run(folder, *with_fixture(folder, tmp_path / name), "--json") == 2
        problem = printed_json(capsys)
        assert (problem["code"], name in problem["detail"]) == (code, True)


@pytest.mark.parametrize("half", [["--fixture", "f.json"], ["--fixture-image", "a.png"]])
def test_fixture_and_picture_belong_together(folder: Path, capsys: Printed, half: list[str]) -> None:
    assert run(folder, *half, "--json") == 2
    problem = printed_json(capsys)
    assert problem["code"] == "bad-request"
    assert "--fixture-image" in problem["detail"]
