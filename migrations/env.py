"""How Alembic reaches the database: on the connection it is given, else on the one of the settings."""

from typing import Literal

import sqlalchemy as sa
from alembic import context
from alembic.autogenerate.api import AutogenContext
from sqlalchemy import Connection

from service.settings import Settings
from service.storage.columns import UtcDateTime
from service.storage.database import Database
from service.storage.tables import ALL_TABLES

# Two services that start together take turns; the number is the ASCII of "dmscal".
POSTGRESQL_TURN = "SELECT pg_advisory_xact_lock(110421250105708)"


def run(connection: Connection) -> None:
    """Run the command in one transaction."""
    if connection.dialect.name != "sqlite":
        with connection.begin():
            connection.exec_driver_sql("SET LOCAL lock_timeout = '30s'")
            connection.exec_driver_sql(POSTGRESQL_TURN)
            migrate(connection)
        return
    # Batch mode replaces tables that others refer to; inside the transaction this would have no effect.
    _pragma(connection, "foreign_keys=OFF")
    try:
        with connection.begin():
            migrate(connection)
            if connection.exec_driver_sql("PRAGMA foreign_key_check").first():
                raise RuntimeError(
                    "the migration would leave rows that refer to nothing; nothing was changed"
                )
    finally:
        _pragma(connection, "foreign_keys=ON")


def migrate(connection: Connection) -> None:
    """Run the revisions on a connection that is in a transaction."""
    context.configure(
        connection=connection,
        target_metadata=ALL_TABLES,
        render_as_batch=connection.dialect.name == "sqlite",
        render_item=render,
    )
    context.run_migrations()


def render(kind: str, item: object, _context: AutogenContext) -> str | Literal[False]:
    """Write a column's type without our own classes: a revision must mean the same in ten years."""
    if kind == "type" and isinstance(item, UtcDateTime):
        return "sa.DateTime(timezone=True)"
    return "sa.JSON()" if kind == "type" and isinstance(item, sa.JSON) else False


def _pragma(connection: Connection, pragma: str) -> None:
    # On the driver's connection: SQLAlchemy would begin a transaction first.
    driver = connection.connection.driver_connection
    assert driver is not None  # noqa: S101 - a connection that was just opened
    driver.execute(f"PRAGMA {pragma}")


given = context.config.attributes.get("connection")
if given is not None:
    run(given)
else:
    database = Database.open(Settings().database_url)
    with database.writer.connect() as own:
        run(own)
    database.close()
