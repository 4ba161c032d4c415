"""Kiosks as a process of their own: each sends half-size raw frames at a fixed rate and times the states.

Speaks the protocol of a browser source over real sockets. A state answers the frame whose number it has; a
frame that a newer one replaced in the service has no answer. Not here: the service, and how many kiosks there
are to be (`kiosks`). Reads its orders as JSON from stdin, writes what it measured as JSON to stdout.
"""

import asyncio
import json
import sys
import time
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from websockets.asyncio.client import ClientConnection, connect

SETTLE_S = 1.0  # before frames count


@dataclass(frozen=True)
class Orders:
    """What the clients are to do. frames: of a .npy file (n, h, w), at half size."""

    url: str
    key: str
    sku: str
    stations: list[str]
    frames: str
    frames_per_s: float
    seconds: float


@dataclass
class Heard:
    """What one kiosk saw: frames that count, and the time from each that was answered to its state, ms."""

    sent: int = 0
    latency_ms: list[float] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)


async def work(orders: Orders) -> list[Heard]:
    """Run all kiosks at once, spread evenly over a frame's time."""
    frames = np.load(Path(orders.frames))
    gap = 1.0 / orders.frames_per_s / len(orders.stations)
    kiosks = [_work_at(orders, code, frames, i * gap) for i, code in enumerate(orders.stations)]
    return list(await asyncio.gather(*kiosks))


async def _work_at(orders: Orders, code: str, frames: NDArray[np.uint8], delay_s: float) -> Heard:
    address = f"{orders.url.replace('http', 'ws', 1)}/ws/v1/stations/{code}/guidance"
    async with connect(address, max_size=None, compression=None) as socket:
        await _say(socket, type="hello", key=orders.key, protocol=1, role="kiosk")
        await _until(socket, "welcome")
        serial = f"BENCH-{code}"
        await _say(socket, type="open_run", serial=serial, sku=orders.sku)
        await _until(socket, "run")
        await _say(socket, type="set_automatic", automatic=False)
        heard, sent_s = Heard(), dict[int, float]()
        listening = asyncio.create_task(_listen(socket, sent_s, heard))
        await asyncio.sleep(delay_s)
        began, number = time.perf_counter(), 0
        while (now := time.perf_counter() - began) < SETTLE_S + orders.seconds:
            number += 1
            message = _frame(frames[(number + len(code)) % len(frames)], number, serial, now)
            if now >= SETTLE_S:
                heard.sent += 1
                sent_s[number] = time.perf_counter()
            await socket.send(message)
            await asyncio.sleep(max(0.0, began + number / orders.frames_per_s - time.perf_counter()))
        await asyncio.sleep(0.5)  # for the last answers
        listening.cancel()
        return heard


async def _listen(socket: ClientConnection, sent_s: dict[int, float], heard: Heard) -> None:
    async for message in socket:
        now = time.perf_counter()
        if isinstance(message, bytes):
            continue
        told = json.loads(message)
        if told["type"] == "problem":
            heard.problems.append(told["code"])
        elif told["type"] == "state" and told["sequence"] in sent_s:
            # A state may be told again, as when the way of capturing changes.
            heard.latency_ms.append(1e3 * (now - sent_s.pop(told["sequence"])))


def _frame(image: NDArray[np.uint8], number: int, serial: str, at_s: float) -> bytes:
    height, width = image.shape
    head = {"type": "frame", "sequence": number, "width": width, "height": height, "scale": 2, "full": False}
    text = json.dumps(head | {"at_ms": 1e3 * at_s, "serial": serial}).encode()
    return len(text).to_bytes(4, "little") + text + image.tobytes()


async def _say(socket: ClientConnection, **message: Any) -> None:
    await socket.send(json.dumps(message))


async def _until(socket: ClientConnection, kind: str) -> None:
    """Wait for a message of a type; raises RuntimeError when a problem comes instead."""
    async for message in socket:
        told = json.loads(message) if isinstance(message, str) else {}
        if told.get("type") == kind:
            return
        if told.get("type") == "problem":
            raise RuntimeError(f"{told['title']}: {told['detail']}")
    raise RuntimeError(f"the service left before it told '{kind}'")


if __name__ == "__main__":
    done = asyncio.run(work(Orders(**json.load(sys.stdin))))
    json.dump([asdict(one) for one in done], sys.stdout)
