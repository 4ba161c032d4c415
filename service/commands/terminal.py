"""What verbs write: text, files, problems; and the exit statuses. Not here: what any verb does."""

import json
import sys
from pathlib import Path
from typing import Any

from service.api.problems import problem_body, status_of
from service.core.errors import BadRequest, ServiceError

DONE, FAILED, BAD_INPUT, INTERRUPTED, PIPE_CLOSED = 0, 1, 2, 130, 141


def print_text(text: str) -> None:
    """Print a text and a line's end."""
    # A file name may hold what the terminal cannot show; that must not lose the report.
    encoding = sys.stdout.encoding or "ascii"
    sys.stdout.write(text.encode(encoding, "backslashreplace").decode(encoding) + "\n")


def tell_problem(error: ServiceError, *, as_json: bool) -> None:
    """Tell a problem: on stderr, or as a problem document on stdout."""
    if as_json:
        problem = {
            "type": f"/problems/{error.code}",
            "status": int(status_of(type(error))),
            **problem_body(error),
        }
        print_text(to_json(problem))
    else:
        sys.stderr.write(f"dmscal: {error.detail}\n")


def to_json(document: dict[str, Any]) -> str:
    """Return a document as JSON for people."""
    return json.dumps(document, indent=2, allow_nan=False)


def write_file(path: Path, content: bytes) -> None:
    """Write a file; raises BadRequest where that is not possible."""
    try:
        path.write_bytes(content)
    except OSError as error:
        raise BadRequest(f"'{path}' cannot be written: {error.strerror}. Choose another --out.") from error


def read_file(path: Path, largest_bytes: int) -> bytes:
    """Return the content of a file; raises BadRequest where it cannot be read or is too large."""
    try:
        with path.open("rb") as file:
            content = file.read(largest_bytes + 1)
    except OSError as error:
        raise BadRequest(f"'{path}' cannot be read: {error.strerror}.") from error
    if len(content) > largest_bytes:
        raise BadRequest(f"'{path}' is larger than {largest_bytes} bytes; it is not what is asked for here.")
    return content
