"""The layers of the house hold: import-linter's contracts in pyproject.toml."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_import_contracts_hold() -> None:
    command = [
        sys.executable,
        "-c",
        "from importlinter.cli import lint_imports_command as c; c()",
        "--no-cache",
    ]

    outcome = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)  # noqa: S603 - our own command

    assert outcome.returncode == 0, outcome.stdout + outcome.stderr


def test_every_import_stands_at_the_top_of_its_file() -> None:
    nested = [
        f"{path.relative_to(ROOT)}:{number}"
        for path in (ROOT / "service").rglob("*.py")
        for number, line in enumerate(path.read_text().splitlines(), 1)
        if line.startswith((" ", "\t")) and line.lstrip().startswith(("import ", "from service"))
    ]

    assert nested == []
