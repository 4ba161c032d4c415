"""Events on their way out: written in the transaction that made them true, claimed by whoever sends them.

Sending and sending again are not done here. They are claimed in the order they were written, so one sender at
a time keeps that order.
"""

from datetime import datetime

from sqlalchemy import select
from sqlalchemy.orm import Session

from service.storage.models import JsonObject, OutboxEventRow


def append(session: Session, kind: str, subject: str, body: JsonObject, now: datetime) -> OutboxEventRow:
    """Write an event in the caller's transaction; `subject` is what it is about, such as `vehicle:SERIAL`."""
    row = OutboxEventRow(kind=kind, subject=subject, body=body, created_at=now)
    session.add(row)
    return row


def claim(session: Session, most: int, now: datetime) -> list[OutboxEventRow]:
    """Take up to `most` events that nobody has claimed, oldest first; no two senders get the same one."""
    rows = session.scalars(
        select(OutboxEventRow)
        .where(OutboxEventRow.claimed_at.is_(None))
        .order_by(OutboxEventRow.created_at, OutboxEventRow.id)
        .limit(most)
        .with_for_update(skip_locked=True)
    ).all()
    for row in rows:
        row.claimed_at = now
    return list(rows)
