"""Brings a database to the tables this service needs, by the Alembic history in `migrations/`."""

from pathlib import Path

from alembic import command
from alembic.config import Config
from alembic.runtime.migration import MigrationContext
from alembic.script import ScriptDirectory
from sqlalchemy import Connection

from service.core.errors import DatabaseOutdated
from service.storage.database import Database

PACKAGE = Path(__file__).resolve().parent.parent


def scripts_directory() -> Path:
    """Return the history: inside an installed package, beside the package in a checkout."""
    installed = PACKAGE / "migrations"
    return installed if installed.is_dir() else PACKAGE.parent / "migrations"


def alembic_config(connection: Connection | None = None) -> Config:
    """Return Alembic's configuration without its file, for commands that run on `connection`."""
    config = Config(attributes={"connection": connection})
    config.set_main_option("script_location", str(scripts_directory()).replace("%", "%%"))
    config.set_main_option("path_separator", "os")
    return config


def upgrade(database: Database) -> None:
    """Bring the tables to the newest revision, in one transaction; nothing to do is fine.

    Raises DatabaseOutdated for a database that a newer service has written.
    """
    known = {script.revision for script in ScriptDirectory.from_config(alembic_config()).walk_revisions()}
    if (found := revision_of(database)) not in {None, *known}:
        raise DatabaseOutdated(
            f"The database is at revision {found}, which a newer service has made. Install that one.",
            found=found,
        )
    with database.writer.connect() as connection:
        command.upgrade(alembic_config(connection), "head")


def revision_of(database: Database) -> str | None:
    """Return the revision that the database is at, None for an empty one."""
    with database.reader.connect() as connection:
        return MigrationContext.configure(connection).get_current_revision()


def check_at_head(database: Database) -> None:
    """Raise DatabaseOutdated unless the database is at the revision that this service was built for."""
    wanted = ScriptDirectory.from_config(alembic_config()).get_current_head()
    found = revision_of(database)
    if found != wanted:
        raise DatabaseOutdated(
            f"The database is at revision {found}, this service needs {wanted}. Run `dmscal migrate`, or "
            "install the service's version that belongs to the database.",
            found=found,
            needed=wanted,
        )
