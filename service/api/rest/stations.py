"""Stations: the calibration places of a line, and the board that stands at each."""

from datetime import datetime
from uuid import UUID

from fastapi import APIRouter
from pydantic import ConfigDict, Field

from service.api.auth import Engineer, Viewer
from service.api.dependencies import Db, Now, PageOf, ReadDb
from service.api.shapes import Answer, Page, Request
from service.storage.words import FrameOrigin
from service.usecases import stations
from service.usecases.text import Code, Label

router = APIRouter(prefix="/stations", tags=["Stations"])


class NewStation(Request):
    """A station to register."""

    code: Code
    name: Label
    target_id: UUID | None = Field(default=None, strict=False, description="Board that stands there.")
    source: FrameOrigin = Field(
        default=FrameOrigin.BROWSER,
        strict=False,
        description="Where live frames come from: the kiosk's own camera, or the simulator (`virtual`).",
    )

    model_config = ConfigDict(
        json_schema_extra={"examples": [{"code": "line1-cal2", "name": "Line 1, calibration 2"}]}
    )


class Station(Answer):
    """A station."""

    id: UUID
    code: str
    name: str
    target_id: UUID | None
    source: FrameOrigin
    created_at: datetime


@router.post("", status_code=201, summary="Register a station")
def create_station(body: NewStation, caller: Engineer, db: Db, now: Now) -> Station:
    """Register a calibration place. Runs name it by its code."""
    return Station.model_validate(
        stations.create_station(
            db, body.code, body.name, body.target_id, source=body.source, who=caller.name, now=now
        )
    )


@router.get("", summary="List the stations")
def list_stations(caller: Viewer, db: ReadDb, page: PageOf) -> Page[Station]:
    """List the stations, newest first."""
    return Page[Station].model_validate(stations.list_stations(db, page))
