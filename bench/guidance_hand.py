"""Does a hand that reads only hints reach every pose of both of the paper's lenses, and in what time?

Every pose from random starts, one in ten upside down: as planned, before a mirroring display, and with a
nominal focal length that is wrong by a fifth. Whole runs of several sizes and seeds, with lapses. And whole
runs in which one hint points the wrong way: they fail, or take far longer. A board that is rotated the wrong
way long enough comes to its pose from the other side, which is said where it happens.
Not here: how a trial is made and run (`guided_trials`).
"""

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from bench.geometric_kiosk import OPPOSITE, GuidedRun
from bench.guided_trials import (
    SEED,
    Station,
    Trial,
    attempt_all,
    duration,
    flipped_run,
    plan_station,
    random_starts,
    reaching,
    whole_run,
    with_nominal_off,
)
from service.core.guidance.hints import Hint
from service.demo.skus import PAPER_SKUS

MOST_TURNAROUNDS: Final = 3
MUCH_SLOWER: Final = 1.5  # times the run without a wrong hint
PLAIN: Final = "as planned"
# Error of the nominal focal length, and whether the display mirrors.
CASES: Final[Mapping[str, tuple[float, bool]]] = {
    PLAIN: (0.0, False),
    "mirrored": (0.0, True),
    "focal +20 %": (0.2, False),
    "focal +20 %, mirrored": (0.2, True),
    "focal -20 %": (-0.2, False),
    "focal -20 %, mirrored": (-0.2, True),
}


@dataclass(frozen=True)
class Effort:
    """How much is tried.

    starts: per pose as planned; case_starts: per pose in the other cases, of every case_every-th pose. seeds:
    of whole runs; count: the size of the main set; counts: others. flips: how many hints are turned round.
    """

    candidates: int = 3000
    starts: int = 200
    case_starts: int = 10
    case_every: int = 1
    seeds: int = 20
    count: int = 12
    counts: tuple[int, ...] = (8, 20)
    flips: int = len(OPPOSITE)


QUICK: Final = Effort(candidates=300, starts=1, case_starts=1, case_every=6, seeds=1, flips=1)


def run(quick: bool) -> dict[str, Any]:
    """Return the figures per lens, then what became of runs with one hint turned round."""
    return measure(QUICK if quick else Effort(), os.cpu_count() or 1)


def measure(effort: Effort, processes: int, skus: Sequence[Mapping[str, Any]] = PAPER_SKUS) -> dict[str, Any]:
    """Return the figures of an effort, shared among processes; hints are turned round before the last SKU."""
    stations = [plan_station(sku, effort.candidates, effort.count) for sku in skus]
    lenses = {station.code: _measure_lens(station, effort, processes) for station in stations}
    flips = _measure_flips(stations[-1], list(OPPOSITE)[: effort.flips], processes)
    completed = {hint: row["complete"] for hint, row in flips.items()}
    seeds = list(range(effort.seeds))
    return {**lenses, "completed_with_a_flipped_hint": completed, "flipped_hints": flips, "seeds": seeds}


def table(result: Mapping[str, Any]) -> str:
    """Return the figures as text."""
    codes = [sku["code"] for sku in PAPER_SKUS if sku["code"] in result]
    return "\n".join(
        [
            f"{'every pose':<32}{'reached':>12}{'median s':>10}{'slowest s':>11}{'turned round':>14}",
            *(_case_line(code, name, row) for code in codes for name, row in result[code]["cases"].items()),
            "turned round: most changes of direction of the first hint at any pose",
            f"{'whole runs':<32}{'complete':>12}{'median s':>10}{'slowest s':>11}{'turned round':>14}",
            *(
                _runs_line(code, name, row)
                for code in codes
                for name, row in result[code]["by_count"].items()
            ),
            "one hint turned round",
            *(_flip_line(hint, row) for hint, row in result["flipped_hints"].items()),
        ]
    )


def _case_line(code: str, name: str, row: Mapping[str, Any]) -> str:
    reached = f"{row['reached']}/{row['tried']}"
    slowest = f"{row['pose_median_s']:>10.1f}{row['slowest_s']:>11.1f}"
    return f"{code + ', ' + name:<32}{reached:>12}{slowest}{row['turnarounds_max']:>14}"


def _runs_line(code: str, name: str, row: Mapping[str, Any]) -> str:
    complete = f"{row['complete']}/{row['runs']}"
    times = f"{row['median_s']:>10.1f}{row['slowest_s']:>11.1f}"
    return f"{code + ', N = ' + name:<32}{complete:>12}{times}{row['turnarounds_max']:>14}"


def _flip_line(hint: str, row: Mapping[str, Any]) -> str:
    if not row["complete"]:
        return f"{hint:<32}fails: {row['captured']} poses in {row['run_s']:.0f} s"
    how = ", by going all the way round, upside down" if row["went_round"] else ""
    seen = "" if row["recognisable"] else ": NOT RECOGNISABLY WRONG"
    return f"{hint:<32}completes in {row['run_s']:.0f} s, {row['times_slower']:.1f} times as long{how}{seen}"


def _measure_lens(station: Station, effort: Effort, processes: int) -> dict[str, Any]:
    """Return the figures of one lens: the main ones first, then each case and each size of a run."""
    cases = {name: _measure_case(station, name, effort, processes) for name in CASES}
    plain = _measure_runs(station, effort, processes)
    mirrored = _measure_runs(station, effort, processes, mirrored=True)
    runs = {str(effort.count): plain, f"{effort.count}, mirrored": mirrored}
    sku = next(sku for sku in PAPER_SKUS if sku["code"] == station.code)
    for count in effort.counts:
        runs[str(count)] = _measure_runs(plan_station(sku, effort.candidates, count), effort, processes)
    return {
        **cases[PLAIN],
        "runs_complete": plain["complete"] + mirrored["complete"],
        "runs": plain["runs"] + mirrored["runs"],
        "run_median_s": plain["median_s"],
        "mirrored_median_s": mirrored["median_s"],
        "cases": cases,
        "by_count": runs,
    }


def _measure_case(station: Station, name: str, effort: Effort, processes: int) -> dict[str, Any]:
    """Return how the poses of a station are reached, one by one."""
    share, mirrored = CASES[name]
    held = with_nominal_off(station, share)
    plain = name == PLAIN
    starts = random_starts(held, effort.starts if plain else effort.case_starts, SEED + 1)
    poses = list(enumerate(held.poses))[:: 1 if plain else effort.case_every]
    tried = [(i, k) for i, _ in poses for k in range(len(starts))]
    trials = [reaching(held, held.poses[i], starts[k], k, mirrored=mirrored) for i, k in tried]
    done = attempt_all(trials, processes)
    times = _durations(done, trials)
    turns = [max(one.turnarounds) for one in done]
    slowest = int(np.argmax(times))
    return {
        "reached": sum(one.complete for one in done),
        "tried": len(done),
        "pose_median_s": float(np.median(times)),
        "slowest_s": times[slowest],
        "slowest": _named(tried[slowest]),
        "not_reached": [_named(which) for which, one in zip(tried, done, strict=True) if not one.complete],
        "turnarounds_max": max(turns),
        "turned_too_often": sum(turn > MOST_TURNAROUNDS for turn in turns),
    }


def _named(which: tuple[int, int]) -> dict[str, int]:
    """Return the names of a trial: its pose and its start, whose number is its seed."""
    return {"pose": which[0], "start": which[1]}


def _measure_runs(
    station: Station, effort: Effort, processes: int, *, mirrored: bool = False
) -> dict[str, Any]:
    """Return how whole runs go."""
    trials = [whole_run(station, seed, mirrored=mirrored) for seed in range(effort.seeds)]
    done = attempt_all(trials, processes)
    times = _durations(done, trials)
    return {
        "complete": sum(one.complete for one in done),
        "runs": len(done),
        "median_s": float(np.median(times)),
        "slowest_s": max(times),
        "turnarounds_max": max(turn for one in done for turn in one.turnarounds),
    }


def _measure_flips(station: Station, hints: Sequence[Hint], processes: int) -> dict[str, Any]:
    """Return what becomes of a run with each hint turned round, beside the same run without."""
    trials = [flipped_run(station, hint) for hint in (None, *hints)]
    right, *wrong = attempt_all(trials, processes)
    usual_s, usually_round = duration(right, trials[0]), _went_round(right)
    return {
        hint.value: _flip_row(one, duration(one, trial) / usual_s, usually_round)
        | {"run_s": duration(one, trial)}
        for hint, one, trial in zip(hints, wrong, trials[1:], strict=True)
    }


def _flip_row(done: GuidedRun, times_slower: float, usually_round: bool) -> dict[str, Any]:
    """Return what became of a run; it is recognised as wrong by failing, its time or the way round."""
    went_round = _went_round(done) and not usually_round
    return {
        "complete": done.complete,
        "captured": len(done.captures),
        "times_slower": times_slower,
        "went_round": went_round,
        "recognisable": not done.complete or went_round or times_slower >= MUCH_SLOWER,
    }


def _went_round(done: GuidedRun) -> bool:
    """Whether the board got upside down, as none does that begins upright and is told the right way."""
    return Hint.TURN_UPSIDE_DOWN in done.told


def _durations(done: Sequence[GuidedRun], trials: Sequence[Trial]) -> list[float]:
    return [duration(one, trial) for one, trial in zip(done, trials, strict=True)]
