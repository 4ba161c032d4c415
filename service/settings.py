"""Every setting of the service: one frozen class, read from `DMSCAL_…` variables and an optional `.env` file.

Only `app`, `worker` and `cli` read settings; everything else receives values. Engineering limits (gates,
tolerances, pose spaces) are data of a SKU revision and never stand here.
"""

from pathlib import Path
from typing import Literal, Self

from pydantic import BaseModel, ConfigDict, Field, ValidationInfo, field_validator
from pydantic_settings import BaseSettings, SettingsConfigDict

DATABASE_SCHEMES = ("sqlite:///", "postgresql+psycopg://")
BLOBS_SCHEMES = ("file:",)


class JobSettings(BaseModel):
    """How jobs run."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    in_service: bool = Field(True, description="Run jobs in the service; false where workers do")
    threads: int = Field(1, ge=1, le=32, description="Jobs that one process runs at the same time")
    poll_s: float = Field(1.0, gt=0, description="Seconds between looks for jobs that another process queued")
    stale_s: float = Field(30.0, ge=1, description="Seconds without a sign of life before a job is run again")


class Settings(BaseSettings):
    """All settings. Empty addresses are filled in from the data directory."""

    model_config = SettingsConfigDict(
        env_prefix="DMSCAL_",
        env_nested_delimiter="__",
        env_file=".env",
        extra="ignore",
        frozen=True,
        validate_default=True,
        hide_input_in_errors=True,
    )

    data_dir: Path = Field(Path("data"), description="Directory of the database and the images by default")
    database_url: str = Field(
        "",
        repr=False,
        description="sqlite:///FILE or postgresql+psycopg://…; empty: a file in the data directory",
    )
    blobs_url: str = Field("", description="file:DIRECTORY for images; empty: `blobs` in the data directory")
    signing_keys_dir: str = Field(
        "",
        description="Directory of the keys that sign certificates, one for all replicas; empty: "
        "`signing-keys` in the data directory",
    )
    host: str = Field("127.0.0.1", description="Address to listen on; 0.0.0.0 for all")
    port: int = Field(8000, ge=0, le=65535, description="Port to listen on; 0 takes a free one")
    log_level: Literal["DEBUG", "INFO", "WARNING", "ERROR"] = Field(
        "INFO", description="Least level to log: DEBUG, INFO, WARNING or ERROR"
    )
    log_format: Literal["text", "json"] = Field(
        "text", description="Log lines for people (text) or machines (json)"
    )
    max_upload_mb: int = Field(32, ge=1, description="Largest request body, in megabytes of 10^6 bytes")
    max_image_megapixels: int = Field(24, ge=1, description="Largest image, in millions of pixels")
    shutdown_grace_s: float = Field(20.0, ge=0, description="Seconds for requests and jobs to end at a stop")
    frames_dir: str = Field(
        "", description="Directory whose folders and videos stations may replay (file:NAME); empty: none"
    )
    virtual_speed: float = Field(
        1.0, gt=0, le=1000, description="Seconds that pass at a virtual station in one second of ours"
    )
    jobs: JobSettings = JobSettings()

    @field_validator("database_url")
    @classmethod
    def _fill_database_url(cls, value: str, info: ValidationInfo) -> str:
        if not value and "data_dir" in info.data:
            return f"sqlite:///{info.data['data_dir'] / 'dmscal.db'}"
        if not value.startswith(DATABASE_SCHEMES) or value.removeprefix("sqlite:///") in {"", ":memory:"}:
            raise ValueError("give sqlite:///FILE or postgresql+psycopg://USER@HOST/NAME")
        return value

    @field_validator("blobs_url")
    @classmethod
    def _fill_blobs_url(cls, value: str, info: ValidationInfo) -> str:
        if not value and "data_dir" in info.data:
            return f"file:{info.data['data_dir'] / 'blobs'}"
        if not value.startswith(BLOBS_SCHEMES) or value in BLOBS_SCHEMES:
            raise ValueError("give file:DIRECTORY")
        return value

    @field_validator("signing_keys_dir")
    @classmethod
    def _fill_signing_keys_dir(cls, value: str, info: ValidationInfo) -> str:
        if not value and "data_dir" in info.data:
            return str(info.data["data_dir"] / "signing-keys")
        return value

    def in_directory(self, directory: Path) -> Self:
        """Return these settings with the database, the images and the signing keys in `directory`."""
        addresses = {
            "data_dir": directory,
            "database_url": f"sqlite:///{directory / 'dmscal.db'}",
            "blobs_url": f"file:{directory / 'blobs'}",
            "signing_keys_dir": str(directory / "signing-keys"),
        }
        return self.model_copy(update=addresses)
