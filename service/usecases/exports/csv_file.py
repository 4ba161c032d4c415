"""CSV (RFC 4180, UTF-8): the long table, numbers with all their digits.

Texts that a spreadsheet would run as a formula get an apostrophe before them.
"""

import csv
from collections.abc import Iterable
from dataclasses import astuple, fields
from datetime import datetime
from io import StringIO

from service.usecases.exports.format import Format
from service.usecases.exports.long_table import Row, rows_of
from service.usecases.finished_run import FinishedRun, RunFacts

FORMULA_STARTS = ("=", "+", "-", "@", "\t", "\r")


def write(run: FinishedRun) -> bytes:
    """Return the file of one run."""
    return write_many([run.facts])


def write_many(runs: Iterable[RunFacts]) -> bytes:
    """Return the file of many runs."""
    text = StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow([field.name for field in fields(Row)])
    for run in runs:
        writer.writerows([_cell(value) for value in astuple(row)] for row in rows_of(run))
    return text.getvalue().encode("utf-8")


def _cell(value: object) -> object:
    if isinstance(value, datetime):
        return f"{value:%Y-%m-%dT%H:%M:%S.%fZ}"
    if isinstance(value, str) and value.startswith(FORMULA_STARTS):
        return f"'{value}"
    return value


FORMAT = Format("csv", "CSV", "text/csv; charset=utf-8", "csv", write, write_many)
