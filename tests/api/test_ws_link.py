"""What waits for a client: messages in order, of pictures only the newest, and two of them under way."""

import asyncio
import json
from collections.abc import Iterator
from contextlib import suppress
from typing import Any
from uuid import UUID

import pytest
from starlette.websockets import WebSocket

from service.api.ws import link as links
from service.api.ws.link import Link, TooSlowError, pack, unpack
from service.api.ws.protocol import RunClosed, State, WantFullFrame
from service.storage.words import Role
from service.usecases.access import Caller

RUNNERS: list[asyncio.Runner] = []
CALLER = Caller(UUID(int=1), "test", Role.OPERATOR)


def state(sequence: int) -> State:
    return State(
        sequence=sequence,
        at_ms=0.0,
        run_id=UUID(int=2),
        board="absent",
        seen=None,
        ghost=None,
        difference=None,
        hints=[],
        match=0.0,
        dwell=0.0,
        pose_index=0,
        captured=0,
        total=1,
        automatic=True,
        is_capturing=False,
        accuracy=None,
    )


@pytest.fixture(autouse=True)
def loop() -> Iterator[None]:
    """One event loop for everything that a test does with a link."""
    with asyncio.Runner() as runner:
        RUNNERS.append(runner)
        yield
        RUNNERS.clear()


def sent(link: Link, messages: list[Any], seconds: float = 0.05) -> list[Any]:
    """What a client was sent within a moment: types of texts, sequences of pictures."""

    async def wait() -> None:
        with suppress(TimeoutError):
            async with asyncio.timeout(seconds):
                await link.send_all()

    RUNNERS[-1].run(wait())
    return [
        unpack(one["bytes"])[0]["sequence"] if "bytes" in one else json.loads(one["text"])["type"]
        for one in messages
    ]


def a_link() -> tuple[Link, list[Any]]:
    messages: list[Any] = []

    async def send(message: Any) -> None:
        messages.append(message)

    async def receive() -> Any:
        return {"type": "websocket.connect"}

    socket = WebSocket({"type": "websocket"}, receive, send)
    RUNNERS[-1].run(socket.accept())
    messages.clear()
    return Link(socket, "kiosk", CALLER), messages


def test_only_the_newest_picture_waits() -> None:
    link, messages = a_link()
    for sequence in range(5):
        link.show(state(sequence), b"jpeg")

    assert sent(link, messages) == [4]


def test_two_pictures_are_under_way_until_one_is_acknowledged() -> None:
    link, messages = a_link()
    for sequence in range(3):
        link.show(state(sequence), b"jpeg")
        sent(link, messages)
    assert sent(link, messages) == [0, 1]
    assert not link.takes_picture

    link.acknowledge()

    assert sent(link, messages) == [0, 1, 2]


def test_messages_keep_their_order_and_come_before_pictures() -> None:
    link, messages = a_link()
    link.tell(WantFullFrame(sequence=1))
    link.tell(RunClosed(run_id=UUID(int=2), reason="aborted"))
    link.show(state(7), b"jpeg")

    assert sent(link, messages) == ["want_full_frame", "run_closed", 7]


def test_a_picture_from_before_a_message_is_dropped() -> None:
    link, messages = a_link()
    link.show(state(1), b"jpeg")
    link.tell(WantFullFrame(sequence=1))

    assert sent(link, messages) == ["want_full_frame"]


def test_whoever_reads_nothing_is_let_go(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(links, "MOST_WAITING", 3)
    link, messages = a_link()
    for _ in range(5):
        link.tell(WantFullFrame(sequence=1))

    with pytest.raises(TooSlowError):
        sent(link, messages)


def test_a_binary_message_is_read_as_it_was_packed() -> None:
    head, picture = unpack(pack(WantFullFrame(sequence=9), b"\x00\x01"))

    assert (head["sequence"], picture) == (9, b"\x00\x01")


@pytest.mark.parametrize("message", [b"", b"\x01", b"\xff\xff\xff\xff{}", b"\x02\x00\x00\x00{"])
def test_a_binary_message_without_a_head_is_refused(message: bytes) -> None:
    with pytest.raises(ValueError, match=r"length|Expecting|JSON|delimiter"):
        unpack(message)
