"""Vehicles: everything that is known under one serial."""

from typing import Annotated

from fastapi import APIRouter, Path

from service.api.auth import Viewer
from service.api.dependencies import ReadDb
from service.api.rest.results import Result
from service.api.rest.runs import RunSummary
from service.api.shapes import Answer
from service.usecases import vehicles

router = APIRouter(prefix="/vehicles", tags=["Vehicles"])


class Vehicle(Answer):
    """The runs of one serial, newest first, and the result of the latest finished one."""

    serial: str
    runs: list[RunSummary]
    latest_result: Result | None


@router.get("/{serial}", summary="Read a vehicle's history")
def read_vehicle(
    serial: Annotated[str, Path(max_length=64, description="The serial, exactly.")],
    caller: Viewer,
    db: ReadDb,
) -> Vehicle:
    """Read the calibration history of one serial. A serial that was never calibrated is not found (404)."""
    return Vehicle.model_validate(vehicles.read_vehicle(db, serial))
