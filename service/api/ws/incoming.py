"""What clients send, read and checked; and how a socket ends on what cannot be read.

Not here: what a message leads to.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from fastapi import WebSocket, WebSocketDisconnect
from pydantic import TypeAdapter, ValidationError

from service.api.ws.drivers import BrowserFrame
from service.api.ws.link import unpack
from service.api.ws.protocol import ClientMessage, FrameHeader
from service.core.errors import (
    BadRequest,
    NotAllowed,
    NotAuthenticated,
    NotFound,
    ServiceError,
    TooLarge,
    ValidationFailed,
)
from service.core.guidance.problems import StationHeld
from service.usecases.guide_frames import read_raw

MOST_TEXT = 65_536
# In the order in which they are asked for, as some are kinds of others.
CLOSE_CODES: Sequence[tuple[type[ServiceError], int]] = (
    (NotAuthenticated, 4401),
    (NotAllowed, 4403),
    (NotFound, 4404),
    (StationHeld, 4409),
    (TooLarge, 4413),
    (BadRequest, 4400),
)
TRY_AGAIN_LATER = 1013
READER: TypeAdapter[Any] = TypeAdapter(ClientMessage)


class FarewellError(Exception):
    """Ends a socket: the problem that is told last, and the close code."""

    def __init__(self, error: ServiceError) -> None:
        super().__init__(error.detail)
        self.error = error
        self.code = next((code for kind, code in CLOSE_CODES if isinstance(error, kind)), TRY_AGAIN_LATER)


async def receive(socket: WebSocket, most_bytes: int) -> str | bytes:
    """Return the next message; raises WebSocketDisconnect, FarewellError for one that is too large."""
    message: Mapping[str, Any] = await socket.receive()
    if message["type"] == "websocket.disconnect":
        raise WebSocketDisconnect(message.get("code", 1006))
    text, content = message.get("text"), message.get("bytes")
    if text is not None:
        if len(text) > MOST_TEXT:
            raise FarewellError(TooLarge(f"A text message has at most {MOST_TEXT} characters."))
        return str(text)
    if len(content or b"") > most_bytes:
        raise FarewellError(TooLarge(f"A binary message has at most {most_bytes} bytes."))
    return bytes(content or b"")


def read_message(text: str) -> Any:
    """Return the message of a text.

    Raises FarewellError for what is no message of this protocol, ValidationFailed for one with wrong fields.
    """
    try:
        return READER.validate_json(text)
    except ValidationError as error:
        wrong = error.errors()
        # What is wrong with a field has a place; without one there is no message at all.
        if any(not one["loc"] for one in wrong):
            detail = "This is no message of the guidance protocol, which docs/guidance-protocol.md describes."
            raise FarewellError(BadRequest(detail)) from error
        where = "; ".join(f"{'.'.join(map(str, one['loc'][1:]))}: {one['msg']}" for one in wrong[:5])
        raise ValidationFailed(f"Correct these fields and send again. {where or wrong[0]['msg']}.") from error


def read_frame(content: bytes) -> BrowserFrame:
    """Return the frame of a binary message; raises FarewellError."""
    try:
        head, pixels = unpack(content)
        header = FrameHeader.model_validate(head)
        frame = read_raw(
            pixels,
            (header.width, header.height),
            sequence=header.sequence,
            scale=header.scale,
            at_s=header.at_ms / 1000.0,
        )
    except BadRequest as error:
        raise FarewellError(error) from error
    except (ValueError, RecursionError) as error:
        detail = (
            "A binary message is the length of its head (4 bytes, little-endian), a head `frame`, pixels."
        )
        raise FarewellError(BadRequest(detail)) from error
    return BrowserFrame(frame, header.serial, header.full)


def to_text(message: str | bytes) -> str:
    """Return a message that must be text; raises FarewellError for a binary one."""
    if isinstance(message, bytes):
        raise FarewellError(BadRequest("Only the kiosk of a station with a browser source sends pictures."))
    return message
