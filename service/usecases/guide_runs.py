"""The run behind a guidance session: taken from what is stored, so that it survives any restart.

Not here: what happens while it is guided (`guide`).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from uuid import UUID

from sqlalchemy import func, select
from sqlalchemy.orm import Session

from service.core.errors import NotFound, PoseSetNotPublished
from service.core.guidance.actions import AddedPose
from service.core.guidance.problems import OtherSkuOpen
from service.core.run import Purpose, RunState, check_serial
from service.core.vision.transforms import Pose
from service.storage.models import CaptureRow, PoseSetRow, RunRow, SkuRevisionRow, SkuRow, StationRow
from service.storage.words import FrameOrigin, Language, Publication
from service.usecases.audit import record
from service.usecases.frame_address import HELD, origin_of
from service.usecases.guide_next_pose import read_postponed
from service.usecases.observation import pose_from_json
from service.usecases.run_filter import RunFilter
from service.usecases.run_poses import read_added, view_added
from service.usecases.runs import Order, get_run, open_run
from service.usecases.sku_document import Revision, SkuDocument
from service.usecases.stations import get_station

SKUS_SHOWN = 100


@dataclass(frozen=True)
class Wish:
    """What a kiosk asks for: a serial, the SKU where a run may be opened for it, and the purpose.

    Without a purpose the run is a retest where the serial has a result already, and else production: whoever
    scans need not know.
    """

    serial: str
    sku: str | None
    purpose: Purpose | None = None


@dataclass(frozen=True)
class GuidedRun:
    """A run as guidance needs it.

    poses: of its set; added: poses beyond it. captured: pose indices that have a capture, in the order they
    were taken. postponed: those that come after all others, in that order. promised: sd by parameter that the
    pose set was planned to reach, None for an imported one. is_retired: its revision was replaced since.
    """

    id: UUID
    serial: str
    sku: str
    number: int
    purpose: Purpose
    revision: Revision
    poses: tuple[Pose, ...]
    captured: tuple[int, ...]
    postponed: tuple[int, ...]
    added: tuple[AddedPose, ...]
    promised: Mapping[str, float] | None
    is_retired: bool


@dataclass(frozen=True)
class StationView:
    """A station as its kiosk is welcomed; source: the whole address, for nobody but who reads the camera."""

    id: UUID
    code: str
    name: str
    source: str
    origin: FrameOrigin
    language: Language | None
    run_id: UUID | None
    skus: list[str]

    @property
    def moves_board(self) -> bool:
        """Whether its board is virtual and moved by whoever is at the kiosk."""
        return self.source == HELD


def read_station(session: Session, code: str) -> StationView:
    """Return a station with the run that it works on, if any; raises NotFound."""
    row = get_station(session, code)
    published = (
        select(SkuRow.code)
        .join(SkuRevisionRow, SkuRevisionRow.sku_id == SkuRow.id)
        .join(PoseSetRow, PoseSetRow.sku_revision_id == SkuRevisionRow.id)
        .where(SkuRevisionRow.state == Publication.PUBLISHED, PoseSetRow.state == Publication.PUBLISHED)
        .order_by(SkuRow.created_at.desc())
        .limit(SKUS_SHOWN)
    )
    skus = list(session.scalars(published))
    origin = origin_of(row.source)
    return StationView(
        row.id, row.code, row.name, row.source, origin, row.language, _latest_open(session, row), skus
    )


def take_run(session: Session, code: str, wish: Wish, who: str, now: datetime) -> UUID:
    """Return the open run of a serial at a station; opened where there is none.

    A run that was ordered without a station becomes this one's. Raises SerialInvalid, NotFound, OtherSkuOpen,
    RevisionNotPublished, PoseSetNotPublished.
    """
    station = get_station(session, code)
    # Two kiosks that scan the same serial at the same moment must not open two runs.
    session.get(StationRow, station.id, with_for_update=True)
    serial = check_serial(wish.serial)
    found = _open_of_serial(session, station, serial)
    if found is None:
        return _open(session, station, serial, wish, who=who, now=now)
    sku = _sku_code(session, found)
    if wish.sku is not None and wish.sku != sku:
        raise OtherSkuOpen(
            f"Serial '{serial}' has an open run for SKU '{sku}', not '{wish.sku}'. Continue that run, or "
            "abort it first.",
            serial=serial,
            sku=sku,
            run=f"/api/v1/runs/{found.id}",
        )
    if found.station_id is None:
        found.station_id = station.id
        record(session, now, who, "run.take", f"run:{found.id}", station=code)
    return found.id


def load_guided_run(session: Session, run_id: UUID) -> GuidedRun:
    """Return a run with its poses and what was captured; raises NotFound, PoseSetNotPublished."""
    run = get_run(session, run_id)
    pose_set = None if run.pose_set_id is None else session.get_one(PoseSetRow, run.pose_set_id)
    if pose_set is None:
        raise PoseSetNotPublished(
            "The run has no pose set, so that there are no poses to guide to. Abort it, publish a pose set "
            "of its SKU, and open a new run.",
            run=f"/api/v1/runs/{run_id}",
        )
    revision = session.get_one(SkuRevisionRow, run.sku_revision_id)
    query = select(CaptureRow.pose_index).where(CaptureRow.run_id == run_id).order_by(CaptureRow.number)
    return GuidedRun(
        id=run.id,
        serial=run.serial,
        sku=_sku_code(session, run),
        number=revision.number,
        purpose=run.purpose,
        revision=SkuDocument.model_validate(revision.document).to_revision(),
        poses=tuple(pose_from_json(pose) for pose in pose_set.poses),
        captured=tuple(index for index in session.scalars(query) if index is not None),
        postponed=read_postponed(session, run_id),
        added=tuple(map(view_added, read_added(session, run_id))),
        promised=pose_set.prediction.get("sd"),
        is_retired=revision.state is Publication.RETIRED,
    )


def capture_of_pose(session: Session, run_id: UUID, pose_index: int) -> UUID | None:
    """Return the id of a pose's capture, or None."""
    query = select(CaptureRow.id).where(CaptureRow.run_id == run_id, CaptureRow.pose_index == pose_index)
    return session.scalar(query)


def _open(session: Session, station: StationRow, serial: str, wish: Wish, *, who: str, now: datetime) -> UUID:
    if wish.sku is None:
        raise NotFound(
            f"There is no open run for serial '{serial}' at this station. Choose its SKU to open one.",
            serial=serial,
        )
    purpose = _purpose(session, station, serial, wish)
    opened = open_run(session, Order(wish.sku, serial, station.code, purpose), who, now)
    if opened.pose_set_id is None:
        raise PoseSetNotPublished(
            f"SKU '{wish.sku}' has no published pose set, so that there are no poses to guide to. Plan and "
            "publish one.",
            sku=wish.sku,
        )
    return opened.id


def _purpose(session: Session, station: StationRow, serial: str, wish: Wish) -> Purpose:
    # What is simulated or replayed says nothing about a vehicle and must not count for the line's yield.
    if origin_of(station.source) in {FrameOrigin.VIRTUAL, FrameOrigin.FILE}:
        return Purpose.SIMULATED
    if wish.purpose is not None:
        return wish.purpose
    tested = RunFilter(serial=serial, sku=wish.sku, counted=True).narrow(select(RunRow.id)).limit(1)
    return Purpose.PRODUCTION if session.scalar(tested) is None else Purpose.RETEST


def _open_of_serial(session: Session, station: StationRow, serial: str) -> RunRow | None:
    query = select(RunRow).where(
        RunRow.serial == serial,
        RunRow.state == RunState.OPEN,
        (RunRow.station_id == station.id) | RunRow.station_id.is_(None),
    )
    return session.scalar(query.order_by(RunRow.created_at.desc(), RunRow.id.desc()).limit(1))


def _latest_open(session: Session, station: StationRow) -> UUID | None:
    """Return the station's open run in which something was done last."""
    latest = func.coalesce(func.max(CaptureRow.created_at), RunRow.created_at)
    query = (
        select(RunRow.id)
        .outerjoin(CaptureRow, CaptureRow.run_id == RunRow.id)
        .where(RunRow.station_id == station.id, RunRow.state == RunState.OPEN)
        .where(RunRow.pose_set_id.is_not(None))
        .group_by(RunRow.id, RunRow.created_at)
        .order_by(latest.desc(), RunRow.id.desc())
        .limit(1)
    )
    return session.scalar(query)


def _sku_code(session: Session, run: RunRow) -> str:
    revision = session.get_one(SkuRevisionRow, run.sku_revision_id)
    return session.get_one(SkuRow, revision.sku_id).code
