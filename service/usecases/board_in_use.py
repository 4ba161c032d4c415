"""Which shape a run's plate has: the certified one of the board that stood at its station.

A result names the shape that it was solved with, so that it is computed again with the same one. Not here:
how shapes are learnt (`board_learning`) and certified (`board_shapes`).
"""

from dataclasses import dataclass
from typing import Any
from uuid import UUID

import numpy as np
from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.vision.target import Target
from service.core.vision.transforms import Array
from service.storage.learnt import BoardShapeRow
from service.storage.models import CalibrationRow, RunRow, TargetRow
from service.storage.words import ShapeState

JsonObject = dict[str, Any]


@dataclass(frozen=True)
class BoardInUse:
    """Corners (n, 3), m, of a plate of learnt shape, and the form in which a result names that shape."""

    corners: Array
    reference: JsonObject


def load_board(session: Session, run: RunRow, target: Target) -> BoardInUse | None:
    """Return the plate of a run: what its result was solved with, where it has one, else what stands now.

    None where no shape is certified, or where the board's pattern is not the SKU's.
    """
    document = session.scalar(select(CalibrationRow.document).where(CalibrationRow.run_id == run.id))
    if document is not None:
        named = document.get("board_shape")
        return (
            None
            if named is None
            else _board(session, session.get_one(BoardShapeRow, UUID(named["id"])), target)
        )
    if run.target_id is None or session.get_one(TargetRow, run.target_id).spec != target.spec:
        return None
    shape = certified_shape(session, run.target_id)
    return None if shape is None else _board(session, shape, target)


def certified_shape(session: Session, target_id: UUID) -> BoardShapeRow | None:
    """Return the shape of a board that solves use, or None."""
    query = select(BoardShapeRow).where(
        BoardShapeRow.target_id == target_id, BoardShapeRow.state == ShapeState.CERTIFIED
    )
    return session.scalar(query)


def _board(session: Session, shape: BoardShapeRow, target: Target) -> BoardInUse:
    serial = session.get_one(TargetRow, shape.target_id).serial
    return BoardInUse(
        target.object_points + np.array(shape.deviations),
        {"id": str(shape.id), "target": serial, "version": shape.version},
    )
