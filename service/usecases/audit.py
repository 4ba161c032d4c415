"""The audit trail: who changed what and when, written in the transaction that makes the change."""

from datetime import datetime

from sqlalchemy.orm import Session

from service.core.errors import Fact
from service.storage.models import AuditEntryRow


def record(session: Session, now: datetime, who: str, action: str, subject: str, **facts: Fact) -> None:
    """Add an entry; `action` is thing.verb, `subject` is thing:name."""
    session.add(AuditEntryRow(at=now, who=who, action=action, subject=subject, facts=dict(facts)))
