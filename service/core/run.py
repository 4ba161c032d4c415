"""The life cycle of a run: states, what each allows, purposes, and what a serial may look like.

Pure rules on plain values. Not here: how runs are stored and what a calibration says.
"""

import unicodedata
from enum import StrEnum

from service.core.errors import RunAborted, RunAlreadyFinished, SerialInvalid

LONGEST_SERIAL = 64
# Filters of test data systems read these as wildcards: a serial that holds one finds other vehicles (WATS
# forbids them).
WILDCARDS = "*%?_[]!"


class RunState(StrEnum):
    """Where a run stands; finished and aborted are final."""

    OPEN = "open"
    FINISHED = "finished"
    ABORTED = "aborted"


class Purpose(StrEnum):
    """Why a run is made. Only production and retest count for yield."""

    PRODUCTION = "production"
    RETEST = "retest"
    GOLDEN = "golden"
    STUDY = "study"
    TRIAL = "trial"
    SIMULATED = "simulated"

    @property
    def needs_pose_set(self) -> bool:
        """Whether the run must follow a published pose set, so that its poses can be judged."""
        return self in {Purpose.PRODUCTION, Purpose.RETEST}


class Outcome(StrEnum):
    """How a run ended. The verdict on the camera is another thing: only a completed run has one."""

    COMPLETED = "COMPLETED"
    ERROR = "ERROR"
    ABORTED = "ABORTED"
    TIMEOUT = "TIMEOUT"


def check_open(state: str, run_id: str) -> None:
    """Return if a run takes captures, a finish or an abort; else raise RunAlreadyFinished or RunAborted."""
    if state == RunState.FINISHED:
        raise RunAlreadyFinished(
            "The run is finished and its result stands. Read the result, or open a new run for a retest.",
            run=f"/api/v1/runs/{run_id}",
            result=f"/api/v1/runs/{run_id}/result",
        )
    if state == RunState.ABORTED:
        raise RunAborted(
            "The run was aborted. Open a new run for the same serial.", run=f"/api/v1/runs/{run_id}"
        )


def check_serial(serial: str) -> str:
    """Return a serial without surrounding blanks; 1 to 64 printable characters, compared exactly.

    Raises SerialInvalid naming the characters that cannot be used.
    """
    stripped = serial.strip(" ")
    if not stripped or len(stripped) > LONGEST_SERIAL:
        raise SerialInvalid(
            f"A serial has 1 to {LONGEST_SERIAL} characters; this one has {len(stripped)}. Scan the label "
            "again."
        )
    bad = sorted({_name(c) for c in stripped if c in WILDCARDS or not _is_printable(c)})
    if bad:
        raise SerialInvalid(
            f"A serial must not hold {', '.join(bad)}: control characters break labels, and the characters "
            f"{' '.join(WILDCARDS)} are wildcards in other systems. Scan the label again or check the "
            "scanner's set-up.",
            characters=bad,
        )
    return stripped


def _is_printable(character: str) -> bool:
    return unicodedata.category(character)[0] != "C" and (character == " " or not character.isspace())


def _name(character: str) -> str:
    return f"'{character}'" if character in WILDCARDS else f"U+{ord(character):04X}"
