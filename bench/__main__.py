"""The command `python -m bench`: run one bench, print its table, write its JSON."""

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
from typing import Any, Protocol, cast

import bench

PACKAGES = ("numpy", "scipy", "opencv-python-headless")


class Bench(Protocol):
    """What a module of a bench has."""

    def run(self, quick: bool) -> dict[str, Any]:
        """Return what was measured, `seeds` included."""

    def table(self, result: Mapping[str, Any]) -> str:
        """Return the result as text for a terminal."""


def main(arguments: Sequence[str]) -> int:
    """Run the bench that the arguments name and return the exit status: 2 where there is no such bench."""
    benches = find_benches()
    parser = argparse.ArgumentParser(prog="python -m bench", description="Measure one claim, side by side.")
    parser.add_argument("name", help=f"one of: {', '.join(benches)}")
    parser.add_argument("--quick", action="store_true", help="under a minute, the same keys")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the result to a file")
    options = parser.parse_args(arguments)
    if options.name not in benches:
        print(f"No bench is called '{options.name}'; choose one of: {', '.join(benches)}.", file=sys.stderr)
        return 2
    chosen = benches[options.name]
    result = with_provenance(chosen.run(options.quick), options.quick)
    print(chosen.table(result))
    if options.json is not None:
        write_atomically(options.json, json.dumps(result, indent=2) + "\n")
    return 0


def find_benches() -> dict[str, Bench]:
    """Return the benches by name: the modules of this package that have `run` and `table`."""
    names = sorted(module.name for module in pkgutil.iter_modules(bench.__path__) if module.name[0] != "_")
    modules = {name: importlib.import_module(f"bench.{name}") for name in names}
    return {
        name: cast("Bench", module)
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
