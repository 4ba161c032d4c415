"""The API's documentation as one page that needs neither script nor network, from the OpenAPI document."""

import html
import json
from collections.abc import Iterator, Mapping
from typing import Any

from fastapi import APIRouter, FastAPI, Request
from fastapi.responses import HTMLResponse, JSONResponse

from service.api.auth import PUBLIC
from service.api.openapi import openapi_document
from service.api.page import page
from service.api.typescript import type_name

router = APIRouter(dependencies=[PUBLIC], include_in_schema=False)

Schema = Mapping[str, Any]


def application(request: Request) -> FastAPI:
    """Return the application that answers."""
    app: FastAPI = request.app
    return app


@router.get("/openapi.json")
def read_openapi(request: Request) -> JSONResponse:
    """Answer the OpenAPI document."""
    return JSONResponse(openapi_document(application(request)))


@router.get("/api/docs")
def read_docs(request: Request) -> HTMLResponse:
    """Answer the documentation."""
    document = openapi_document(application(request))
    return page(f"{document['info']['title']} API {document['info']['version']}", render_docs(document))


def render_docs(document: Schema) -> str:
    """Return the body of the documentation page."""
    parts = [_prose(document["info"]["description"]), "<p><a href='/openapi.json'>openapi.json</a></p>"]
    for tag in document["tags"]:
        parts.append(f"<h2>{html.escape(tag['name'])}</h2><p>{html.escape(tag['description'])}</p>")
        parts.extend(_operations(document, tag["name"]))
    parts.append("<h2>Messages</h2>")
    schemas = document["components"]["schemas"]
    parts.extend(_message(name, schemas[name]) for name in sorted(schemas))
    return "".join(parts)


def _operations(document: Schema, tag: str) -> Iterator[str]:
    for path, operations in document["paths"].items():
        for method, operation in operations.items():
            if tag in operation.get("tags", ()):
                yield _operation(path, method, operation)


def _operation(path: str, method: str, operation: Schema) -> str:
    address = f"<span class=method>{method.upper()}</span> <code>{html.escape(path)}</code>"
    head = f"{address} {html.escape(operation['summary'])}"
    body = _prose(operation.get("description", ""))
    body += _parameters(operation.get("parameters", ()))
    body += _request(operation.get("requestBody"))
    body += "".join(_answer(status, answer) for status, answer in operation["responses"].items())
    return f"<details id='{html.escape(operation['operationId'])}'><summary>{head}</summary>{body}</details>"


def _parameters(parameters: Any) -> str:
    rows = "".join(
        _row(f"{one['name']} ({one['in']})", one["schema"], one.get("description", "")) for one in parameters
    )
    return f"<h3>Parameters</h3><table>{rows}</table>" if rows else ""


def _row(name: str, schema: Schema, description: str) -> str:
    return f"<tr><td><code>{html.escape(name)}</code><td>{_type(schema)}<td>{html.escape(description)}"


def _request(request: Schema | None) -> str:
    if request is None:
        return ""
    text = "<h3>Body</h3>" + _prose(request.get("description", ""))
    for media_type, content in request["content"].items():
        text += f"<p><code>{media_type}</code> {_type(content['schema'])}</p>"
        text += "".join(_example(example) for example in content.get("examples", {}).values())
    return text


def _answer(status: str, answer: Schema) -> str:
    types = ", ".join(
        f"<code>{media_type}</code> {_type(content.get('schema', {}))}"
        for media_type, content in answer.get("content", {}).items()
    )
    name = "Any other" if status == "default" else status
    return f"<h3>{name}</h3><p>{html.escape(answer.get('description', ''))} {types}</p>"


def _message(name: str, schema: Schema) -> str:
    rows = "".join(
        _row(field, part, part.get("description", "")) for field, part in schema.get("properties", {}).items()
    )
    examples = "".join(_example({"value": value}) for value in schema.get("examples", ()))
    values = f"<p>{_type(schema)}</p>" if not rows else f"<table>{rows}</table>"
    head = f"<h3 id='{type_name(name)}'>{type_name(name)}</h3>"
    return head + _prose(schema.get("description", "")) + values + examples


def _example(example: Schema) -> str:
    return f"<pre>{html.escape(json.dumps(example['value'], indent=2, ensure_ascii=False))}</pre>"


def _type(schema: Schema) -> str:
    if "$ref" in schema:
        name = type_name(str(schema["$ref"]).rsplit("/", 1)[-1])
        return f"<a href='#{name}'>{name}</a>"
    if "anyOf" in schema:
        return " or ".join(_type(part) for part in schema["anyOf"])
    if schema.get("type") == "array":
        return f"list of {_type(schema['items'])}" if "items" in schema else "list"
    if "enum" in schema:
        return " | ".join(f"<code>{html.escape(str(value))}</code>" for value in schema["enum"])
    return html.escape(str(schema.get("format") or schema.get("type") or "anything"))


def _prose(text: str) -> str:
    """Return paragraphs; of Markdown only **bold** and `code`, which is all that the descriptions use."""
    return "".join(f"<p>{_inline(block)}</p>" for block in text.strip().split("\n\n") if block.strip())


def _inline(text: str) -> str:
    out = html.escape(" ".join(text.split()), quote=False)
    for mark, tag in (("**", "b"), ("`", "code")):
        pieces = out.split(mark)
        out = "".join(f"<{tag}>{piece}</{tag}>" if i % 2 else piece for i, piece in enumerate(pieces))
    return out
