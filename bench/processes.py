"""Many trials at once: in this process, or in two others. Not here: what a trial is."""

import multiprocessing
from collections.abc import Callable, Sequence
from typing import TypeVar

import cv2

MOST_PROCESSES = 2

Task = TypeVar("Task")
Made = TypeVar("Made")


def map_trials(act: Callable[[Task], Made], tasks: Sequence[Task], processes: int) -> list[Made]:
    """Return what an act makes of each task, in their order; OpenCV on one thread in each process.

    act: a function of a module, as it is sent to other processes. processes: 1 to stay in this one.
    """
    if min(processes, len(tasks)) <= 1:
        threads = cv2.getNumThreads()
        cv2.setNumThreads(1)
        try:
            return [act(task) for task in tasks]
        finally:
            cv2.setNumThreads(threads)
    # Spawned, so that no thread of this process is copied in the middle of something.
    context = multiprocessing.get_context("spawn")
    with context.Pool(min(processes, MOST_PROCESSES), cv2.setNumThreads, (1,)) as pool:
        return pool.map(act, tasks, chunksize=1)
