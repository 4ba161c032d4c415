"""Writes what is generated from routes and messages: the OpenAPI document, the guidance socket's schema, and
the TypeScript types of the pages."""

import json
from pathlib import Path
from typing import Any

from service.api.application import create_api
from service.api.openapi import openapi_document
from service.api.typescript import generate_declarations, generate_typescript
from service.api.ws.schema import guidance_schema

OPENAPI_PATH = Path("docs/openapi.json")
TYPESCRIPT_PATH = Path("web/src/generated/api.ts")
GUIDANCE_PATH = Path("docs/guidance.schema.json")
PROTOCOL_PATH = Path("web/src/generated/protocol.ts")


def generated_files() -> dict[Path, str]:
    """Return the generated files' content by their path within the project."""
    document = openapi_document(create_api())
    guidance = guidance_schema()
    return {
        OPENAPI_PATH: _to_json(document),
        TYPESCRIPT_PATH: generate_typescript(document),
        GUIDANCE_PATH: _to_json(guidance),
        PROTOCOL_PATH: generate_declarations(guidance["$defs"], "the messages of the guidance socket"),
    }


def write_schemas(project: Path) -> list[Path]:
    """Write the generated files into a checkout and return the paths of those that changed."""
    changed = []
    for path, content in generated_files().items():
        file = project / path
        if not file.is_file() or file.read_text(encoding="utf-8") != content:
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(content, encoding="utf-8")
            changed.append(path)
    return changed


def _to_json(document: dict[str, Any]) -> str:
    return json.dumps(document, indent=2, ensure_ascii=False) + "\n"
