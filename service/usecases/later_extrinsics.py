"""Extrinsics after the run: where a camera is in the vehicle, from pictures of a fixed target alone.

The intrinsics are those of a run's accepted result, and their stored covariance counts. What is found stands
beside that result, which stays as it is. Not here: extrinsics within a run (`finish`).
"""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from datetime import datetime
from hashlib import sha256
from typing import Any
from uuid import UUID

from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.errors import DuplicateImage
from service.core.quality.evidence import FixedTargetViews
from service.core.quality.gates import Measurement
from service.core.quality.place import JudgedPlace, judge_place
from service.core.run import Purpose
from service.core.vision.fixture_problems import FixtureMissing, PictureOfAnother
from service.core.vision.target import parse_target
from service.ports import BlobStore
from service.storage import outbox
from service.storage.columns import new_id
from service.storage.database import Database
from service.storage.models import CaptureRow, RunRow, StationRow
from service.storage.placed import LaterExtrinsicsRow, LaterPictureRow
from service.usecases.accepted_camera import StoredCamera, check_accepted, load_camera
from service.usecases.audit import record
from service.usecases.calibration_input import detection_of
from service.usecases.canonical_json import canonical_json
from service.usecases.captures import picture_columns
from service.usecases.extrinsics_document import extrinsics_document
from service.usecases.fixture_document import FixtureDocument
from service.usecases.images import image_sha256
from service.usecases.later_certificate import issue_later
from service.usecases.later_extrinsics_views import LaterExtrinsicsView, get_later, pictures_of, view_later
from service.usecases.observation import Observation, Picture, Prescription, observe
from service.usecases.result_document import versions
from service.usecases.runs import get_run
from service.usecases.signing import KeyRing
from service.usecases.stations import get_station

JsonObject = dict[str, Any]
_Seen = tuple[Picture, Observation]
MOST_PICTURES = 8  # of one request


@dataclass(frozen=True)
class Wanted:
    """Which run's camera is to be placed, by pictures of the fixed target of which station."""

    run_id: UUID
    station: str
    pictures: tuple[Picture, ...]


@dataclass(frozen=True)
class Placed:
    """What was found, and whether this request found it."""

    view: LaterExtrinsicsView
    is_new: bool


@dataclass(frozen=True)
class _Request:
    """What is asked: the camera of a run, at a station with a fixture, and the hashes of the pictures."""

    camera: StoredCamera
    station: StationRow
    fixture: FixtureDocument
    hashes: tuple[str, ...]

    @property
    def sha256(self) -> str:
        """What a repeated request has in common."""
        parts = [self.station.code, self.fixture.to_json(), sorted(self.hashes)]
        return sha256(canonical_json(parts)).hexdigest()


def measure_later(
    database: Database, blobs: BlobStore, keys: KeyRing, wanted: Wanted, *, who: str, now: datetime
) -> Placed:
    """Find, judge, store and certify where a run's camera is; asked twice, it is answered again.

    Raises NotFound, ResultNotUsable, FixtureMissing, PictureOfAnother, DuplicateImage, PoseUndetermined,
    and what `observe` raises.
    """
    hashes = tuple(image_sha256(picture.content) for picture in wanted.pictures)
    if len(set(hashes)) < len(hashes):
        raise DuplicateImage("The same picture is sent twice in one request. Send each picture once.")
    with database.read() as session:
        request = _load(session, wanted, hashes)
        known = _find_same(session, request)
        if known is not None:
            return Placed(known, is_new=False)
        _check(session, request)
    asked = Prescription(request.camera.intrinsics, parse_target(request.fixture.target), None)
    seen = [(picture, observe(picture, asked)) for picture in wanted.pictures]
    for picture in wanted.pictures:
        blobs.put(picture.content)
    with database.write() as session:
        # Whoever finishes a newer run of the serial meanwhile is not held up: the answer was true when asked.
        get_run(session, wanted.run_id, lock=True)
        known = _find_same(session, request)
        if known is not None:
            return Placed(known, is_new=False)
        return Placed(_store(session, request, seen, keys, who=who, now=now), is_new=True)


def recompute_later(session: Session, later_id: UUID) -> JsonObject:
    """Return the document of later extrinsics computed again from stored corners; raises NotFound."""
    row = get_later(session, later_id)
    fixture = FixtureDocument.model_validate(row.fixture)
    rows = pictures_of(session, [row.id])[row.id]
    return _document(_judge(load_camera(session, row.run_id), fixture, rows), rows, fixture)


def _load(session: Session, wanted: Wanted, hashes: tuple[str, ...]) -> _Request:
    camera, station = load_camera(session, wanted.run_id), get_station(session, wanted.station)
    if station.fixture is None:
        raise FixtureMissing(
            f"Nobody said where the fixed target of the station '{wanted.station}' stands. Give it its "
            "fixture, or name a station that has one.",
            station=wanted.station,
        )
    return _Request(camera, station, FixtureDocument.model_validate(station.fixture), hashes)


def _check(session: Session, request: _Request) -> None:
    check_accepted(session, request.camera.run)
    other = _used_for(session, request)
    if other is not None:
        raise PictureOfAnother(
            f"This very picture was used for the serial '{other}'. Take a new one of this vehicle.",
            serial=other,
        )


def _used_for(session: Session, request: _Request) -> str | None:
    """Return another serial that one of the pictures was used for; simulated runs may replay pictures."""
    run = request.camera.run
    if run.purpose is Purpose.SIMULATED:
        return None
    of_run = (
        select(RunRow.serial)
        .join(CaptureRow, CaptureRow.run_id == RunRow.id)
        .where(CaptureRow.sha256.in_(request.hashes), RunRow.serial != run.serial)
    )
    of_later = (
        select(RunRow.serial)
        .join(LaterExtrinsicsRow, LaterExtrinsicsRow.run_id == RunRow.id)
        .join(LaterPictureRow, LaterPictureRow.later_extrinsics_id == LaterExtrinsicsRow.id)
        .where(LaterPictureRow.sha256.in_(request.hashes), RunRow.serial != run.serial)
    )
    return session.scalar(of_run.limit(1)) or session.scalar(of_later.limit(1))


def _find_same(session: Session, request: _Request) -> LaterExtrinsicsView | None:
    query = select(LaterExtrinsicsRow).where(
        LaterExtrinsicsRow.run_id == request.camera.run.id,
        LaterExtrinsicsRow.request_sha256 == request.sha256,
    )
    row = session.scalar(query)
    return None if row is None else view_later(session, [row])[0]


def _store(
    session: Session,
    request: _Request,
    seen: Sequence[tuple[Picture, Observation]],
    keys: KeyRing,
    *,
    who: str,
    now: datetime,
) -> LaterExtrinsicsView:
    later_id = new_id()
    rows = [
        LaterPictureRow(later_extrinsics_id=later_id, **picture_columns(number, *one, sha256=digest))
        for number, (one, digest) in enumerate(zip(seen, request.hashes, strict=True), start=1)
    ]
    judged = _judge(request.camera, request.fixture, rows)
    row = LaterExtrinsicsRow(
        id=later_id,
        run_id=request.camera.run.id,
        station_id=request.station.id,
        request_sha256=request.sha256,
        fixture=request.fixture.to_json(),
        verdict=judged.verdict,
        document=_document(judged, rows, request.fixture),
        versions=versions(),
        created_at=now,
        created_by=who,
    )
    session.add_all([row, *rows])
    session.flush()
    issue_later(session, keys, row, who, now)
    _announce(session, request, row, who, now)
    return view_later(session, [row])[0]


def _announce(session: Session, request: _Request, row: LaterExtrinsicsRow, who: str, now: datetime) -> None:
    serial, station = request.camera.run.serial, request.station.code
    facts = {"serial": serial, "station": station, "verdict": row.verdict.value}
    record(session, now, who, "extrinsics.measure", f"run:{row.run_id}", **facts)
    body = {**facts, "run_id": str(row.run_id), "extrinsics": f"/api/v1/extrinsics/{row.id}"}
    outbox.append(session, "extrinsics.measured", f"vehicle:{serial}", body, now)


def _judge(camera: StoredCamera, fixture: FixtureDocument, rows: Sequence[LaterPictureRow]) -> JudgedPlace:
    views = tuple(detection_of(row) for row in rows)
    fixed = FixedTargetViews(parse_target(fixture.target), fixture.to_fixed_target(), views)
    revision = camera.revision
    return judge_place(fixed, camera.intrinsics, camera.covariance, revision.limits, revision.mounting)


def _document(judged: JudgedPlace, rows: Sequence[LaterPictureRow], fixture: FixtureDocument) -> JsonObject:
    names = {detection_of(row).name: row.id for row in rows}
    return {
        "extrinsics": extrinsics_document(judged.extrinsics, list(names), names, fixture.to_json()),
        "gates": [_gate(one) for one in judged.measurements],
    }


def _gate(one: Measurement) -> JsonObject:
    return {**asdict(one), "verdict": one.verdict.value, "reason": str(one.reason), "facts": dict(one.facts)}
