"""The running estimate: near the result, given after most captures, None where views determine no camera."""

from dataclasses import replace

import pytest

from bench.running_estimate import DESIGNS, SEED, guide, revision_of, run, table
from bench.simulated_units import RATIONAL120, Design, draw_units
from service.core.vision.camera import parameter_names
from service.usecases.guide_estimate import estimate_from


@pytest.mark.parametrize("design", DESIGNS, ids=lambda design: design.name)
def test_the_estimate_of_all_views_is_the_result_and_its_sd_falls(design: Design) -> None:
    unit = next(draw_units(design, 1, (12, 12), SEED))
    guided = guide(unit, design)
    assert guided.difference_px < 0.01
    given = [estimate for estimate in guided.estimates if estimate is not None]
    assert len(given) >= 8
    assert given[-1].sd["fx"] < 0.7 * given[0].sd["fx"]
    assert list(given[-1].parameters) == list(parameter_names(design.intrinsics.lens))


def test_views_that_determine_no_camera_give_no_estimate() -> None:
    unit = next(draw_units(RATIONAL120, 1, (12, 12), SEED))
    revision = revision_of(unit.nominal, RATIONAL120)
    assert estimate_from(unit.views[:2], revision) is None
    same = [replace(unit.views[0], name=str(i)) for i in range(8)]
    assert estimate_from(same, revision) is None


def test_the_table_has_a_line_for_each_design() -> None:
    lines = table(run(quick=True)).splitlines()
    assert [line.split()[0] for line in lines] == ["design", *(design.name for design in DESIGNS)]
