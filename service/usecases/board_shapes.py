"""Shapes of boards: ask for one to be learnt, look at them, certify one with a date, retire it.

Solves at the stations of a board use its certified shape from then on. Not here: how a shape is learnt
(`board_learning`).
"""

from collections.abc import Iterable
from dataclasses import dataclass
from datetime import datetime
from typing import Any
from uuid import UUID

import numpy as np
from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.errors import NotFound, StateForbids
from service.core.quality.board_drift import KNOWN_SHARE, ShapeCertainty
from service.core.vision.target import parse_target
from service.ports import JobQueue
from service.storage.learnt import BoardShapeRow
from service.storage.models import JobRow, TargetRow
from service.storage.words import ShapeState
from service.usecases.audit import record
from service.usecases.board_in_use import certified_shape
from service.usecases.board_learning import LEARN_BOARD_SHAPE, check_teaching_runs
from service.usecases.paging import PageRequest, Part, page_of

JsonObject = dict[str, Any]


@dataclass(frozen=True, kw_only=True)
class ShapeView:
    """A shape in a list."""

    id: UUID
    target_id: UUID
    version: int
    state: ShapeState
    runs: int
    bend_mm: float
    in_plane_mm: float
    certainty: JsonObject
    sigma_flat_px: float
    sigma_px: float
    drift: JsonObject | None
    created_at: datetime
    created_by: str
    certified_at: datetime | None
    certified_by: str | None
    retired_at: datetime | None
    retired_by: str | None


@dataclass(frozen=True, kw_only=True)
class ShapeDetailView(ShapeView):
    """A shape with its corners, by corner, mm, and the runs that it was learnt from.

    corners_mm: x y of the pattern. deviations_mm, sd_mm: x y z from there.
    """

    corners_mm: list[list[float]]
    deviations_mm: list[list[float]]
    sd_mm: list[list[float]]
    run_ids: list[str]


@dataclass(frozen=True)
class TargetView:
    """A board with the shape that solves use, and how far its newest shape has drifted from that."""

    id: UUID
    serial: str | None
    spec: str
    drift_limit_mm: float
    created_at: datetime
    certified_shape: ShapeView | None
    drift: JsonObject | None


def find_target(session: Session, named: str) -> TargetRow:
    """Return a board by its id or its serial; raises NotFound."""
    row = session.scalar(select(TargetRow).where(TargetRow.serial == named))
    if row is None and (target_id := _uuid(named)) is not None:
        row = session.get(TargetRow, target_id)
    if row is None:
        raise NotFound(f"There is no board '{named}'. List the boards, or register it.", target=named)
    return row


def read_target(session: Session, named: str) -> TargetView:
    """Return a board with its shape; raises NotFound."""
    row = find_target(session, named)
    return view_targets(session, [row.id])[row.id]


def view_targets(session: Session, target_ids: Iterable[UUID]) -> dict[UUID, TargetView]:
    """Return boards by id, each with its shape, by a fixed number of queries."""
    ids = list(target_ids)
    drifts = present_drift(session, ids)
    query = select(BoardShapeRow).where(
        BoardShapeRow.target_id.in_(ids), BoardShapeRow.state == ShapeState.CERTIFIED
    )
    certified = {row.target_id: ShapeView(**_common(row)) for row in session.scalars(query)}
    return {
        row.id: TargetView(
            id=row.id,
            serial=row.serial,
            spec=row.spec,
            drift_limit_mm=row.drift_limit_mm,
            created_at=row.created_at,
            certified_shape=certified.get(row.id),
            drift=drifts.get(row.id),
        )
        for row in session.scalars(select(TargetRow).where(TargetRow.id.in_(ids)))
    }


def request_shape(
    session: Session, queue: JobQueue, named: str, runs: int, *, who: str, now: datetime
) -> JobRow:
    """Queue the job that learns a board's shape from its last runs; raises NotFound, StateForbids."""
    target = find_target(session, named)
    check_teaching_runs(session, target, runs)
    arguments = {"target_id": str(target.id), "runs": runs, "who": who}
    job_id = queue.enqueue(session, LEARN_BOARD_SHAPE, arguments)
    record(session, now, who, "board-shape.request", f"target:{target.id}", runs=runs)
    session.flush()
    return session.get_one(JobRow, job_id)


def list_shapes(session: Session, named: str, page: PageRequest) -> Part[ShapeView]:
    """Return a part of a board's shapes, newest first; raises NotFound."""
    query = select(BoardShapeRow).where(BoardShapeRow.target_id == find_target(session, named).id)
    part = page_of(session, query, BoardShapeRow, page)
    return Part([ShapeView(**_common(row)) for row in part.items], part.next_cursor)


def read_shape(session: Session, shape_id: UUID) -> ShapeDetailView:
    """Return a shape with its corners; raises NotFound."""
    return _detail(session, _get(session, shape_id))


def certify_shape(session: Session, shape_id: UUID, who: str, now: datetime) -> ShapeDetailView:
    """Let the solves of a board use a shape, from now on, in the place of the one before.

    Raises NotFound, and StateForbids for a retired shape or one that is not known well enough.
    """
    row = _get(session, shape_id)
    # Two certificates at the same moment must not both stand.
    target = session.get_one(TargetRow, row.target_id, with_for_update=True)
    if row.state is ShapeState.CERTIFIED:
        return _detail(session, row)
    if row.state is ShapeState.RETIRED:
        raise StateForbids("The shape is retired. Learn a new one, and certify that.", state=row.state.value)
    _check_known(row, target)
    before = certified_shape(session, target.id)
    if before is not None:
        _retire(before, who, now)
    row.state, row.certified_at, row.certified_by = ShapeState.CERTIFIED, now, who
    record(session, now, who, "board-shape.certify", f"target:{target.id}", version=row.version)
    session.flush()
    return _detail(session, row)


def retire_shape(session: Session, shape_id: UUID, who: str, now: datetime) -> ShapeDetailView:
    """Take a shape out of use; without a certified one solves take the board for flat. Raises NotFound."""
    row = _get(session, shape_id)
    if row.state is not ShapeState.RETIRED:
        _retire(row, who, now)
        record(session, now, who, "board-shape.retire", f"target:{row.target_id}", version=row.version)
        session.flush()
    return _detail(session, row)


def present_drift(session: Session, target_ids: Iterable[UUID]) -> dict[UUID, JsonObject]:
    """Return by board how far its newest shape is from the certified one; none where it is that one.

    A drift that was measured against another certified shape than the present one says nothing any more.
    """
    query = (
        select(BoardShapeRow)
        .where(BoardShapeRow.target_id.in_(list(target_ids)), BoardShapeRow.state != ShapeState.RETIRED)
        .order_by(BoardShapeRow.target_id, BoardShapeRow.version)
    )
    certified: dict[UUID, BoardShapeRow] = {}
    newest: dict[UUID, BoardShapeRow] = {}
    for row in session.scalars(query):
        newest[row.target_id] = row
        if row.state is ShapeState.CERTIFIED:
            certified[row.target_id] = row
    return {
        target_id: {**row.drift, "measured_at": row.created_at}
        for target_id, row in newest.items()
        if row.drift is not None
        and target_id in certified
        and row.created_at >= (certified[target_id].certified_at or row.created_at)
        and row is not certified[target_id]
    }


def _check_known(row: BoardShapeRow, target: TargetRow) -> None:
    certainty = ShapeCertainty(**row.certainty)
    if not certainty.suits(target.drift_limit_mm):
        needed = KNOWN_SHARE * target.drift_limit_mm
        raise StateForbids(
            f"The corners of this shape are known to {certainty.corner_mm:.3f} mm only, and a drift limit of "
            f"{target.drift_limit_mm:g} mm needs {needed:.3f} mm. Learn it from more runs.",
            corner_mm=round(certainty.corner_mm, 4),
            needed_mm=round(needed, 4),
        )


def _retire(row: BoardShapeRow, who: str, now: datetime) -> None:
    row.state, row.retired_at, row.retired_by = ShapeState.RETIRED, now, who


def _get(session: Session, shape_id: UUID) -> BoardShapeRow:
    row = session.get(BoardShapeRow, shape_id)
    if row is None:
        raise NotFound("There is no board shape of this id. List those of the board.", shape_id=str(shape_id))
    return row


def _detail(session: Session, row: BoardShapeRow) -> ShapeDetailView:
    pattern = parse_target(session.get_one(TargetRow, row.target_id).spec)
    return ShapeDetailView(
        **_common(row),
        corners_mm=(1e3 * pattern.object_points[:, :2]).tolist(),
        deviations_mm=(1e3 * np.array(row.deviations)).tolist(),
        sd_mm=(1e3 * np.array(row.sd)).tolist(),
        run_ids=list(row.run_ids),
    )


def _common(row: BoardShapeRow) -> dict[str, Any]:
    names = ShapeView.__dataclass_fields__.keys() - {"runs"}
    return {**{name: getattr(row, name) for name in names}, "runs": len(row.run_ids)}


def _uuid(text: str) -> UUID | None:
    try:
        return UUID(text)
    except ValueError:
        return None
