"""Vehicles: everything that is known under one serial."""

from datetime import datetime
from typing import Annotated
from uuid import UUID

from fastapi import APIRouter, Path
from pydantic import Field

from service.api.auth import Viewer
from service.api.dependencies import ReadDb
from service.api.rest.results import Result
from service.api.rest.runs import RunSummary
from service.api.shapes import Answer
from service.core.quality.gates import Verdict
from service.core.run import Purpose
from service.usecases import vehicle_history, vehicles

router = APIRouter(prefix="/vehicles", tags=["Vehicles"])


class Vehicle(Answer):
    """The runs of one serial, newest first, and the result of the latest finished one."""

    serial: str
    runs: list[RunSummary]
    latest_result: Result | None


class PastCalibration(Answer):
    """What one finished run of the serial came to."""

    run_id: UUID
    created_at: datetime
    sku: str
    purpose: Purpose
    verdict: Verdict
    lens: str
    rms_px: float
    intrinsics: dict[str, float]
    sd: dict[str, float | None]


class VehicleHistory(Answer):
    """The calibrations of a serial over time."""

    serial: str
    calibrations: list[PastCalibration] = Field(description="Oldest first; of the latest 200.")


Serial = Annotated[str, Path(max_length=64, description="The serial, exactly.")]


@router.get("/{serial}", summary="Read a vehicle's history")
def read_vehicle(serial: Serial, caller: Viewer, db: ReadDb) -> Vehicle:
    """Read the calibration history of one serial. A serial that was never calibrated is not found (404)."""
    return Vehicle.model_validate(vehicles.read_vehicle(db, serial))


@router.get("/{serial}/calibrations", summary="Read how a vehicle's camera came out over time")
def read_history(serial: Serial, caller: Viewer, db: ReadDb) -> VehicleHistory:
    """Read intrinsics, their standard deviations, rms and verdict of each finished run of a serial."""
    return VehicleHistory.model_validate(vehicle_history.read_history(db, serial))
