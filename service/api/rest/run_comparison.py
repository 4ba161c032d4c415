"""Two runs compared: their parameters, and how far their mappings are apart over the image."""

from uuid import UUID

from fastapi import APIRouter
from pydantic import Field

from service.api.auth import Viewer
from service.api.dependencies import ReadDb
from service.api.rest.results import Rectangle, Values
from service.api.shapes import Answer, Id
from service.usecases import run_comparison

router = APIRouter(prefix="/runs", tags=["Results"])


class ComparedParameter(Answer):
    """A parameter of both runs."""

    name: str
    a: float
    b: float
    difference: float = Field(description="b minus a.")
    sd: float | None = Field(description="Standard deviation of the difference; 0 where both are fixed.")
    apart_sd: float | None = Field(description="The difference in that sd; null where both are fixed.")


class ComparedMaps(Answer):
    """The image of run a cut into cells, values row by row from the top left; null beyond a lens's reach."""

    offset_u_px: Values = Field(
        description="Where b sees what a sees at the cell's centre, minus that pixel."
    )
    offset_v_px: Values
    distance_px: Values
    distance_mdeg: Values = Field(description="The distance as an angle of the ray, thousandths of a degree.")


class ComparedZone(Rectangle):
    """How far the mappings are apart in a part of the image; null where a lens does not reach all of it."""

    mean_px: float | None = Field(description="Root mean square of the distances.")
    worst_px: float | None
    mean_mdeg: float | None
    worst_mdeg: float | None
    expected_px: float | None = Field(
        description="The root mean square that corner noise alone leads to between two such runs."
    )


class RunComparison(Answer):
    """Run b against run a; the zones are those of a's SKU revision, the best rotation is taken out."""

    a: UUID
    b: UUID
    lens_a: str
    lens_b: str
    image_size: tuple[int, int]
    parameters: list[ComparedParameter] = Field(description="Empty where the lens models differ.")
    distance_sd: float | None = Field(
        description="How far all free parameters are apart, in sd and per parameter: near 1 for noise alone; "
        "null where the lens models differ."
    )
    maps: ComparedMaps
    working_zone: ComparedZone
    valid_region: ComparedZone


@router.get("/{run_id}/comparison/{other_id}", summary="Compare two runs")
def compare_runs(run_id: Id, other_id: Id, caller: Viewer, db: ReadDb) -> RunComparison:
    """Compare another run (b) with a run (a): both must be finished and of one image size.

    Runs of different lens models are compared by what their mappings do, not by their parameters.
    """
    return RunComparison.model_validate(run_comparison.compare_runs(db, run_id, other_id))
