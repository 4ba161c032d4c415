import math
import pickle

import pytest

from bench import guided
from bench.paper import novice_trials
from bench.processes import map_trials


@pytest.mark.parametrize("processes", [1, 2])
def test_results_come_in_the_order_of_their_tasks(processes: int) -> None:
    assert map_trials(math.factorial, [5, 0, 3], processes) == [120, 1, 6]


def test_tasks_can_be_sent_to_other_processes() -> None:
    sent = guided.make_tasks(guided.Effort(seeds=2, poses=4, candidates=300, lenses=("lens1",)))
    assert [task.seed for task in pickle.loads(pickle.dumps(sent))] == [0, 1]  # noqa: S301 - our own
    people = novice_trials.make_tasks(
        novice_trials.Effort(novices=2, poses=(4,), candidates=300, lenses=("lens1",))
    )
    assert [task.novice for task in pickle.loads(pickle.dumps(people))] == [0, 1]  # noqa: S301 - our own
