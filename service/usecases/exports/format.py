"""What a format is to the rest of the house: a finished run in, the bytes of a file out.

Formats write only what they can say truly; they raise FormatCannotSay instead of a result that means
something else to its reader. A result with the verdict FAIL is marked wherever there is room.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from service.core.quality.gates import Verdict
from service.usecases.finished_run import FinishedRun, RunFacts


@dataclass(frozen=True)
class Format:
    """A format; `label` is what its readers call it. write_many: of those that hold many runs in one file."""

    name: str
    label: str
    media_type: str
    suffix: str
    write: Callable[[FinishedRun], bytes]
    write_many: Callable[[Iterable[RunFacts]], bytes] | None = None


def headline(facts: RunFacts) -> str:
    """Return the line that stands at the top of text formats: whose result it is, and its verdict."""
    said = f"verdict: {facts.verdict.value}"
    if facts.verdict is Verdict.FAIL:
        said += " - this calibration did not pass, do not use it"
    sku = f"SKU {facts.sku} revision {facts.revision}"
    return f"dmscal, serial {facts.serial}, {sku}, run {facts.run_id}, {said}"
