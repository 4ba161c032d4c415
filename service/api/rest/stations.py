"""Stations: the calibration places of a line, and the board that stands at each."""

from datetime import datetime
from typing import Annotated, Self
from uuid import UUID

from fastapi import APIRouter
from pydantic import ConfigDict, Field, model_validator

from service.api.auth import Engineer, Viewer
from service.api.dependencies import Db, Of, PageOf, ReadDb
from service.api.shapes import Answer, Page, Request, ShownSource
from service.storage.words import FrameOrigin, Language
from service.usecases import stations
from service.usecases.fixture_document import FixtureDocument
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


Speaks = Annotated[
    Language | None,
    Field(strict=False, description="In which language the kiosk starts; null: in its browser's."),
]


Fixture = Annotated[
    FixtureDocument | None,
    Field(description="Where a target stands in the vehicle frame, for extrinsics; null: nowhere."),
]


class NewStation(Request):
    """A station to register."""

    code: Code
    name: Label
    target_id: UUID | None = Field(default=None, strict=False, description="Board that stands there.")
    source: Source = FrameOrigin.BROWSER.value
    language: Speaks = None
    fixture: Fixture = None

    model_config = ConfigDict(
        json_schema_extra={"examples": [{"code": "line1-cal2", "name": "Line 1, calibration 2"}]}
    )


class StationChange(Request):
    """What a station gets; what is left out stays."""

    source: Source | None = None
    language: Speaks = None
    fixture: Fixture = None

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [{"source": "rtsp://user:password@camera-17/stream1"}, {"language": "zh"}]
        }
    )

    @model_validator(mode="after")
    def _says_something(self) -> Self:
        if self.source is None and not self.model_fields_set & {"language", "fixture"}:
            raise ValueError("Give the station's `source`, its `language` or its `fixture`.")
        return self


class Station(Answer):
    """A station."""

    id: UUID
    code: str
    name: str
    target_id: UUID | None
    source: ShownSource
    language: Language | None
    fixture: FixtureDocument | None
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
        language=body.language,
        fixture=body.fixture,
        files=of.has_frames_dir,
        who=caller.name,
        now=of.clock.now(),
    )
    return Station.model_validate(row)


@router.patch("/{code}", summary="Change a station's source, language or fixture")
def change_station(code: Code, body: StationChange, caller: Engineer, db: Db, of: Of) -> Station:
    """Give a station another source or language, from the next time that its kiosk connects, or fixture.

    A fixture holds for the pictures that are taken from now on; results keep the one they were made with.
    """
    row = stations.change_station(
        db,
        code,
        source=body.source,
        language=body.language if "language" in body.model_fields_set else "keep",
        fixture=body.fixture if "fixture" in body.model_fields_set else "keep",
        files=of.has_frames_dir,
        who=caller.name,
        now=of.clock.now(),
    )
    return Station.model_validate(row)


@router.get("", summary="List the stations")
def list_stations(caller: Viewer, db: ReadDb, page: PageOf) -> Page[Station]:
    """List the stations, newest first."""
    return Page[Station].model_validate(stations.list_stations(db, page))
