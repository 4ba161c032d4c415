"""A camera that speaks RTSP (RFC 2326) and sends JPEG pictures (RFC 2435), all in one TCP connection."""

import struct
import threading
import time
from dataclasses import dataclass
from socketserver import StreamRequestHandler

from tests.streams import CameraServer

PAYLOAD_BYTES = 1400
CLOCK_HZ = 90_000
JPEG_TYPE = 26
MARKER = 0x80
TABLES_FOLLOW = 255
SDP = "v=0\r\no=- 0 0 IN IP4 127.0.0.1\r\ns=camera\r\nt=0 0\r\nm=video 0 RTP/AVP 26\r\na=control:track0\r\n"
DQT, SOF0, SOS = 0xDB, 0xC0, 0xDA


@dataclass(frozen=True)
class Scan:
    """What RFC 2435 sends of a JPEG: size in blocks of 8 px, kind of colours, quantiser tables, its code."""

    width: int
    height: int
    kind: int
    tables: bytes
    code: bytes


def read_scan(jpeg: bytes) -> Scan:
    """The parts of a baseline JPEG of three components."""
    tables: dict[int, bytes] = {}
    width = height = sampling = 0
    at = 2
    while True:
        marker, (length,) = jpeg[at + 1], struct.unpack_from(">H", jpeg, at + 2)
        body = jpeg[at + 4 : at + 2 + length]
        at += 2 + length
        if marker == DQT:
            tables |= {body[i]: body[i + 1 : i + 65] for i in range(0, len(body), 65)}
        elif marker == SOF0:
            height, width = struct.unpack_from(">HH", body, 1)
            sampling = body[7]
        elif marker == SOS:
            kind = 1 if sampling == 0x22 else 0
            return Scan(width // 8, height // 8, kind, tables[0] + tables[1], jpeg[at:-2])


def packets(jpeg: bytes, first: int, timestamp: int) -> list[bytes]:
    """The RTP packets of a picture; the first has the number `first`."""
    scan = read_scan(jpeg)
    found: list[bytes] = []
    for at in range(0, len(scan.code), PAYLOAD_BYTES):
        part = scan.code[at : at + PAYLOAD_BYTES]
        last = MARKER if at + PAYLOAD_BYTES >= len(scan.code) else 0
        number = (first + len(found)) & 0xFFFF
        rtp = struct.pack(">BBHII", 0x80, JPEG_TYPE | last, number, timestamp & 0xFFFFFFFF, 1)
        head = struct.pack(">I4B", at, scan.kind, TABLES_FOLLOW, scan.width, scan.height)
        tables = struct.pack(">BBH", 0, 0, len(scan.tables)) + scan.tables if at == 0 else b""
        found.append(rtp + head + tables + part)
    return found


class RtspHandler(StreamRequestHandler):
    """One client; whatever path it asks for is the stage."""

    server: CameraServer

    def setup(self) -> None:
        super().setup()
        self._sending = threading.Lock()

    def handle(self) -> None:
        player: threading.Thread | None = None
        while (line := self.rfile.readline().decode("latin-1").split()) and (method := line[0]) != "TEARDOWN":
            heads: dict[str, str] = {}
            while head := self.rfile.readline().decode("latin-1").strip():
                name, _, value = head.partition(":")
                heads[name.lower()] = value.strip()
            self._answer(method, heads.get("cseq", "0"))
            if method == "PLAY" and player is None:
                player = threading.Thread(target=self._play, daemon=True)
                player.start()

    def _answer(self, method: str, number: str) -> None:
        body = SDP if method == "DESCRIBE" else ""
        heads = {
            "OPTIONS": "Public: OPTIONS, DESCRIBE, SETUP, PLAY, TEARDOWN\r\n",
            "DESCRIBE": f"Content-Type: application/sdp\r\nContent-Length: {len(body)}\r\n",
            "SETUP": "Transport: RTP/AVP/TCP;unicast;interleaved=0-1\r\nSession: 1\r\n",
        }.get(method, "Session: 1\r\n")
        with self._sending:
            self.wfile.write(f"RTSP/1.0 200 OK\r\nCSeq: {number}\r\n{heads}\r\n{body}".encode())

    def _play(self) -> None:
        sent, began_s = 0, time.monotonic()
        try:
            for jpeg in self.server.frames():
                ticks = round((time.monotonic() - began_s) * CLOCK_HZ)
                parts = packets(jpeg, sent, ticks)
                with self._sending:
                    self.wfile.write(b"".join(b"$\0" + struct.pack(">H", len(one)) + one for one in parts))
                sent += len(parts)
        except (OSError, ValueError):
            # The client has left.
            return
