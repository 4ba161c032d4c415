"""The real service on a free port, in this process, so that a test can take it away and bring it back."""

import socket
import threading
import time
from dataclasses import dataclass, field
from pathlib import Path

import uvicorn

from service.adapters.clock_system import SystemClock
from service.app import create_app, open_database
from service.settings import Settings
from service.storage.words import Role
from service.usecases.access import create_key

START_S = 30.0


@dataclass
class Serving:
    """A service on its own data directory. The key is an administrator's."""

    settings: Settings
    url: str
    key: str
    _server: uvicorn.Server | None = field(default=None, repr=False)
    _thread: threading.Thread | None = field(default=None, repr=False)

    def start(self) -> None:
        """Serve until `stop`; returns when requests are answered."""
        config = uvicorn.Config(
            create_app(self.settings),
            host=self.settings.host,
            port=self.settings.port,
            ws="websockets-sansio",
            ws_per_message_deflate=False,
            log_level="warning",
        )
        self._server = uvicorn.Server(config)
        self._thread = threading.Thread(target=self._server.run, name="service under test")
        self._thread.start()
        deadline = time.monotonic() + START_S
        while not self._server.started:
            if not self._thread.is_alive() or time.monotonic() > deadline:
                raise RuntimeError("the service under test did not start")
            time.sleep(0.02)

    def stop(self) -> None:
        """End the service; its data stays."""
        if self._server is None or self._thread is None:
            return
        self._server.should_exit = True
        # Pages keep connections open and poll over them.
        self._server.force_exit = True
        self._thread.join(timeout=START_S)
        self._server = None


def prepare_service(directory: Path, virtual_speed: float = 1.0) -> Serving:
    """Return a service on a fresh data directory, not yet started."""
    settings = Settings(data_dir=directory).in_directory(directory)
    settings = settings.model_copy(
        update={
            "host": "127.0.0.1",
            "port": _free_port(),
            "shutdown_grace_s": 2.0,
            "virtual_speed": virtual_speed,
        }
    )
    database = open_database(settings)
    with database.write() as session:
        made = create_key(session, "browser test", Role.ADMIN, "browser test", SystemClock().now())
    database.close()
    return Serving(settings, f"http://{settings.host}:{settings.port}", made.key)


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])
