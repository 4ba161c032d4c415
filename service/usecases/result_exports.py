"""Give results away as files: one run in any format, many as a table, and the block of a camera's memory.

A result with the verdict FAIL leaves only where that is asked for. Not here: the formats (`exports`).
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Final
from uuid import UUID

from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.errors import NotFound
from service.core.quality.gates import Verdict
from service.core.run import RunState
from service.storage.models import RunRow
from service.usecases.audit import record
from service.usecases.block_check import BlockCheck, check_block
from service.usecases.block_layout import BlockLayout
from service.usecases.exports import binary_block
from service.usecases.exports.format import Format
from service.usecases.exports.formats import FORMATS
from service.usecases.file_names import result_file_name
from service.usecases.finished_run import FinishedRun, RunFacts, load_facts, load_finished_run
from service.usecases.paging import PageRequest, page_of
from service.usecases.result_problems import ResultFailed
from service.usecases.run_filter import RunFilter

# Of so many runs the facts are held at once; a table is written run by run.
RUNS_AT_ONCE: Final = 100
MOST_RUNS: Final = 1000


@dataclass(frozen=True)
class ExportedFile:
    """A file, how it is called and of what type it is."""

    content: bytes
    name: str
    media_type: str


@dataclass(frozen=True)
class ExportedRuns:
    """A table of a part of the runs; `next_cursor` is None at the end."""

    file: ExportedFile
    runs: int
    next_cursor: str | None


def export_run(session: Session, run_id: UUID, name: str, *, allow_failed: bool) -> ExportedFile:
    """Return the result of a finished run in a format.

    Raises NotFound for an unknown run, one without a result, and an unknown format; ResultFailed for a FAIL
    that was not asked for; FormatCannotSay, BlockLayoutUnusable.
    """
    chosen = find_format(name)
    run = load_finished_run(session, run_id)
    check_may_leave(run, allow_failed=allow_failed)
    return _file(run, chosen, chosen.write(run))


def export_runs(
    session: Session, name: str, wanted: RunFilter, page: PageRequest, *, allow_failed: bool
) -> ExportedRuns:
    """Return a part of the finished runs as one table, newest first; those that failed only if allowed.

    Raises NotFound for a format that holds one run only; CursorInvalid.
    """
    chosen = find_format(name)
    if chosen.write_many is None:
        many = ", ".join(one.name for one in FORMATS.values() if one.write_many is not None)
        raise NotFound(
            f"The format '{name}' holds one run in a file. For many runs take one of: {many}.", format=name
        )
    query = wanted.narrow(select(RunRow)).where(RunRow.state == RunState.FINISHED)
    if not allow_failed:
        query = query.where(RunRow.verdict != Verdict.FAIL)
    part = page_of(session, query, RunRow, page)
    content = chosen.write_many(_facts_of(session, part.items))
    file = ExportedFile(content, f"runs.{chosen.suffix}", chosen.media_type)
    return ExportedRuns(file, len(part.items), part.next_cursor)


def make_block(session: Session, run_id: UUID, layout: BlockLayout, *, allow_failed: bool) -> ExportedFile:
    """Return the block of a finished run by a layout; raises as `export_run`."""
    run = load_finished_run(session, run_id)
    check_may_leave(run, allow_failed=allow_failed)
    return _file(run, binary_block.FORMAT, binary_block.write_by(run, layout))


def check_run_block(
    session: Session,
    run_id: UUID,
    layout: BlockLayout | None,
    found: bytes,
    *,
    who: str,
    now: datetime,
) -> BlockCheck:
    """Compare a block that was read back from a camera with the stored result, and note what came out.

    Raises NotFound, BlockLayoutUnusable.
    """
    run = load_finished_run(session, run_id)
    checked = check_block(run, binary_block.layout_of(run, layout), found)
    record(
        session,
        now,
        who,
        "block.check",
        f"run:{run_id}",
        serial=run.facts.serial,
        matches=checked.matches,
        differences=[difference.field for difference in checked.differences],
    )
    return checked


def find_format(name: str) -> Format:
    """Return a format; raises NotFound naming those that there are."""
    if name not in FORMATS:
        raise NotFound(
            f"There is no format '{name[:40]}'. Choose one of: {', '.join(FORMATS)}.", format=name[:40]
        )
    return FORMATS[name]


def check_may_leave(run: FinishedRun, *, allow_failed: bool) -> None:
    """Raise ResultFailed for a result with the verdict FAIL, unless that is allowed."""
    if run.facts.verdict is Verdict.FAIL and not allow_failed:
        raise ResultFailed(
            "The verdict of this run is FAIL: its values must not go into a vehicle. To look at them anyway, "
            "ask with allow_failed=true; the file says FAIL wherever its format has room.",
            run=f"/api/v1/runs/{run.facts.run_id}",
            verdict=run.facts.verdict.value,
        )


def _facts_of(session: Session, runs: Sequence[RunRow]) -> Iterator[RunFacts]:
    for first in range(0, len(runs), RUNS_AT_ONCE):
        yield from load_facts(session, runs[first : first + RUNS_AT_ONCE])


def _file(run: FinishedRun, chosen: Format, content: bytes) -> ExportedFile:
    name = result_file_name(run.facts, chosen.name, chosen.suffix)
    return ExportedFile(content, name, chosen.media_type)
