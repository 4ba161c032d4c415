"""The fault table: what RMS hides, injected again and again; is it failed, and for the right reason?

Beside it good runs, which must not fail, and what a limit of 0.5 px on the RMS alone would have said. What
cannot be seen at all is said in words. Not here: the faults themselves (`gate_faults`).
"""

from collections.abc import Mapping
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import Any

import cv2
import numpy as np

from bench.gate_faults import CASES, COUNT, SEED, Outcome, good_run
from service.core.errors import ServiceError, TooFewViews
from service.core.quality.gates import Verdict

RMS_LIMIT_PX = 0.5
PROCESSES = 2
UNSEEN = (
    "A twin of the same SKU under a wrong serial, with pictures of its own: the device must tell its serial.",
    "All pictures mirrored, poses not prescribed, the centre in the middle: a plain board has no handedness.",
)


def run(quick: bool) -> dict[str, Any]:
    """Return the shares of detected faults and right reasons, and of good runs that failed by mistake."""
    repeats, good = (3, 6) if quick else (20, 1000)
    jobs = [(name, repeats) for name in CASES]
    with ProcessPoolExecutor(PROCESSES, mp_context=get_context("spawn")) as pool:
        faults = dict(zip(CASES, pool.map(_inject, jobs), strict=True))
        share = -(-good // PROCESSES)
        failed = list(pool.map(_good_runs, [(part, share) for part in range(PROCESSES)]))
    return {
        "faults": faults,
        "false_fail": sum(sum(one.values()) for one in failed) / (share * PROCESSES),
        "failed_good_runs": {name: sum(one.get(name, 0) for one in failed) for one in failed for name in one},
        "repeats": repeats,
        "good_runs": share * PROCESSES,
        "poses": COUNT,
        "cannot_be_seen": list(UNSEEN),
        "seeds": [SEED],
    }


def table(result: Mapping[str, Any]) -> str:
    """Return the table as text."""
    head = f"{'fault':<16}{'detected':>10}{'right reason':>14}{'passed by RMS alone':>21}   speaks most"
    lines = [head]
    for name, row in result["faults"].items():
        lines.append(
            f"{name:<16}{row['detected']:>10.0%}{row['right_reason']:>14.0%}{row['rms_would_pass']:>21.0%}"
            f"   {', '.join(row['reasons'])}"
        )
    lines.append(
        f"good runs that failed: {result['false_fail']:.2%} of {result['good_runs']} "
        f"{result['failed_good_runs'] or ''}"
    )
    return "\n".join([*lines, *(f"cannot be seen: {words}" for words in result["cannot_be_seen"])])


def _inject(job: tuple[str, int]) -> dict[str, Any]:
    """Return what became of so many injections of a fault."""
    name, repeats = job
    cv2.setNumThreads(1)
    case = CASES[name]
    outcomes = [case.fault(seed) for seed in range(repeats)]
    reasons = [reasons_of(outcome) for outcome in outcomes]
    spoken = [reason for some in reasons for reason in some]
    return {
        "detected": float(np.mean([bool(some) for some in reasons])),
        "right_reason": float(np.mean([bool(some & case.reasons) for some in reasons])),
        "rms_would_pass": float(np.mean([rms_would_pass(outcome) for outcome in outcomes])),
        "reasons": sorted(set(spoken), key=lambda reason: -spoken.count(reason))[:3],
    }


def reasons_of(outcome: Outcome) -> set[str]:
    """Return what failed, by name of measurement or code of error; nothing where the run was not failed."""
    if isinstance(outcome, TooFewViews):
        refused = outcome.facts["reasons"]
        return {outcome.code, *(map(str, refused) if isinstance(refused, list) else ())}
    if isinstance(outcome, ServiceError):
        return {outcome.code}
    return {one.name for one in outcome.measurements if one.verdict is Verdict.FAIL}


def rms_would_pass(outcome: Outcome) -> bool:
    """Return whether a limit on the RMS alone would have let a run pass."""
    return not isinstance(outcome, ServiceError) and outcome.result.rms_px <= RMS_LIMIT_PX


def _good_runs(job: tuple[int, int]) -> dict[str, int]:
    """Return how often each measurement failed a good run, among so many, each of a camera of its own."""
    part, count = job
    cv2.setNumThreads(1)
    failed: dict[str, int] = {}
    for i in range(count):
        for reason in sorted(reasons_of(good_run((SEED, 7, part, i))))[:1]:
            failed[reason] = failed.get(reason, 0) + 1
    return failed
