"""The pages on certificates and exports: their code runs as it stands against a real service."""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pyarrow.parquet as pq
import pytest
from cryptography.exceptions import InvalidSignature

from service.storage.words import Role
from service.usecases.block_layout import BlockLayout
from tests.browser.serving import Serving, prepare_service
from tests.plant import running_plant

DOCS = Path(__file__).resolve().parents[2] / "docs"
Served = tuple[Serving, dict[str, Any]]


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Served]:
    """A service with one finished run, and the names that the pages use."""
    directory = tmp_path_factory.mktemp("served")
    service = prepare_service(directory)
    with running_plant(service.settings.database_url, directory) as plant:
        plant.publish_sku()
        run_id = plant.finished_run("VIN-1")
        key = plant.keys[Role.VIEWER]
    service.start()
    yield service, {"SERVICE": service.url, "KEY": key, "RUN": run_id}
    service.stop()


def code_of(page: str, language: str) -> str:
    return "\n".join(re.findall(rf"```{language}\n(.*?)```", (DOCS / page).read_text(), re.S))


def test_a_certificate_is_checked_as_the_page_shows(
    served: Served, capsys: pytest.CaptureFixture[str]
) -> None:
    names = dict(served[1])
    code = code_of("certificate.md", "python")

    exec(compile(code, "certificate.md", "exec"), names)  # noqa: S102 - our own page

    assert capsys.readouterr().out.strip() == "VIN-1 PASS"
    changed = code.replace('f"{header}.{payload}"', 'f"{header}.{payload}x"')
    with pytest.raises(InvalidSignature):
        exec(compile(changed, "certificate.md", "exec"), dict(served[1]))  # noqa: S102 - our own page


def test_many_runs_are_fetched_as_the_page_shows(
    served: Served, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    names = dict(served[1])

    exec(compile(code_of("exports.md", "python").replace("cabin-ir", "tiny"), "exports.md", "exec"), names)  # noqa: S102 - our own page

    names["api"].close()
    assert set(pq.read_table(tmp_path / "runs-0.parquet").column("serial").to_pylist()) == {"VIN-1"}


def test_the_layout_on_the_page_is_one() -> None:
    layout = BlockLayout.model_validate(json.loads(code_of("exports.md", "json")))

    assert (layout.size, layout.crc is not None, len(layout.fields)) == (64, True, 8)
