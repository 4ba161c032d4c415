"""The running estimate of a guided run: how long it takes after each capture, and whether it is the result's.

Cameras of four designs, their corners one view more each time, from three views to twenty; the nominal is off
by five per cent. `largest_difference_px` is between the estimate of all views and the solve from two starts,
over the corners. One thread. Not here: the database's part, which reads a few kilobytes.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from bench.processes import map_trials
from bench.simulated_units import BOARD, FISHEYE120, HFOV80, HFOV120, RATIONAL120, Design, Unit, draw_units
from bench.timing import Timed, spread
from service.core.vision.calibration import calibrate_intrinsics
from service.core.vision.camera import Intrinsics
from service.core.vision.uncertainty import mapping_difference
from service.usecases.guide_estimate import VIEWS_NEEDED, Estimate, estimate_from
from service.usecases.sku_document import Revision, SkuDocument

SEED = 9
VIEWS = 20
DESIGNS = (HFOV80, HFOV120, RATIONAL120, FISHEYE120)


@dataclass(frozen=True)
class Guided:
    """The estimates of a unit's views, from VIEWS_NEEDED to all; None where they did not determine it."""

    timed: Timed
    estimates: list[Estimate | None]
    difference_px: float


def run(quick: bool) -> dict[str, Any]:
    """Return the times per design, and the largest of all."""
    units = 2 if quick else 20
    rows = map_trials(partial(_measure, units=units), DESIGNS, processes=1)
    designs = {design.name: row for design, row in zip(DESIGNS, rows, strict=True)}
    return {
        "p95_ms": max(row["p95_ms"] for row in designs.values()),
        "max_ms": max(row["max_ms"] for row in designs.values()),
        **designs,
        "views": VIEWS,
        "seeds": [SEED],
    }


def table(result: Mapping[str, Any]) -> str:
    """Return the times as text."""
    head = f"{'design':<16}{'p50 ms':>8}{'p95 ms':>8}{'max ms':>8}{'CPU p95 ms':>12}{'given':>8}"
    lines = [f"{head}{'off the result px':>19}"]
    for design in DESIGNS:
        row = result[design.name]
        lines.append(
            f"{design.name:<16}{row['p50_ms']:>8.1f}{row['p95_ms']:>8.1f}{row['max_ms']:>8.1f}"
            f"{row['cpu_p95_ms']:>12.1f}{row['given']:>8.2f}{row['largest_difference_px']:>19.2e}"
        )
    return "\n".join(lines)


def _measure(design: Design, units: int) -> dict[str, float]:
    """Return the times of one design; `given`: the share of captures after which there was an estimate."""
    guided = [guide(unit, design) for unit in draw_units(design, units, (VIEWS, VIEWS), SEED)]
    whole = Timed(
        [ms for one in guided for ms in one.timed.wall_ms], [ms for one in guided for ms in one.timed.cpu_ms]
    )
    given = [estimate is not None for one in guided for estimate in one.estimates]
    return {
        **spread(whole),
        "given": float(np.mean(given)),
        "largest_difference_px": max(one.difference_px for one in guided),
    }


def guide(unit: Unit, design: Design) -> Guided:
    """Return the estimates of a unit's views as they come, and how long each took."""
    revision, timed = revision_of(unit.nominal, design), Timed()
    counts = range(VIEWS_NEEDED, len(unit.views) + 1)
    estimates = [
        timed.act(lambda views: estimate_from(views, revision), unit.views[:count]) for count in counts
    ]
    return Guided(timed, estimates, _off_the_result(unit, design, estimates[-1]))


def _off_the_result(unit: Unit, design: Design, estimate: Estimate | None) -> float:
    if estimate is None:
        return float("inf")
    size, lens = unit.true.image_size, unit.true.lens
    result = calibrate_intrinsics(unit.views, size, lens, nominal=unit.nominal, fixed=design.fixed)
    found = Intrinsics.from_parameters(lens, estimate.parameters, size)
    corners = np.concatenate([view.image_points for view in unit.views])
    return float(np.nanmax(mapping_difference(result.intrinsics, found, corners)))


def revision_of(nominal: Intrinsics, design: Design) -> Revision:
    """Return a SKU's revision for a design with a data sheet."""
    document = {
        "code": design.name.replace("_", "-"),
        "name": design.name,
        "lens": nominal.lens,
        "image_size": nominal.image_size,
        "nominal": nominal.parameters,
        "fixed": design.fixed,
        "target": BOARD.spec,
        "pose_count": VIEWS,
    }
    return SkuDocument.model_validate(document).to_revision()
