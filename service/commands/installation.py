"""The installation that a verb works on, by --data-dir or the environment: its settings and its database."""

import argparse
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from pydantic import ValidationError

from service.core.errors import BadRequest
from service.settings import Settings
from service.storage.database import Database
from service.storage.migration import check_at_head

WHO = "command line"


def add_data_dir(parser: argparse.ArgumentParser) -> None:
    """Let a verb take --data-dir."""
    parser.add_argument(
        "--data-dir", type=Path, help="directory of database and images (else DMSCAL_DATA_DIR)"
    )


def read_settings(arguments: argparse.Namespace) -> Settings:
    """Return the settings of the environment; raises BadRequest naming those that are wrong."""
    try:
        settings = Settings()
    except ValidationError as error:
        wrong = "; ".join(f"{'.'.join(map(str, one['loc']))}: {one['msg']}" for one in error.errors())
        raise BadRequest(f"Correct these settings (DMSCAL_...): {wrong}.") from error
    return settings if arguments.data_dir is None else settings.in_directory(arguments.data_dir)


@contextmanager
def opened_database(arguments: argparse.Namespace) -> Iterator[Database]:
    """Yield the database of the settings; raises DatabaseOutdated unless it was migrated."""
    with closing(Database.open(read_settings(arguments).database_url)) as database:
        check_at_head(database)
        yield database
