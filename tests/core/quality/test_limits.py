"""Limits: defaults by image size, and overrides that are checked."""

import math
from typing import Any

import pytest

from service.core.errors import LimitsInvalid
from service.core.quality.limits import Limits, default_limits, limits_for


def test_both_classes_have_the_limits_of_the_gate_table() -> None:
    small, large = default_limits((1280, 800)), default_limits((1920, 1208))
    assert (small.centre_sd_px, small.zone_mapping_px, small.valid_mapping_px) == (0.7, 0.30, 1.0)
    assert (large.centre_sd_px, large.zone_mapping_px, large.valid_mapping_px) == (0.8, 0.40, 1.3)
    assert small.rms_px == large.rms_px == 0.35


def test_an_override_replaces_one_limit_and_keeps_those_of_the_image_size() -> None:
    limits = limits_for((1920, 1208), {"rms_px": 0.2, "contrast": None, "marginal": {"rms_px": 0.5}})
    assert (limits.rms_px, limits.contrast, limits.centre_sd_px) == (0.2, 40.0, 0.8)
    assert (limits.share("rms_px"), limits.share("worst_view_ratio")) == (0.5, 0.8)
    assert limits.share("coverage") == Limits().share("coverage")


@pytest.mark.parametrize(
    ("overrides", "said"),
    [
        ({"rms": 0.2}, "No such limit: rms"),
        ({"rms_px": -1}, "rms_px"),
        ({"rms_px": math.nan}, "rms_px"),
        ({"rms_px": "0.2"}, "rms_px"),
        ({"rms_px": True}, "rms_px"),
        ({"marginal": {"rms_px": 1.5}}, "marginal.rms_px"),
        ({"marginal": {"rms": 0.5}}, "No such limit: rms"),
        ({"marginal": 0.5}, "marginal"),
    ],
)
def test_what_is_no_limit_is_refused_by_name(overrides: dict[str, Any], said: str) -> None:
    with pytest.raises(LimitsInvalid, match=said):
        limits_for((1280, 800), overrides)
