import numpy as np
import pytest

from bench.detection import LENS1
from bench.guidance import LENS2, Effort, judge_found, run, table
from bench.timing import Timed, spread, time_each
from service.core.vision.camera import Intrinsics
from service.core.vision.live_detection import LiveDetection

PROMISED = ("max_ms", "decode_ms", "opencv_p95_ms", "speedup_p95", "detection_rate", "opencv_detection_rate")


# A quarter of the pixels: the same is measured, only faster.
SMALL = Intrinsics.from_parameters(
    "pinhole5",
    {"fx": 675.0, "fy": 676.0, "cx": 328.8, "cy": 191.9, "k1": -0.3774, "k2": 0.2425},
    (640, 400),
)


def _found(points: np.ndarray | None) -> LiveDetection:
    return LiveDetection("absent" if points is None else "present", points, 54, None, 100.0)


def test_a_board_counts_as_found_only_in_the_right_order() -> None:
    truth = np.arange(108.0).reshape(54, 2) * 3.0
    row = judge_found([_found(truth + 0.3), _found(truth[::-1]), _found(None), _found(truth)], [truth] * 4)
    assert (row["rate"], row["wrong"]) == (0.5, 0.25)
    assert row["rms_px"] == pytest.approx(0.3)


def test_nothing_found_has_no_error() -> None:
    assert np.isnan(judge_found([_found(None)], [np.zeros((54, 2))])["rms_px"])


def test_a_spread_names_the_percentiles_and_the_worst() -> None:
    row = spread(Timed(list(map(float, range(101))), [float(i) / 2 for i in range(101)]))
    assert row == {
        "p50_ms": 50.0,
        "p95_ms": 95.0,
        "p99_ms": 99.0,
        "max_ms": 100.0,
        "cpu_p50_ms": 25.0,
        "cpu_p95_ms": 47.5,
        "cpu_p99_ms": 49.5,
        "cpu_max_ms": 50.0,
    }


def test_each_act_is_timed_by_itself() -> None:
    timed, made = time_each(lambda value: value + 1, [1, 2, 3])
    assert made == [2, 3, 4]
    assert len(timed.wall_ms) == len(timed.cpu_ms) == 3
    assert min(timed.wall_ms) > 0


def test_the_cameras_are_of_the_sizes_that_the_design_names() -> None:
    assert (LENS1.image_size, LENS2.image_size) == ((1280, 800), (1920, 1208))


def test_a_run_has_the_keys_of_the_design_for_both_cameras(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("bench.guidance.LENS2", SMALL)
    monkeypatch.setattr("bench.guidance.QUICK", Effort(4, 3, 1, 5, 1))
    result = run(quick=True)
    for size in ("1280x800", "640x400"):
        row = result[size]
        assert all(key in row for key in PROMISED)
        assert row["tracking"]["p95_ms"] == row["first"]["p95_ms"]  # there is no tracking
        assert row["absent"]["p95_ms"] > 0
        assert row["detection_rate"] == 1.0
        assert row["found"]["wrong"] == row["called_whole_though_cut"] == row["false_alarms"] == 0.0
        assert (row["random_poses"]["rate"], row["random_poses"]["wrong"]) == (1.0, 0)
        assert row["empty_frames"]["false"] == row["real_negatives"]["false"] == 0
        assert all(one["right"] == 1.0 for one in row["conditions"].values())
        assert row["mixed"]["ours"]["rate"] >= row["mixed"]["best_rate_of_opencv"]
        assert row["corner_error"]["rms_px"] < 0.03
        assert size in table(result)
    assert result["seeds"]
