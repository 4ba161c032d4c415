"""Puts stored results into a page: `python -m bench.page PAGE "NAME=FILE.json" ...`.

Between the marks `<!-- bench NAME: begin -->` and `<!-- bench NAME: end -->` of a page stands what the bench
NAME prints of the result in FILE. Not here: the words around it, which somebody has to read again.
"""

import json
import re
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from bench.__main__ import find_benches, write_atomically


def main(arguments: Sequence[str]) -> int:
    """Fill the page that is named first; return 2 for a name that is no bench or has no place in the page."""
    page, *given = arguments
    text, benches = Path(page).read_text(encoding="utf-8"), find_benches()
    for name, _, file in (one.partition("=") for one in given):
        if name not in benches or begin_mark(name) not in text:
            print(f"'{name}' is no bench, or {page} has no '{begin_mark(name)}'.", file=sys.stderr)
            return 2
        result: Mapping[str, Any] = json.loads(Path(file).read_text(encoding="utf-8"))
        text = fill(text, name, benches[name].table(result))
    write_atomically(Path(page), text)
    return 0


def begin_mark(name: str) -> str:
    """Return the mark after which a bench's table stands."""
    return f"<!-- bench {name}: begin -->"


def fill(text: str, name: str, table: str) -> str:
    """Return a page's text with a table in its place."""
    end = f"<!-- bench {name}: end -->"
    place = re.compile(f"{re.escape(begin_mark(name))}.*?{re.escape(end)}", re.DOTALL)
    return place.sub(lambda _: f"{begin_mark(name)}\n```\n{table}\n```\n{end}", text)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
