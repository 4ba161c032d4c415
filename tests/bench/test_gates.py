import pytest

from bench.gate_faults import CASES, detections, judge_views
from bench.gates import reasons_of, rms_would_pass
from service.core.quality.gates import Verdict
from service.core.quality.verdict import Judged

# Those that need no picture of their own; the bench injects all of them.
QUICK = (
    "repeated_view",
    "two_cameras",
    "decentred",
    "anisotropic",
    "moved_corner",
    "curled_board",
    "swapped_sku",
    "swapped_serial",
    "few_tilts",
    "wrong_model",
)


def test_a_good_run_passes_every_gate() -> None:
    good = judge_views(detections(0))
    assert isinstance(good, Judged)
    assert [one.name for one in good.measurements if one.verdict is not Verdict.PASS] == []


@pytest.mark.parametrize("name", QUICK)
def test_each_fault_fails_for_its_own_reason(name: str) -> None:
    assert reasons_of(CASES[name].fault(0)) & CASES[name].reasons


def test_the_rms_alone_would_pass_most_of_them() -> None:
    passed = [name for name in QUICK if rms_would_pass(CASES[name].fault(0))]
    assert {"repeated_view", "two_cameras", "decentred", "swapped_serial"} <= set(passed)


def test_every_case_of_the_fault_table_is_named_as_agreed() -> None:
    drawn = {"wrong_board", "mirrored_view", "mirrored_all", "mirrored_plain", "blur", "motion_blur"}
    assert {"saturated"} | drawn | set(QUICK) == set(CASES)


def test_a_run_with_a_mirrored_coded_board_is_refused_for_that() -> None:
    case = CASES["mirrored_all"]
    assert reasons_of(case.fault(0)) & case.reasons
