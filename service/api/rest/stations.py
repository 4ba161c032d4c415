"""Stations: the calibration places of a line, and the board that stands at each."""

from datetime import datetime
from typing import Annotated
from uuid import UUID

from fastapi import APIRouter
from pydantic import ConfigDict, Field

from service.api.auth import Engineer, Viewer
from service.api.dependencies import Db, Of, PageOf, ReadDb
from service.api.shapes import Answer, Page, Request, ShownSource
from service.storage.words import FrameOrigin
from service.usecases import stations
from service.usecases.frame_address import MOST_CHARACTERS
from service.usecases.text import Code, Label

router = APIRouter(prefix="/stations", tags=["Stations"])


Source = Annotated[
    str,
    Field(
        max_length=MOST_CHARACTERS,
        description="Where live frames come from: the kiosk's own camera (`browser`), the simulator "
        "(`virtual`; `virtual:mouse`, whose board is moved at the kiosk), or a camera that the service "
        "reads: `rtsp://HOST/…`, `http(s)://HOST/…` (MJPEG), "
        "`v4l2:/dev/videoN`, `v4l2:SERIAL`, or `file:NAME` to replay a folder or video.",
    ),
]


class NewStation(Request):
    """A station to register."""

    code: Code
    name: Label
    target_id: UUID | None = Field(default=None, strict=False, description="Board that stands there.")
    source: Source = FrameOrigin.BROWSER.value

    model_config = ConfigDict(
        json_schema_extra={"examples": [{"code": "line1-cal2", "name": "Line 1, calibration 2"}]}
    )


class NewSource(Request):
    """Another source for a station."""

    source: Source

    model_config = ConfigDict(
        json_schema_extra={"examples": [{"source": "rtsp://user:password@camera-17/stream1"}]}
    )


class Station(Answer):
    """A station."""

    id: UUID
    code: str
    name: str
    target_id: UUID | None
    source: ShownSource
    created_at: datetime


@router.post("", status_code=201, summary="Register a station")
def create_station(body: NewStation, caller: Engineer, db: Db, of: Of) -> Station:
    """Register a calibration place. Runs name it by its code."""
    row = stations.create_station(
        db,
        body.code,
        body.name,
        body.target_id,
        source=body.source,
        files=of.has_frames_dir,
        who=caller.name,
        now=of.clock.now(),
    )
    return Station.model_validate(row)


@router.patch("/{code}", summary="Change where a station's frames come from")
def change_source(code: Code, body: NewSource, caller: Engineer, db: Db, of: Of) -> Station:
    """Give a station another source. It holds from the next time that the station's kiosk connects."""
    row = stations.change_source(
        db, code, body.source, files=of.has_frames_dir, who=caller.name, now=of.clock.now()
    )
    return Station.model_validate(row)


@router.get("", summary="List the stations")
def list_stations(caller: Viewer, db: ReadDb, page: PageOf) -> Page[Station]:
    """List the stations, newest first."""
    return Page[Station].model_validate(stations.list_stations(db, page))
