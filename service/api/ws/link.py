"""One client of the guidance socket: what is still to be sent to it, and how many pictures are under way.

Messages wait in order; of pictures only the newest waits, and two may be under way until they are
acknowledged. Whoever reads too slowly is let go, so that nobody else waits. Not here: what is told to whom.
"""

import asyncio
import json
from collections import deque
from time import monotonic
from typing import Any, Literal

from starlette.websockets import WebSocket

from service.api.ws.protocol import State
from service.api.ws.run_parts import Told
from service.usecases.access import Caller

IN_FLIGHT = 2
MOST_WAITING = 500
SEND_S = 10.0

Message = str | bytes


class TooSlowError(Exception):
    """The client does not read what is sent to it."""


class Link:
    """A client that said hello; `kiosk` or `monitor`."""

    def __init__(self, socket: WebSocket, role: Literal["kiosk", "monitor"], caller: Caller) -> None:
        self.role, self.caller = role, caller
        self._socket = socket
        self._waiting: deque[Message] = deque()
        self._newest: bytes | None = None
        self._under_way: deque[float] = deque()  # when each picture was sent
        self._round_trip_ms: float | None = None
        self._something = asyncio.Event()
        self._is_too_slow = False

    @property
    def takes_picture(self) -> bool:
        """Whether a picture that is ready now would be sent now."""
        return len(self._under_way) < IN_FLIGHT

    def tell(self, message: Told) -> None:
        """Send a message after those that wait; a picture from before it is dropped."""
        self._newest = None
        self._is_too_slow = self._is_too_slow or len(self._waiting) >= MOST_WAITING
        if not self._is_too_slow:
            self._waiting.append(message.model_dump_json())
        self._something.set()

    def show(self, state: State, jpeg: bytes) -> None:
        """Send what a frame shows, with its picture; one that still waits is replaced."""
        self._newest = pack(state.model_copy(update={"round_trip_ms": self._round_trip_ms}), jpeg)
        self._something.set()

    def acknowledge(self) -> None:
        """A picture was drawn."""
        if self._under_way:
            self._round_trip_ms = 1000.0 * (monotonic() - self._under_way.popleft())
        self._something.set()

    async def send_all(self) -> None:
        """Send whatever comes, until cancelled; raises TooSlowError."""
        while True:
            await self._something.wait()
            self._something.clear()
            while (message := self._next()) is not None:
                try:
                    async with asyncio.timeout(SEND_S):
                        await self._send(message)
                except TimeoutError as error:
                    raise TooSlowError from error
            if self._is_too_slow:
                raise TooSlowError

    def _next(self) -> Message | None:
        if self._waiting:
            return self._waiting.popleft()
        message = self._newest
        if message is None or not self.takes_picture:
            return None
        self._newest = None
        self._under_way.append(monotonic())
        return message

    async def _send(self, message: Message) -> None:
        if isinstance(message, bytes):
            await self._socket.send_bytes(message)
        else:
            await self._socket.send_text(message)


def pack(head: Told, picture: bytes) -> bytes:
    """Return a binary message: the length of the head, the head, the picture."""
    text = head.model_dump_json().encode()
    return len(text).to_bytes(4, "little") + text + picture


def unpack(message: bytes) -> tuple[Any, bytes]:
    """Return head and picture of a binary message; raises ValueError where there is no JSON head."""
    length = int.from_bytes(message[:4], "little")
    if len(message) < 4 or length > len(message) - 4:
        raise ValueError("a binary message begins with the length of its head")
    return json.loads(message[4 : 4 + length]), message[4 + length :]
