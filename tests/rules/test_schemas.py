"""What is generated from the routes is checked in as it is generated, and says what an integrator needs."""

import json
import re
from pathlib import Path
from typing import Any

import pytest

from service.api.application import create_api
from service.api.openapi import TAGS, openapi_document
from service.api.schemas import generated_files, write_schemas

ROOT = Path(__file__).resolve().parents[2]
DOCUMENT = openapi_document(create_api())
OPERATIONS = [
    (f"{method.upper()} {path}", operation)
    for path, operations in DOCUMENT["paths"].items()
    for method, operation in operations.items()
]
IDS = [name for name, _ in OPERATIONS]


@pytest.mark.parametrize("path", generated_files(), ids=str)
def test_a_generated_file_is_current(path: Path) -> None:
    expected = generated_files()[path]

    assert (ROOT / path).read_text() == expected, "run `make schemas` and commit the result"


def test_writing_again_changes_nothing(tmp_path: Path) -> None:
    assert sorted(write_schemas(tmp_path)) == sorted(generated_files())
    assert write_schemas(tmp_path) == []


@pytest.mark.parametrize(("name", "operation"), OPERATIONS, ids=IDS)
def test_an_operation_says_what_it_does_and_how_it_fails(name: str, operation: dict[str, Any]) -> None:
    assert operation["summary"], name
    assert len(operation["description"]) > 20, name
    assert operation["tags"][0] in {tag["name"] for tag in TAGS}, name
    assert operation["responses"]["default"]["content"].keys() == {"application/problem+json"}, name


@pytest.mark.parametrize(("name", "operation"), OPERATIONS, ids=IDS)
def test_a_json_body_has_an_example(name: str, operation: dict[str, Any]) -> None:
    content = operation.get("requestBody", {}).get("content", {}).get("application/json")
    if content is not None:
        reference = content["schema"].get("$ref", "").rsplit("/", 1)[-1]
        schema = DOCUMENT["components"]["schemas"].get(reference, content["schema"])
        assert schema.get("examples") or content.get("examples"), name


def test_every_reference_leads_somewhere() -> None:
    named = set(re.findall(r'"#/components/schemas/([^"]+)"', json.dumps(DOCUMENT)))

    assert named == set(DOCUMENT["components"]["schemas"])
