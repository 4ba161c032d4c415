"""The command: what it prints, where, and with which exit status."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from service import __version__
from service.api.schemas import generated_files
from service.cli import build_parser, main
from service.simulator.renderer import prepare
from service.simulator.scene import production_scene
from tests.core.quality.seen_views import BOARD, CAMERA, NOMINAL, POSES

SKU = {
    "code": "lens1",
    "name": "DMS camera, 80 degrees",
    "lens": "pinhole5",
    "image_size": [1280, 800],
    "nominal": NOMINAL.parameters,
    "target": BOARD.spec,
    "pose_count": 6,
}
Printed = pytest.CaptureFixture[str]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with twelve rendered images."""
    path = tmp_path_factory.mktemp("images")
    rng = np.random.default_rng(9)
    scene = prepare(production_scene(CAMERA, BOARD, seed=9))
    for i, pose in enumerate(POSES):
        assert cv2.imwrite(str(path / f"{i}.png"), scene.render(pose, rng))
    return path


@pytest.fixture
def sku_file(tmp_path: Path) -> Path:
    path = tmp_path / "sku.json"
    path.write_text(json.dumps(SKU))
    return path


@pytest.fixture
def data_dir(tmp_path: Path) -> str:
    return str(tmp_path / "data")


def run(*arguments: object) -> int:
    return main([str(argument) for argument in arguments])


def problem_of(printed: Printed) -> dict[str, Any]:
    document: dict[str, Any] = json.loads(printed.readouterr().out)
    assert {"type", "title", "status", "detail", "code", "facts"} <= set(document)
    return document


def test_calibrate_prints_one_json_object(folder: Path, capsys: Printed) -> None:
    assert run("calibrate", folder, "--target", "chessboard:9x6:25mm", "--lens", "pinhole5", "--json") == 0
    document = json.loads(capsys.readouterr().out)
    assert document["verdict"] == "PASS"
    assert list(document["intrinsics"])[:4] == ["fx", "fy", "cx", "cy"]
    assert abs(document["intrinsics"]["fx"] - CAMERA.parameters["fx"]) < 0.5
    assert [image["status"] for image in document["images"]] == ["used"] * len(POSES)
    assert {"sd", "rms_px", "gates"} <= set(document)


def test_calibrate_prints_a_report_for_people(folder: Path, capsys: Printed) -> None:
    assert run("calibrate", folder, "--target", "chessboard:9x6:25mm") == 0
    assert "P   A   S   S" in capsys.readouterr().out


def test_fixed_parameters_are_not_estimated(folder: Path, capsys: Printed) -> None:
    assert run("calibrate", folder, "--target", "chessboard:9x6:25mm", "--fix", "k3, p1,p2", "--json") == 0
    document = json.loads(capsys.readouterr().out)
    assert [document["intrinsics"][name] for name in ("k3", "p1", "p2")] == [0.0, 0.0, 0.0]
    assert document["fixed"] == ["p1", "p2", "k3"]


def test_a_sku_brings_its_target_lens_and_limits(folder: Path, sku_file: Path, capsys: Printed) -> None:
    sku_file.write_text(json.dumps({**SKU, "limits": {"rms_px": 0.001, "smallest_rms_px": 0.0}}))
    assert run("calibrate", folder, "--sku", sku_file, "--json") == 1
    document = json.loads(capsys.readouterr().out)
    failed = [one["name"] for one in document["gates"] if one["verdict"] == "FAIL"]
    assert (document["verdict"], failed) == ("FAIL", ["rms_px"])
    assert document["score"] > 0


def test_another_camera_than_the_skus_gives_too_few_views(
    folder: Path, sku_file: Path, capsys: Printed
) -> None:
    sku_file.write_text(json.dumps({**SKU, "image_size": [1920, 1208]}))
    assert run("calibrate", folder, "--sku", sku_file, "--json") == 2
    problem = problem_of(capsys)
    assert problem["code"] == "too-few-views"
    assert "0.png" in problem["facts"]["refused"]


def test_the_wrong_board_is_named_for_every_image(folder: Path, capsys: Printed) -> None:
    assert run("calibrate", folder, "--target", "chessboard:7x5:25mm", "--json") == 2
    problem = problem_of(capsys)
    assert problem["facts"]["reasons"] == ["wrong-target"] * len(POSES)
    assert "chessboard:9x6" in problem["detail"]


@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        (("absent", "--target", "chessboard:9x6"), "folder-unusable"),
        (("absent", "--target", "chess"), "target-spec-invalid"),
        (("absent", "--target", "chessboard:9x6", "--lens", "magic"), "intrinsics-invalid"),
        (("absent", "--target", "chessboard:9x6", "--fix", "k9"), "intrinsics-invalid"),
        (("absent",), "bad-request"),
        (("absent", "--what"), "bad-request"),
        ((), "bad-request"),
        (("absent", "--sku", "absent.json"), "sku-file-unreadable"),
    ],
)
def test_bad_input_is_a_problem_and_exit_status_2(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: Printed,
    arguments: tuple[str, ...],
    code: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run("calibrate", *arguments, "--json") == 2
    assert problem_of(capsys)["code"] == code
    assert run("calibrate", *arguments) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("dmscal: ")


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"{", "Invalid JSON"),
        (b"[]", "no SKU document"),
        (b'{"code": "x"}', "image_size"),
        (json.dumps({**SKU, "limits": {"rms": 1}}).encode(), "No such limit: rms"),
        (b"\xff\xfe\x00", "no SKU document"),
    ],
)
def test_a_sku_file_is_told_what_to_correct(
    tmp_path: Path, capsys: Printed, content: bytes, said: str
) -> None:
    path = tmp_path / "sku.json"
    path.write_bytes(content)
    assert run("plan", path) == 2
    assert said in capsys.readouterr().err


def test_plan_writes_the_pose_set(sku_file: Path, tmp_path: Path, capsys: Printed) -> None:
    out = tmp_path / "set.json"
    assert run("plan", sku_file, "--out", out, "--count", 5, "--seed", 3) == 0
    text = capsys.readouterr().out
    document = json.loads(out.read_text())
    assert len(document["poses"]) == 5
    assert (document["sku"], document["provenance"]["seed"]) == ("lens1", 3)
    assert (document["revision"], document["image_size"]) == (None, SKU["image_size"])
    assert document["target"] == SKU["target"]
    assert "5 poses for lens1" in text
    assert text.isascii()


def test_plan_is_reproducible_and_takes_the_skus_count(sku_file: Path, capsys: Printed) -> None:
    assert run("plan", sku_file, "--json") == 0
    first = capsys.readouterr().out
    assert run("plan", sku_file, "--json") == 0
    assert capsys.readouterr().out == first
    assert len(json.loads(first)["poses"]) == SKU["pose_count"]


def test_plan_says_when_it_cannot_write_or_count(sku_file: Path, tmp_path: Path, capsys: Printed) -> None:
    assert run("plan", sku_file, "--out", tmp_path / "absent" / "set.json") == 2
    assert "Choose another --out" in capsys.readouterr().err
    assert run("plan", sku_file, "--count", 2) == 2
    assert "dmscal: " in capsys.readouterr().err


def test_migrate_then_keys(data_dir: str, capsys: Printed) -> None:
    assert run("keys", "list", "--data-dir", data_dir) == 2
    assert "dmscal migrate" in capsys.readouterr().err
    assert run("migrate", "--data-dir", data_dir) == 0
    assert run("migrate", "--data-dir", data_dir) == 0
    capsys.readouterr()

    assert run("keys", "add", "line 3", "--role", "operator", "--data-dir", data_dir) == 0
    printed = capsys.readouterr()
    key = printed.out.strip()
    assert key.startswith("dmscal_")
    assert key not in printed.err

    assert run("keys", "list", "--data-dir", data_dir) == 0
    line = capsys.readouterr().out
    assert "line 3" in line
    assert key not in line
    assert run("keys", "revoke", line.split()[0], "--data-dir", data_dir) == 0
    capsys.readouterr()
    assert run("keys", "list", "--data-dir", data_dir) == 0
    assert "revoked" in capsys.readouterr().out


@pytest.mark.parametrize("name", ["", "a\x00b", "x" * 300])
def test_a_key_needs_a_name_that_can_be_shown(data_dir: str, capsys: Printed, name: str) -> None:
    assert run("keys", "add", name, "--role", "viewer", "--data-dir", data_dir) == 2
    assert "name" in capsys.readouterr().err


@pytest.mark.parametrize(("name", "begins"), [("board.pdf", b"%PDF-"), ("board.SVG", b"<?xml")])
def test_a_sheet_is_written_as_its_name_says(
    tmp_path: Path, capsys: Printed, name: str, begins: bytes
) -> None:
    assert run("sheet", "chessboard:9x6:25mm", "--out", tmp_path / name) == 0
    assert (tmp_path / name).read_bytes().startswith(begins)
    assert "A4, 297 x 210 mm. Print it at 100 %" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("chessboard:9x6:25mm", "--out", "board.png"), "neither .pdf nor .svg"),
        (("chessboard:9x6:25mm", "--out", "absent/board.pdf"), "Choose another --out"),
        (("chessboard:9x6:300mm", "--out", "board.pdf"), "larger paper"),
        (("paper", "--out", "board.pdf"), "is not a target"),
    ],
)
def test_a_sheet_that_cannot_be_written_says_why(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Printed, arguments: tuple[str, ...], said: str
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run("sheet", *arguments) == 2
    assert said in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("key_id", ["nonsense", "00000000-0000-7000-8000-000000000000"])
def test_an_unknown_key_cannot_be_revoked(data_dir: str, capsys: Printed, key_id: str) -> None:
    assert run("migrate", "--data-dir", data_dir) == 0
    assert run("keys", "revoke", key_id, "--data-dir", data_dir) == 2
    assert "list" in capsys.readouterr().err.lower()


def test_a_wrong_setting_is_named(monkeypatch: pytest.MonkeyPatch, capsys: Printed) -> None:
    monkeypatch.setenv("DMSCAL_PORT", "many")
    assert run("serve") == 2
    assert "port" in capsys.readouterr().err


def test_schemas_belong_to_a_checkout(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Printed
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run("schemas") == 2
    (tmp_path / "pyproject.toml").touch()
    (tmp_path / "web").mkdir()
    assert run("schemas") == 0
    assert all((tmp_path / path).read_text() == text for path, text in generated_files().items())
    capsys.readouterr()
    assert run("schemas") == 0
    assert "up to date" in capsys.readouterr().out


def test_version(capsys: Printed) -> None:
    assert run("version") == 0
    assert capsys.readouterr().out == f"dmscal {__version__}\n"


def test_every_verb_has_help_and_something_to_run(capsys: Printed) -> None:
    verbs = (
        "calibrate",
        "plan",
        "sheet",
        "serve",
        "migrate",
        "keys",
        "verify",
        "signing",
        "export",
        "block",
        "schemas",
    )
    for verb in (*verbs, "version"):
        with pytest.raises(SystemExit) as ended:
            build_parser().parse_args([verb, "--help"])
        assert ended.value.code == 0
    assert "--port" in capsys.readouterr().out


def test_an_interrupt_ends_quietly(monkeypatch: pytest.MonkeyPatch, capsys: Printed) -> None:
    def interrupt(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("service.cli.calibrate_folder", interrupt)
    assert run("calibrate", "folder", "--target", "chessboard:9x6") == 130
    assert capsys.readouterr().err == "Interrupted.\n"


def test_a_reader_that_leaves_is_no_fault() -> None:
    receiver, sender = os.pipe()
    os.close(receiver)
    ended = subprocess.run(
        [sys.executable, "-m", "service", "version"], stdout=sender, stderr=subprocess.PIPE, check=False
    )
    os.close(sender)
    assert ended.returncode == 141
    assert ended.stderr == b""
