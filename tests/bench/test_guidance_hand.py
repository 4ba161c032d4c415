import json

from bench.geometric_kiosk import OPPOSITE
from bench.guidance_hand import CASES, Effort, measure, table
from bench.guided_trials import attempt, plan_station, random_starts, reaching, with_nominal_off
from service.demo.skus import PAPER_SKUS

MAIN = ("reached", "tried", "pose_median_s", "runs_complete", "runs", "run_median_s", "mirrored_median_s")


def test_a_hand_reaches_what_it_is_guided_to_and_a_hint_turned_round_shows() -> None:
    small = Effort(
        candidates=300, starts=1, case_starts=1, case_every=3, seeds=1, count=3, counts=(), flips=1
    )
    result = measure(small, processes=1, skus=PAPER_SKUS[1:])
    row = result["lens2"]
    assert all(key in row for key in MAIN)
    assert set(row["cases"]) == set(CASES)
    assert set(row["by_count"]) == {"3", "3, mirrored"}
    for case in row["cases"].values():
        assert case["reached"] == case["tried"] > 0
        assert not case["not_reached"]
        assert case["slowest_s"] >= case["pose_median_s"] > 0
    assert row["runs_complete"] == row["runs"] == 2
    first = next(iter(OPPOSITE)).value
    assert result["completed_with_a_flipped_hint"] == {first: result["flipped_hints"][first]["complete"]}
    assert result["flipped_hints"][first]["recognisable"]
    json.dumps(result, allow_nan=False)
    assert first in table(result)


def test_a_wrong_nominal_is_wrong_by_a_share_of_the_truth_and_only_guidance_goes_by_it() -> None:
    station = plan_station(PAPER_SKUS[0], 300, 3)
    off = with_nominal_off(station, 0.2)
    assert off.settings is station.settings
    assert off.settings.intrinsics.vector[0] == 1.2 * off.camera.vector[0]
    start = random_starts(off, 1, 3)[0]
    done = attempt(reaching(off, off.poses[1], start, 0))
    assert done.complete
    depths = [(pose.rotation @ station.settings.target.centre + pose.tvec)[2] for pose in done.captures]
    nominal = (off.poses[1].rotation @ station.settings.target.centre + off.poses[1].tvec)[2]
    assert abs(depths[0] * 1.2 / nominal - 1.0) < 0.06
