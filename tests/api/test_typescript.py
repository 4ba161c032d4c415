from typing import Any

import pytest

from service.api.typescript import generate_typescript, type_name


def declared(schema: dict[str, Any], name: str = "Thing") -> str:
    """The declaration of one schema, without the header."""
    return generate_typescript({"components": {"schemas": {name: schema}}}).split("\n\n", 1)[1].strip()


@pytest.mark.parametrize(
    ("schema", "expected"),
    [
        ({"type": "string", "format": "date-time"}, "string"),
        ({"type": "integer"}, "number"),
        ({"anyOf": [{"type": "number"}, {"type": "null"}]}, "number | null"),
        ({"enum": ["a", "b"]}, '"a" | "b"'),
        ({"const": "x"}, '"x"'),
        ({"$ref": "#/components/schemas/Page_Run_"}, "PageRun"),
        ({"type": "array", "items": {"type": "string"}}, "string[]"),
        ({"type": "array", "items": {"enum": ["a", "b"]}}, '("a" | "b")[]'),
        ({"type": "array", "prefixItems": [{"type": "number"}, {"type": "string"}]}, "[number, string]"),
        ({"type": "object", "additionalProperties": {"type": "number"}}, "Record<string, number>"),
        ({"type": "object"}, "Record<string, unknown>"),
        ({}, "unknown"),
    ],
)
def test_a_schema_becomes_the_type_of_its_values(schema: dict[str, Any], expected: str) -> None:
    assert declared(schema) == f"export type Thing = {expected};"


def test_an_object_becomes_an_interface_whose_optional_fields_are_marked() -> None:
    schema = {
        "description": "A thing.",
        "properties": {"id": {"type": "string"}, "n": {"type": "integer", "description": "How many."}},
        "required": ["id"],
    }

    assert declared(schema).splitlines() == [
        "/** A thing. */",
        "export interface Thing {",
        "  id: string;",
        "  /** How many. */",
        "  n?: number;",
        "}",
    ]


def test_a_description_cannot_end_its_comment() -> None:
    assert "*/ alert" not in declared({"type": "string", "description": "x */ alert()"})


def test_names_are_those_of_typescript() -> None:
    assert [type_name(n) for n in ("Page_RunSummary_", "Sku-Input", "Run")] == [
        "PageRunSummary",
        "SkuInput",
        "Run",
    ]
