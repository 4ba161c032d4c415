"""The command `python -m bench`: run one bench, print its table, write its JSON, draw its picture.

A bench may have a name of two words: `paper table1` is the module `bench.paper.table1`.
"""

import argparse
import importlib
import json
import os
import pkgutil
import platform
import sys
from collections.abc import Mapping, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any, Protocol, cast, runtime_checkable

import bench

PACKAGES = ("numpy", "scipy", "opencv-python-headless")


class Bench(Protocol):
    """What a module of a bench has."""

    def run(self, quick: bool) -> dict[str, Any]:
        """Return what was measured, `seeds` included."""

    def table(self, result: Mapping[str, Any]) -> str:
        """Return the result as text for a terminal."""


@runtime_checkable
class Drawn(Protocol):
    """A bench whose result can be drawn."""

    def plot(self, result: Mapping[str, Any], path: Path) -> None:
        """Draw the result into a PNG file."""


@runtime_checkable
class Reusing(Protocol):
    """A bench that can take another one's result instead of measuring again."""

    def reuse(self, result: Mapping[str, Any]) -> dict[str, Any]:
        """Return this bench's result; raises KeyError where what it needs is missing."""


def main(arguments: Sequence[str]) -> int:
    """Run the bench that the arguments name and return the exit status: 2 for what cannot be done."""
    benches = find_benches()
    options = _parse(arguments, benches)
    name = " ".join(options.name)
    if name not in benches:
        return _refuse(f"No bench is called '{name}'; choose one of: {', '.join(benches)}.")
    chosen = benches[name]
    if options.plot is not None and not isinstance(chosen, Drawn):
        return _refuse(f"'{name}' has no picture; leave out --plot.")
    if options.reuse is None:
        result = with_provenance(chosen.run(options.quick), options.quick)
    elif isinstance(chosen, Reusing):
        try:
            result = chosen.reuse(json.loads(options.reuse.read_text(encoding="utf-8")))
        except (OSError, ValueError, KeyError) as error:
            return _refuse(f"'{name}' cannot use {options.reuse}: {error!r}.")
    else:
        return _refuse(f"'{name}' measures everything itself; leave out --reuse.")
    _hand_out(chosen, result, options)
    return 0


def _parse(arguments: Sequence[str], benches: Mapping[str, Bench]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m bench", description="Measure one claim, side by side.")
    parser.add_argument("name", nargs="+", help=f"one of: {', '.join(benches)}")
    parser.add_argument("--quick", action="store_true", help="under a minute, the same keys")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the result to a file")
    parser.add_argument("--plot", type=Path, metavar="FILE", help="draw the result into a PNG file")
    parser.add_argument(
        "--reuse", type=Path, metavar="FILE", help="take the trials of another bench's JSON file"
    )
    return parser.parse_args(arguments)


def _refuse(why: str) -> int:
    print(why, file=sys.stderr)
    return 2


def _hand_out(chosen: Bench, result: Mapping[str, Any], options: argparse.Namespace) -> None:
    """Print the table, then write what was asked for."""
    print(chosen.table(result))
    if options.json is not None:
        write_atomically(options.json, json.dumps(result, indent=2) + "\n")
    if options.plot is not None and isinstance(chosen, Drawn):
        chosen.plot(result, options.plot)


def find_benches() -> dict[str, Bench]:
    """Return the benches by name: the modules of this package, and of those in it, with `run` and `table`."""
    found = pkgutil.walk_packages(bench.__path__, f"{bench.__name__}.")
    names = sorted(module.name for module in found if not module.name.split(".")[-1].startswith("_"))
    modules = {name: importlib.import_module(name) for name in names}
    return {
        " ".join(name.split(".")[1:]): cast("Bench", module)
        for name, module in modules.items()
        if hasattr(module, "run") and hasattr(module, "table")
    }


def with_provenance(result: Mapping[str, Any], quick: bool) -> dict[str, Any]:
    """Return the result with what it was made with behind it: versions, cores, seeds."""
    measured = {key: value for key, value in result.items() if key != "seeds"}
    versions = {"python": platform.python_version(), **{package: version(package) for package in PACKAGES}}
    seeds = result.get("seeds", [])
    return {**measured, "quick": quick, "versions": versions, "cores": os.cpu_count(), "seeds": seeds}


def write_atomically(path: Path, text: str) -> None:
    """Write a file so that a reader sees the old one or the new one, never a part."""
    part = path.with_name(f".{path.name}.{os.getpid()}")
    part.write_text(text, encoding="utf-8")
    part.replace(path)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
