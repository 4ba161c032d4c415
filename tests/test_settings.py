"""Settings: from the environment, checked, addresses filled in, nothing secret shown."""

from pathlib import Path

import pytest
from pydantic import ValidationError

from service.settings import Settings


@pytest.fixture(autouse=True)
def _clean_environment(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    for name in ("DATABASE_URL", "DATA_DIR", "BLOBS_URL", "JOBS__THREADS", "PORT"):
        monkeypatch.delenv(f"DMSCAL_{name}", raising=False)
    monkeypatch.chdir(tmp_path)


def test_without_any_setting_all_is_kept_in_the_data_directory() -> None:
    settings = Settings()

    assert settings.database_url == "sqlite:///data/dmscal.db"
    assert settings.blobs_url == "file:data/blobs"


def test_the_data_directory_moves_the_database_and_the_images(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DMSCAL_DATA_DIR", "/srv/dmscal")

    assert Settings().database_url == "sqlite:////srv/dmscal/dmscal.db"
    assert Settings().blobs_url == "file:/srv/dmscal/blobs"


def test_nested_settings_are_read_with_two_underscores(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DMSCAL_JOBS__THREADS", "3")

    assert Settings().jobs.threads == 3


def test_settings_are_read_from_an_env_file(tmp_path: Path) -> None:
    (tmp_path / ".env").write_text("DMSCAL_PORT=8123\nOTHER=1\n")

    assert Settings().port == 8123


def test_settings_cannot_be_changed() -> None:
    with pytest.raises(ValidationError):
        Settings().port = 1  # type: ignore[misc]


@pytest.mark.parametrize(
    "address", ["mysql://host/db", "sqlite://", "sqlite:///:memory:", "postgresql://host/db", "dmscal.db"]
)
def test_a_database_that_is_not_supported_is_refused(address: str) -> None:
    with pytest.raises(ValidationError, match="sqlite:///FILE"):
        Settings(database_url=address)


@pytest.mark.parametrize("address", ["s3://bucket", "blobs", "file:"])
def test_an_image_store_that_is_not_supported_is_refused(address: str) -> None:
    with pytest.raises(ValidationError, match="file:DIRECTORY"):
        Settings(blobs_url=address)


def test_a_password_is_neither_shown_nor_repeated_in_an_error() -> None:
    settings = Settings(database_url="postgresql+psycopg://dmscal:secret@db/dmscal")
    with pytest.raises(ValidationError) as raised:
        Settings(database_url="mysql://dmscal:secret@db/dmscal")

    assert "secret" not in repr(settings) + str(raised.value)


def test_settings_can_be_moved_to_another_directory(tmp_path: Path) -> None:
    settings = Settings(port=9000).in_directory(tmp_path)

    assert settings.database_url == f"sqlite:///{tmp_path}/dmscal.db"
    assert settings.port == 9000
