"""A file over 400 lines or a function over 50 is a sign of two things in one."""

import ast
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("service", "bench", "tests", "migrations")


def _python_files() -> Iterator[Path]:
    for folder in FOLDERS:
        yield from (ROOT / folder).rglob("*.py")


def test_no_python_file_is_longer_than_400_lines() -> None:
    long = {
        str(path.relative_to(ROOT)): n
        for path in _python_files()
        if (n := len(path.read_text().splitlines())) > 400
    }

    assert long == {}


def test_no_page_source_is_longer_than_400_lines() -> None:
    sources = [
        p
        for p in (ROOT / "web" / "src").rglob("*")
        if p.suffix in {".ts", ".tsx", ".css"} and "generated" not in p.parts
    ]

    assert sources
    assert [str(p.relative_to(ROOT)) for p in sources if len(p.read_text().splitlines()) > 400] == []


def test_no_function_is_longer_than_50_lines() -> None:
    long = [
        f"{path.relative_to(ROOT)}:{node.lineno} {node.name}"
        for path in _python_files()
        if "versions" not in path.parts  # a migration lists its tables one after the other
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
        and (node.end_lineno or 0) - node.lineno >= 50
    ]

    assert long == []


def test_every_module_says_what_belongs_in_it() -> None:
    silent = [
        str(path.relative_to(ROOT))
        for path in (ROOT / "service").rglob("*.py")
        if ast.get_docstring(ast.parse(path.read_text())) is None
    ]

    assert silent == []
