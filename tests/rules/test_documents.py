"""What the documents promise is there: commands, files, links, and no address in a lock file."""

import argparse
import json
import re
import subprocess
import tomllib
from pathlib import Path

import pytest

from service.cli import build_parser

ROOT = Path(__file__).resolve().parents[2]
DOCUMENTS = sorted([*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")])
TARGET = re.compile(r"\bmake ([a-z]+)\b")
LINK = re.compile(r"\]\((?!https?:|#|mailto:)([^)#]+)")


def _code(text: str) -> str:
    blocks = re.findall(r"```(?:sh|bash|console)\n(.*?)```", text, re.S)
    return "\n".join([*blocks, *re.findall(r"`([^`\n]+)`", text)])


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda p: p.name)
def test_every_make_command_in_a_document_exists(document: Path) -> None:
    known = set(re.findall(r"^([a-z]+):", (ROOT / "Makefile").read_text(), re.M))

    assert set(TARGET.findall(_code(document.read_text()))) <= known


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda p: p.name)
def test_every_dmscal_command_in_a_document_exists(document: Path) -> None:
    named = set(re.findall(r"(?:^|[\s/])dmscal ([a-z]+)\b", _code(document.read_text())))
    verbs = next(
        action for action in build_parser()._actions if isinstance(action, argparse._SubParsersAction)
    )

    assert named <= set(verbs.choices)


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda p: p.name)
def test_every_local_link_in_a_document_leads_somewhere(document: Path) -> None:
    missing = [link for link in LINK.findall(document.read_text()) if not (document.parent / link).exists()]

    assert missing == []


def test_ci_calls_the_readmes_test_command() -> None:
    assert "make test" in (ROOT / "README.md").read_text()
    assert "make test" in (ROOT / ".ci" / "run").read_text()


def test_lock_files_hold_no_address() -> None:
    locks = [*ROOT.glob("requirements*.lock"), ROOT / "web" / "package-lock.json"]

    assert len(locks) == 3
    assert [lock.name for lock in locks if re.search(r"https?://", lock.read_text())] == []


def test_no_tracked_file_holds_a_path_of_a_machine() -> None:
    pattern = "/ro" + "ot/|/wo" + "rk/|/ho" + "me/[a-z]+/"

    outcome = subprocess.run(  # noqa: S603 - our own command
        ["git", "grep", "-lE", pattern, "--", ".", ":!LICENSE"],  # noqa: S607 - git is found on the path
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )

    assert outcome.stdout == ""


def test_python_dependencies_are_all_locked() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    lock = (ROOT / "requirements.lock").read_text()

    names = [re.split(r"[\[><=~ ]", line)[0] for line in project["dependencies"]]

    assert [name for name in names if f"\n{name}==" not in f"\n{lock}"] == []


def test_web_lock_matches_its_package() -> None:
    package = json.loads((ROOT / "web" / "package.json").read_text())
    lock = json.loads((ROOT / "web" / "package-lock.json").read_text())

    for kind in ("dependencies", "devDependencies"):
        assert lock["packages"][""].get(kind, {}) == package.get(kind, {})
