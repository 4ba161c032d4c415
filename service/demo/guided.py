"""A kiosk of the demo: guides one vehicle at a virtual station over the socket, and prints what it is told.

The hand that moves the board is in the service and reads nothing but the hints. Not here: the REST part.
"""

import json
import sys
import time
from collections.abc import Iterator
from typing import Any

from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

from service.demo.customer import Refused

Json = dict[str, Any]
LONGEST_RUN_S = 300.0  # of a machine that is busy with other things; usually under a minute
SILENCE_S = 60.0
LARGEST_MESSAGE = 32_000_000


def guide_vehicle(url: str, key: str, station: str, serial: str, sku: str) -> Json:
    """Return the verdict's message of a guided run; raises Refused when there is none in time."""
    address = f"ws{url.removeprefix('http')}/ws/v1/stations/{station}/guidance"
    with connect(address, compression=None, max_size=LARGEST_MESSAGE) as socket:
        _say(socket, "hello", key=key, protocol=1, role="kiosk")
        _say(socket, "open_run", serial=serial, sku=sku)
        for message in _heard(socket):
            if message["type"] == "state":
                show_state(message)
            elif message["type"] == "capture_accepted":
                show_capture(message)
            elif message["type"] in {"problem", "capture_refused"}:
                print(f"  {message['title']}: {message['detail']}")
            elif message["type"] == "verdict":
                print(f"  verdict at the kiosk: {message['verdict']}")
                return message
    raise Refused(f"guiding {serial}: no verdict within {LONGEST_RUN_S:g} s")


def show_capture(message: Json) -> None:
    """Print a stored capture in one line."""
    accuracy = message["accuracy"]
    known = "" if accuracy is None else f", sd of fx {accuracy['fx_px']:.2f} px so far"
    _clear_line()
    print(
        f"  capture {len(message['captured']):2d} of {message['total']}: "
        f"{message['match_error_px']:5.1f} px off the wanted pose{known}",
        flush=True,
    )


def show_state(message: Json) -> None:
    """Show the instruction of the moment on a terminal."""
    if sys.stdout.isatty() and message["hints"]:
        bar = "#" * round(20 * message["match"])
        text = f"\r  pose {message['captured'] + 1:2d}  [{bar:20s}]  {message['hints'][0]['code']:24s}"
        print(text, end="", flush=True)


def _heard(socket: ClientConnection) -> Iterator[Json]:
    """Yield what the service tells, with pictures acknowledged and left out."""
    deadline = time.monotonic() + LONGEST_RUN_S
    try:
        while time.monotonic() < deadline:
            message = socket.recv(timeout=SILENCE_S)
            if isinstance(message, str):
                yield json.loads(message)
                continue
            state = json.loads(message[4 : 4 + int.from_bytes(message[:4], "little")])
            _say(socket, "ack", sequence=state["sequence"])
            yield state
    except (ConnectionClosed, TimeoutError) as error:
        raise Refused(f"the guidance socket ended: {error}") from error


def _say(socket: ClientConnection, kind: str, **fields: Any) -> None:
    socket.send(json.dumps({"type": kind, **fields}))


def _clear_line() -> None:
    if sys.stdout.isatty():
        print(f"\r{'':70s}\r", end="")
