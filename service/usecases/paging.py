"""Parts of long lists, newest first, by a cursor that stays right while rows are added."""

import base64
import binascii
from dataclasses import dataclass
from datetime import datetime
from typing import Any, Generic, Protocol, TypeVar
from uuid import UUID

from sqlalchemy import Select, tuple_
from sqlalchemy.orm import InstrumentedAttribute, Session

from service.core.errors import CursorInvalid

Item = TypeVar("Item")


@dataclass(frozen=True)
class PageRequest:
    """Which part of a list: at most `limit` items that come after `cursor`."""

    limit: int = 50
    cursor: str | None = None


@dataclass(frozen=True)
class Part(Generic[Item]):
    """Items of a list; `next_cursor` is None at its end."""

    items: list[Item]
    next_cursor: str | None


class Dated(Protocol):
    """A row class that lists are made of."""

    id: InstrumentedAttribute[UUID]
    created_at: InstrumentedAttribute[datetime]


def page_of(session: Session, query: Select[Any], row: Any, page: PageRequest) -> Part[Any]:
    """Return a part of the query's rows, newest first; `row` is the class with `created_at` and `id`.

    Raises CursorInvalid.
    """
    if page.cursor is not None:
        query = query.where(tuple_(row.created_at, row.id) < tuple_(*_read_cursor(page.cursor)))
    query = query.order_by(row.created_at.desc(), row.id.desc()).limit(page.limit + 1)
    found = list(session.scalars(query))
    items, more = found[: page.limit], len(found) > page.limit
    return Part(items, _write_cursor(items[-1].created_at, items[-1].id) if more else None)


def _write_cursor(created_at: datetime, row_id: UUID) -> str:
    return base64.urlsafe_b64encode(f"{created_at.isoformat()}|{row_id}".encode()).decode()


def _read_cursor(cursor: str) -> tuple[datetime, UUID]:
    try:
        created_at, _, row_id = (
            base64.b64decode(cursor, altchars=b"-_", validate=True).decode().partition("|")
        )
        moment = datetime.fromisoformat(created_at)
        if moment.tzinfo is None:
            raise ValueError("a cursor's time has a zone")
        return moment, UUID(row_id)
    except (ValueError, binascii.Error) as error:
        raise CursorInvalid(
            "This cursor is from no list of the service. Start again without a cursor.", cursor=cursor
        ) from error
