"""Real cameras on the network for tests: a stage with pictures, and servers that stream what is on it."""

import hashlib
import re
import threading
import time
from base64 import b64encode
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache
from http.server import BaseHTTPRequestHandler
from socket import SHUT_RDWR, socket
from socketserver import BaseRequestHandler, ThreadingTCPServer
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from tests.guiding import Client, pixels

FRAME_S = 1 / 40
PATIENCE_S = 60.0
NONCE = "7d1c3f"
Handler = Callable[..., BaseRequestHandler]


@cache
def jpeg_of_pose(index: int) -> bytes:
    """The picture of one of the small plant's poses, as a colour camera compresses it."""
    return to_jpeg(pixels(index))


def to_jpeg(image: NDArray[np.uint8]) -> bytes:
    colour = cv2.cvtColor(image, cv2.COLOR_GRAY2BGR)
    half_colours = [cv2.IMWRITE_JPEG_SAMPLING_FACTOR, cv2.IMWRITE_JPEG_SAMPLING_FACTOR_420]
    return bytes(cv2.imencode(".jpg", colour, [cv2.IMWRITE_JPEG_QUALITY, 95, *half_colours])[1])


@dataclass
class Stage:
    """What stands before the camera, and what is wrong with the camera."""

    jpeg: bytes = field(default_factory=lambda: jpeg_of_pose(0))
    stalls: bool = False

    def show(self, index: int) -> None:
        """Put the board into one of the poses."""
        self.jpeg = jpeg_of_pose(index)

    def obey(self, client: Client, is_it: str) -> dict[str, Any]:
        """Show what is asked for, as a fast and steady operator, until a message of a type comes."""
        until_s = time.monotonic() + PATIENCE_S
        while time.monotonic() < until_s:
            heard = client.hear()
            if heard["type"] == is_it:
                return heard
            if heard["type"] == "state" and heard["pose_index"] is not None:
                self.show(heard["pose_index"])
        raise AssertionError(f"{is_it} was not told within {PATIENCE_S:g} s")


class CameraServer(ThreadingTCPServer):
    """A server whose connections can be cut."""

    allow_reuse_address = True

    def __init__(self, port: int, handler: Handler, stage: Stage) -> None:
        super().__init__(("127.0.0.1", port), handler)
        self.stage = stage
        self.is_on = True
        self._connections: list[socket] = []

    def process_request(self, request: Any, client_address: Any) -> None:
        self._connections.append(request)
        super().process_request(request, client_address)

    def handle_error(self, request: Any, client_address: Any) -> None:
        """A client that left is no error of the camera."""

    def frames(self) -> Iterator[bytes]:
        """What is on the stage, at the camera's rate, as long as it is on."""
        while self.is_on:
            if not self.stage.stalls:
                yield self.stage.jpeg
            time.sleep(FRAME_S)

    def turn_off(self) -> None:
        """Take the camera off the network."""
        self.shutdown()
        self.hang_up()
        self.server_close()

    def hang_up(self) -> None:
        """Cut every connection, for good."""
        self.is_on = False
        for connection in self._connections:
            try:
                connection.shutdown(SHUT_RDWR)
            except OSError:
                continue


class MjpegHandler(BaseHTTPRequestHandler):
    """`/stream`; `/bare` has no lengths and a boundary as some cameras write it; `/locked` has a password."""

    server: CameraServer
    wants = f"Basic {b64encode(b'joe:s3cret').decode()}"

    def log_message(self, format: str, *args: Any) -> None:
        """Say nothing."""

    def do_GET(self) -> None:
        path = self.path.partition("?")[0]
        if path == "/missing":
            self.send_error(404)
        elif path == "/locked" and self.headers.get("Authorization") != self.wants:
            self._ask('Basic realm="camera"')
        elif path == "/digest" and not self._knows_digest():
            self._ask(f'Digest realm="camera", nonce="{NONCE}"')
        elif path == "/still":
            self._head("image/jpeg")
            self.wfile.write(self.server.stage.jpeg)
        else:
            self._stream(has_lengths=path != "/bare")

    def _ask(self, challenge: str) -> None:
        self.send_response(401)
        self.send_header("WWW-Authenticate", challenge)
        self.end_headers()

    def _knows_digest(self) -> bool:
        """Whether the answer to the challenge is that of RFC 2617 without `qop`."""
        said = dict(re.findall(r'(\w+)="([^"]*)"', self.headers.get("Authorization", "")))
        who, what = _md5("joe:camera:s3cret"), _md5("GET:/digest")
        return said.get("response") == _md5(f"{who}:{NONCE}:{what}")

    def _head(self, kind: str) -> None:
        self.send_response(200)
        self.send_header("Content-Type", kind)
        self.end_headers()

    def _stream(self, has_lengths: bool) -> None:
        self._head(f"multipart/x-mixed-replace;boundary={'frame' if has_lengths else '--frame'}")
        for number, jpeg in enumerate(self.server.frames()):
            length = f"Content-Length: {len(jpeg)}\r\n" if has_lengths else ""
            head = f"--frame\r\nContent-Type: image/jpeg\r\n{length}X-Timestamp: {number / 40}\r\n\r\n"
            self.wfile.write(head.encode() + jpeg + b"\r\n")


def _md5(text: str) -> str:
    return hashlib.md5(text.encode(), usedforsecurity=False).hexdigest()


@contextmanager
def camera_on(handler: Handler, stage: Stage, port: int = 0) -> Iterator[CameraServer]:
    """A camera on the network until the block ends."""
    server = CameraServer(port, handler, stage)
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.02})
    thread.start()
    try:
        yield server
    finally:
        server.turn_off()
        thread.join()


def port_of(server: CameraServer) -> int:
    return int(server.server_address[1])
