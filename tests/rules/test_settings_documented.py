"""`.env.example` lists every setting with its default and what it is, and nothing else."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from pydantic import BaseModel

from service.settings import Settings

EXAMPLE = Path(__file__).resolve().parents[2] / ".env.example"


def settings_of(model: type[BaseModel], prefix: str = "DMSCAL_") -> Iterator[tuple[str, str, str]]:
    for name, field in model.model_fields.items():
        if isinstance(field.default, BaseModel):
            yield from settings_of(type(field.default), f"{prefix}{name.upper()}__")
        else:
            default = str(field.default).lower() if isinstance(field.default, bool) else str(field.default)
            yield f"{prefix}{name.upper()}", default, field.description or ""


def test_the_example_lists_every_setting_with_its_default_and_what_it_is() -> None:
    lines = re.findall(r"^# (.+)\n(DMSCAL_\w+)=(.*)$", EXAMPLE.read_text(), re.M)

    assert [(name, default, said) for said, name, default in lines] == list(settings_of(Settings))


def test_every_setting_says_what_it_is() -> None:
    assert [name for name, _, said in settings_of(Settings) if not said] == []


def test_the_example_as_it_stands_changes_nothing(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    for name, _, _ in settings_of(Settings):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.chdir(tmp_path)
    defaults = Settings()
    (tmp_path / ".env").write_text(EXAMPLE.read_text())

    assert Settings() == defaults
