import hashlib

import pytest

from service.core.errors import NotAuthenticated, NotFound
from service.storage.columns import new_id
from service.storage.database import Database
from service.storage.models import ApiKeyRow, AuditEntryRow
from service.storage.words import Role
from service.usecases.access import KeyMade, create_first_key, create_key, identify, revoke_key
from tests.fakes import FakeClock


def make_key(database: Database, clock: FakeClock, role: Role = Role.OPERATOR) -> KeyMade:
    with database.write() as session:
        return create_key(session, "kiosk", role, "test", clock.now())


def test_a_key_says_whose_it_is_and_only_its_hash_is_kept(database: Database, clock: FakeClock) -> None:
    made = make_key(database, clock)

    assert identify(database, made.key, clock.now()).role is Role.OPERATOR
    with database.read() as session:
        row = session.get_one(ApiKeyRow, made.id)
    assert row.sha256 == hashlib.sha256(made.key.encode()).hexdigest()
    assert made.key.startswith(f"dmscal_{row.prefix}_")
    # 256 bits in base 64 are 43 characters.
    assert len(made.key) == len(f"dmscal_{row.prefix}_") + 43


@pytest.mark.parametrize("key", ["", "dmscal_", "x" * 5000, "dmscal_00000000_\udcff", "schlüssel"])
def test_an_unknown_key_is_refused(database: Database, clock: FakeClock, key: str) -> None:
    make_key(database, clock)

    with pytest.raises(NotAuthenticated):
        identify(database, key, clock.now())


def test_a_revoked_key_is_refused(database: Database, clock: FakeClock) -> None:
    made = make_key(database, clock)
    with database.write() as session:
        revoke_key(session, made.id, "test", clock.now())

    with pytest.raises(NotAuthenticated):
        identify(database, made.key, clock.now())


def test_revoking_again_changes_nothing(database: Database, clock: FakeClock) -> None:
    made = make_key(database, clock)
    with database.write() as session:
        first = revoke_key(session, made.id, "test", clock.now()).revoked_at
    clock.advance(60)
    with database.write() as session:
        assert revoke_key(session, made.id, "test", clock.now()).revoked_at == first
        assert session.query(AuditEntryRow).filter_by(action="key.revoke").count() == 1


def test_an_unknown_key_is_not_revoked(database: Database, clock: FakeClock) -> None:
    with database.write() as session, pytest.raises(NotFound):
        revoke_key(session, new_id(), "test", clock.now())


def test_use_is_noted_now_and_then(database: Database, clock: FakeClock) -> None:
    made = make_key(database, clock)
    used = []
    for seconds in (0, 60, 3600):
        clock.advance(seconds)
        identify(database, made.key, clock.now())
        with database.read() as session:
            used.append(session.get_one(ApiKeyRow, made.id).last_used_at)

    assert used[0] == used[1]
    assert used[2] == clock.now()


def test_the_first_key_is_made_once(database: Database, clock: FakeClock) -> None:
    with database.write() as session:
        first = create_first_key(session, clock.now())
    with database.write() as session:
        second = create_first_key(session, clock.now())

    assert first is not None
    assert first.role is Role.ADMIN
    assert second is None
