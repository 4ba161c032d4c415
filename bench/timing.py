"""Times of single acts on two clocks: the wall's, and the thread's own, which others cannot make longer."""

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np

Given = TypeVar("Given")
Made = TypeVar("Made")


@dataclass(frozen=True)
class Timed:
    """Times of acts, ms, on both clocks."""

    wall_ms: list[float] = field(default_factory=list)
    cpu_ms: list[float] = field(default_factory=list)

    def act(self, act: Callable[[Given], Made], given: Given) -> Made:
        """Do something and note how long it took."""
        began, began_cpu = time.perf_counter(), time.thread_time()
        made = act(given)
        self.wall_ms.append(1e3 * (time.perf_counter() - began))
        self.cpu_ms.append(1e3 * (time.thread_time() - began_cpu))
        return made


def time_each(act: Callable[[Given], Made], given: Iterable[Given]) -> tuple[Timed, list[Made]]:
    """Return how long an act took for each of what is given, and what it made."""
    timed = Timed()
    return timed, [timed.act(act, item) for item in given]


def spread(timed: Timed) -> dict[str, float]:
    """Return the median, 95th and 99th percentile and maximum, ms, of the wall and of the CPU."""
    p50, p95, p99 = (float(value) for value in np.percentile(timed.wall_ms, (50, 95, 99)))
    cpu_p50, cpu_p95, cpu_p99 = (float(value) for value in np.percentile(timed.cpu_ms, (50, 95, 99)))
    return {
        "p50_ms": p50,
        "p95_ms": p95,
        "p99_ms": p99,
        "max_ms": max(timed.wall_ms),
        "cpu_p50_ms": cpu_p50,
        "cpu_p95_ms": cpu_p95,
        "cpu_p99_ms": cpu_p99,
        "cpu_max_ms": max(timed.cpu_ms),
    }
