"""The life of what is published: draft, published, retired; a published thing is never edited."""

from datetime import datetime

from service.core.errors import StateForbids
from service.storage.models import PoseSetRow, SkuRevisionRow
from service.storage.words import Publication


def publish(
    row: SkuRevisionRow | PoseSetRow, siblings: list[SkuRevisionRow] | list[PoseSetRow], now: datetime
) -> bool:
    """Publish a draft and retire its published siblings; return False if it is published already.

    Raises StateForbids for a retired one.
    """
    if row.state is Publication.PUBLISHED:
        return False
    if row.state is Publication.RETIRED:
        raise StateForbids(
            "It is retired and cannot be published again. Make a new one.", state=row.state.value
        )
    for sibling in siblings:
        if sibling.state is Publication.PUBLISHED:
            sibling.state = Publication.RETIRED
    row.state, row.published_at = Publication.PUBLISHED, now
    return True


def retire(row: PoseSetRow, who: str, now: datetime) -> bool:
    """Retire what is published; return False if it is retired already. Raises StateForbids for a draft."""
    if row.state is Publication.RETIRED:
        return False
    if row.state is Publication.DRAFT:
        raise StateForbids(
            "It is a draft: no run follows it, so there is nothing to retire. Leave it, or publish it first.",
            state=row.state.value,
        )
    row.state, row.retired_at, row.retired_by = Publication.RETIRED, now, who
    return True
