import json

from bench.paper.novice_trials import ARMS, Effort, run_trials, true_camera


def test_one_person_before_a_lens_has_a_row_for_every_arm() -> None:
    effort = Effort(novices=1, views=4, poses=(3, 3, 3), candidates=300, processes=1, lenses=("lens1",))
    rows = run_trials(effort)
    by_arm = {row["arm"]: row for row in rows}
    assert set(by_arm) == set(ARMS)
    assert len(rows) == len(ARMS)
    assert by_arm["freehand"]["views"] == 4
    assert by_arm["guided"]["complete"]
    assert by_arm["guided"]["views"] == 3
    assert 0.005 < by_arm["guided"]["mre_px"] < 0.1
    assert abs(by_arm["guided"]["parameters"]["fx"] - true_camera("lens1").parameters["fx"]) < 2.0
    json.dumps(rows, allow_nan=False)
