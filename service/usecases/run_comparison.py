"""Two results side by side: parameters in standard deviations, and how far their mappings are apart.

The zones are those of the first run's SKU. Not here: gates and conditions, which each run tells itself.
"""

from dataclasses import dataclass
from uuid import UUID

import numpy as np
from sqlalchemy.orm import Session

from service.core.quality.coverage import zone_grid
from service.core.vision.camera import parameter_names
from service.core.vision.camera_comparison import (
    CalibratedCamera,
    compare_mappings,
    compare_parameters,
    expected_difference,
)
from service.core.vision.image_grid import ImageGrid
from service.core.vision.transforms import Array
from service.core.vision.uncertainty import Region
from service.usecases.image_zones import Rows, rows_of
from service.usecases.observation import number_or_null
from service.usecases.stored_camera import load_camera


@dataclass(frozen=True)
class ComparedParameter:
    """A parameter of both; `sd`: of the difference; `apart_sd`: the difference in it, None where fixed."""

    name: str
    a: float
    b: float
    difference: float
    sd: float | None
    apart_sd: float | None


@dataclass(frozen=True)
class ComparedMaps:
    """Where b sees what a sees, minus a's pixel, by cell of the image; None where a lens does not reach."""

    offset_u_px: Rows
    offset_v_px: Rows
    distance_px: Rows
    distance_mdeg: Rows


@dataclass(frozen=True)
class ComparedZone:
    """A part of the image: rms and largest distance in it, and the rms that noise alone makes."""

    left_px: float
    top_px: float
    right_px: float
    bottom_px: float
    mean_px: float | None
    worst_px: float | None
    mean_mdeg: float | None
    worst_mdeg: float | None
    expected_px: float | None


@dataclass(frozen=True)
class RunComparison:
    """Run b against run a. Without parameters where the lens models differ."""

    a: UUID
    b: UUID
    lens_a: str
    lens_b: str
    image_size: tuple[int, int]
    parameters: list[ComparedParameter]
    distance_sd: float | None
    maps: ComparedMaps
    working_zone: ComparedZone
    valid_region: ComparedZone


def compare_runs(session: Session, a_id: UUID, b_id: UUID) -> RunComparison:
    """Return run b against run a.

    Raises NotFound for an unknown run and for one without a result, WrongImageSize for two image sizes,
    IntrinsicsInvalid where one lens reaches nothing of what the other sees.
    """
    stored = load_camera(session, a_id)
    a, b = stored.camera, load_camera(session, b_id).camera
    held = zone_grid(stored.working_zone)
    parameters, distance_sd = _parameters(a, b)
    return RunComparison(
        a=a_id,
        b=b_id,
        lens_a=a.intrinsics.lens,
        lens_b=b.intrinsics.lens,
        image_size=a.intrinsics.image_size,
        maps=_maps(a, b, held),
        working_zone=_zone(a, b, stored.working_zone, held),
        valid_region=_zone(a, b, stored.valid_region, held),
        parameters=parameters,
        distance_sd=distance_sd,
    )


def _parameters(a: CalibratedCamera, b: CalibratedCamera) -> tuple[list[ComparedParameter], float | None]:
    """Return each parameter and how far all are apart, in sd; nothing where the lens models differ."""
    if a.intrinsics.lens != b.intrinsics.lens:
        return [], None
    found = compare_parameters(a, b)
    names = parameter_names(a.intrinsics.lens)
    values = zip(names, a.intrinsics.vector, b.intrinsics.vector, found.difference, found.sd, strict=True)
    return [_parameter(name, *map(float, row)) for name, *row in values], number_or_null(found.distance_sd)


def _parameter(name: str, a: float, b: float, difference: float, sd: float) -> ComparedParameter:
    apart = difference / sd if sd > 0 else None
    return ComparedParameter(name, a, b, difference, number_or_null(sd), apart)


def _maps(a: CalibratedCamera, b: CalibratedCamera, held: Array) -> ComparedMaps:
    grid = ImageGrid(a.intrinsics.image_size)
    found = compare_mappings(a.intrinsics, b.intrinsics, grid.centres, held)
    shape = (grid.rows, grid.columns)
    u, v = found.offsets_px.T
    return ComparedMaps(
        offset_u_px=rows_of(u.reshape(shape)),
        offset_v_px=rows_of(v.reshape(shape)),
        distance_px=rows_of(np.hypot(u, v).reshape(shape)),
        distance_mdeg=rows_of(found.angles_mdeg.reshape(shape)),
    )


def _zone(a: CalibratedCamera, b: CalibratedCamera, zone: Region, held: Array) -> ComparedZone:
    pixels = zone_grid(zone)
    found = compare_mappings(a.intrinsics, b.intrinsics, pixels, held)
    distances, angles = np.linalg.norm(found.offsets_px, axis=-1), found.angles_mdeg
    return ComparedZone(
        left_px=zone.left_px,
        top_px=zone.top_px,
        right_px=zone.right_px,
        bottom_px=zone.bottom_px,
        mean_px=number_or_null(_rms(distances)),
        worst_px=number_or_null(float(distances.max())),
        mean_mdeg=number_or_null(_rms(angles)),
        worst_mdeg=number_or_null(float(angles.max())),
        expected_px=number_or_null(expected_difference(a, b, pixels)),
    )


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))
