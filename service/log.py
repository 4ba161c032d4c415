"""Log lines: one per event, UTC, with the run, station and trace they belong to.

Nothing secret is logged: no keys, no addresses with passwords, no request bodies.
"""

import json
import logging
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from datetime import UTC, datetime
from typing import Literal

CONTEXT: ContextVar[tuple[tuple[str, str], ...]] = ContextVar("log_context", default=())

# httpx would log the addresses that it asks, and a camera's may hold a password.
LIBRARIES = ("alembic", "httpcore", "httpx", "multipart", "python_multipart", "sqlalchemy")


@contextmanager
def logged_with(**ids: object) -> Iterator[None]:
    """Add ids, such as `run`, `station` or `trace`, to every line that is logged inside the block."""
    kept = dict(CONTEXT.get()) | {name: str(value) for name, value in ids.items() if value is not None}
    token = CONTEXT.set(tuple(kept.items()))
    try:
        yield
    finally:
        CONTEXT.reset(token)


class TextFormatter(logging.Formatter):
    """`2026-11-22T07:00:00.000Z INFO service.app started run=…`, a traceback escaped into the same line."""

    def format(self, record: logging.LogRecord) -> str:
        """Return the record on one line."""
        ids = "".join(f" {name}={value}" for name, value in CONTEXT.get())
        message = record.getMessage() + _traceback(record, self)
        line = f"{_time(record)} {record.levelname} {record.name} {message}{ids}"
        # A line break in a message could pass for another line of the log.
        return line.replace("\\", "\\\\").replace("\r", "\\r").replace("\n", "\\n")


class JsonFormatter(logging.Formatter):
    """One JSON object a line, for a collector of logs."""

    def format(self, record: logging.LogRecord) -> str:
        """Return the record on one line."""
        line = {
            "time": _time(record),
            "level": record.levelname,
            "logger": record.name,
            "message": record.getMessage(),
            **dict(CONTEXT.get()),
        }
        if record.exc_info:
            line["traceback"] = self.formatException(record.exc_info)
        return json.dumps(line, ensure_ascii=False)


def configure_logging(level: str, form: Literal["text", "json"]) -> None:
    """Send all log lines to the error stream in one format; libraries speak from WARNING on."""
    handler = logging.StreamHandler()
    handler.setFormatter(JsonFormatter() if form == "json" else TextFormatter())
    root = logging.getLogger()
    root.handlers[:] = [handler]
    root.setLevel(level)
    for name in LIBRARIES:
        logging.getLogger(name).setLevel(max(logging.WARNING, root.level))


def _time(record: logging.LogRecord) -> str:
    moment = datetime.fromtimestamp(record.created, UTC)
    return moment.isoformat(timespec="milliseconds").replace("+00:00", "Z")


def _traceback(record: logging.LogRecord, formatter: logging.Formatter) -> str:
    return f"\n{formatter.formatException(record.exc_info)}" if record.exc_info else ""
