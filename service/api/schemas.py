"""Writes what is generated from the routes: the OpenAPI document and the TypeScript types of the pages."""

import json
from pathlib import Path

from service.api.application import create_api
from service.api.openapi import openapi_document
from service.api.typescript import generate_typescript

OPENAPI_PATH = Path("docs/openapi.json")
TYPESCRIPT_PATH = Path("web/src/generated/api.ts")


def generated_files() -> dict[Path, str]:
    """Return the generated files' content by their path within the project."""
    document = openapi_document(create_api())
    return {
        OPENAPI_PATH: json.dumps(document, indent=2, ensure_ascii=False) + "\n",
        TYPESCRIPT_PATH: generate_typescript(document),
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
