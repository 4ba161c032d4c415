"""When the demo counts as passed."""

import numpy as np

from service.core.vision.camera import Intrinsics
from service.demo.report import is_proven

TRUTH = Intrinsics.from_vector("pinhole5", np.array([1e3, 1e3, 640.0, 400.0, 0, 0, 0, 0, 0]), (1280, 800))


def _result(verdict: str = "PASS", fx: float = 1000.1, sd: float = 0.1) -> dict[str, object]:
    values = TRUTH.parameters | {"fx": fx}
    return {"verdict": verdict, "intrinsics": values, "sd": dict.fromkeys(values, sd)}


def test_a_pass_near_the_truth_is_proven() -> None:
    assert is_proven(_result(), TRUTH)


def test_a_marginal_verdict_is_not() -> None:
    assert not is_proven(_result(verdict="MARGINAL"), TRUTH)


def test_an_error_over_half_a_pixel_is_not_however_large_the_sd() -> None:
    assert not is_proven(_result(fx=1000.6, sd=5.0), TRUTH)


def test_an_error_over_three_and_a_half_sd_is_not_however_small() -> None:
    assert not is_proven(_result(fx=1000.1, sd=0.02), TRUTH)
