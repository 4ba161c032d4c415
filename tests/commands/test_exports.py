"""`dmscal export` and `dmscal block check` on the database of an installation."""

import json
import shutil
from collections.abc import Iterator
from pathlib import Path

import cv2
import pytest

from service.cli import main
from tests.databases import sqlite_copy
from tests.plant import running_plant
from tests.usecases.test_block import LAYOUT

Printed = pytest.CaptureFixture[str]


def run(*arguments: object) -> int:
    return main([str(argument) for argument in arguments])


@pytest.fixture(scope="module")
def installation(
    migrated_sqlite: Path, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[tuple[Path, str]]:
    """A data directory, and the run in it that passed."""
    directory = tmp_path_factory.mktemp("installed")
    with running_plant(sqlite_copy(migrated_sqlite, directory), directory) as plant:
        plant.publish_sku()
        run_id = plant.finished_run("VIN-9")
    yield directory, run_id
    shutil.rmtree(directory)


def test_a_result_is_written_as_a_file(
    installation: tuple[Path, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Printed
) -> None:
    directory, run_id = installation
    out = tmp_path / "camera.yml"

    assert run("export", run_id, "--format", "opencv", "--out", out, "--data-dir", directory) == 0
    storage = cv2.FileStorage(str(out), cv2.FILE_STORAGE_READ)
    assert storage.getNode("serial").string() == "VIN-9"
    storage.release()

    monkeypatch.chdir(tmp_path)
    assert run("export", run_id, "--format", "pdf", "--data-dir", directory) == 0
    said = capsys.readouterr().out.splitlines()[-1]
    assert said.startswith("written: VIN-9-")
    assert (tmp_path / said.removeprefix("written: ")).read_bytes().startswith(b"%PDF")


def test_a_block_is_written_and_checked(
    installation: tuple[Path, str], tmp_path: Path, capsys: Printed
) -> None:
    directory, run_id = installation
    layout, out = tmp_path / "layout.json", tmp_path / "block.bin"
    layout.write_text(json.dumps(LAYOUT))
    by = ("--layout", layout, "--data-dir", directory)

    assert run("export", run_id, "--format", "block", "--out", out, *by) == 0
    assert run("block", "check", run_id, out, *by) == 0
    assert "matches the stored result" in capsys.readouterr().out
    content = bytearray(out.read_bytes())
    content[12] ^= 1
    out.write_bytes(content)
    assert run("block", "check", run_id, out, *by) == 1
    printed = capsys.readouterr().out
    assert "DIFFERS" in printed
    assert "fx (byte 12)" in printed
    assert "does NOT fit" in printed
    assert run("block", "check", run_id, out, *by, "--json") == 1
    document = json.loads(capsys.readouterr().out)
    assert [one["field"] for one in document["differences"]] == ["fx"]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--format", "block"), "block_layout"),
        (("--format", "kalibr"), "no words"),
        (("--format", "csv", "--layout", "layout.json"), "Only the format block"),
        (("--format", "block", "--layout", "broken.json"), "Correct"),
        (("--format", "block", "--layout", "absent.json"), "cannot be read"),
        (("--format", "csv", "--out", "absent/file.csv"), "Choose another --out"),
        (("--format", "word"), "invalid choice"),
    ],
)
def test_what_cannot_be_written_is_bad_input(
    installation: tuple[Path, str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: Printed,
    arguments: tuple[str, ...],
    said: str,
) -> None:
    directory, run_id = installation
    (tmp_path / "layout.json").write_text(json.dumps(LAYOUT))
    (tmp_path / "broken.json").write_text("{")
    monkeypatch.chdir(tmp_path)

    assert run("export", run_id, *arguments, "--data-dir", directory) == 2
    assert said in capsys.readouterr().err


def test_a_run_is_named_by_its_id(installation: tuple[Path, str], capsys: Printed) -> None:
    directory, _ = installation

    assert run("export", "VIN-9", "--format", "csv", "--data-dir", directory) == 2
    assert "no id of a run" in capsys.readouterr().err
