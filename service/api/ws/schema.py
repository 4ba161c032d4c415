"""The JSON schema of the guidance socket's messages, from which documents and TypeScript are made."""

from typing import Any

from pydantic import TypeAdapter

from service.api.ws.protocol import PROTOCOL, ClientMessage, FrameHeader, ServerMessage

REFERENCE = "#/$defs/{model}"


def guidance_schema() -> dict[str, Any]:
    """Return one document: every message under `$defs`, and the two unions of what each side sends."""
    received: TypeAdapter[Any] = TypeAdapter(ClientMessage)
    sent: TypeAdapter[Any] = TypeAdapter(ServerMessage)
    parts = [
        received.json_schema(mode="validation", ref_template=REFERENCE),
        sent.json_schema(mode="serialization", ref_template=REFERENCE),
    ]
    header = FrameHeader.model_json_schema(ref_template=REFERENCE)
    found = {name: one for part in parts for name, one in part.pop("$defs").items()}
    unions = {"ClientMessage": parts[0], "ServerMessage": parts[1]}
    definitions = found | unions | {"FrameHeader": header}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": f"dmscal guidance socket, protocol {PROTOCOL}",
        "anyOf": [{"$ref": f"#/$defs/{name}"} for name in ("ClientMessage", "ServerMessage", "FrameHeader")],
        "$defs": {name: definitions[name] for name in sorted(definitions)},
    }
