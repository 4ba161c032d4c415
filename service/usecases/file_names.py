"""Names of files about a result: serial, moment, and FAIL where it is one; nothing a disk stumbles over."""

from service.core.quality.gates import Verdict
from service.usecases.finished_run import RunFacts


def result_file_name(facts: RunFacts, what: str, suffix: str) -> str:
    """Return the name of a file about a result; `what` tells it from the others, or is empty."""
    serial = "".join(c if c.isalnum() or c in "._-" else "_" for c in facts.serial).lstrip(".")
    verdict = facts.verdict.value if facts.verdict is Verdict.FAIL else ""
    parts = (serial or "run", f"{facts.finished_at:%Y%m%dT%H%M%SZ}", what, verdict)
    return f"{'-'.join(part for part in parts if part)}.{suffix}"
