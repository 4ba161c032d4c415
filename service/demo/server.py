"""Starts the service as a user does: the command, in a process of its own, on a fresh data directory."""

import os
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import httpx

COMMAND = (sys.executable, "-m", "service")
START_S = 60.0


class ServiceDidNotStart(Exception):
    """The service ended, or did not answer in time; the message holds the end of its log."""


@dataclass(frozen=True)
class RunningService:
    """Where the service listens, the key for it, and its process."""

    url: str
    key: str
    process: "subprocess.Popen[bytes]"


@contextmanager
def running_service(data_dir: Path, port: int, virtual_speed: float = 1.0) -> Iterator[RunningService]:
    """Serve from a data directory until the block ends; port 0 takes a free one.

    virtual_speed: how much faster than real time virtual stations may be.
    """
    port = port or _free_port()
    # The demo is the same on every machine: settings of a real service in this shell must not reach it.
    environment = {name: value for name, value in os.environ.items() if not name.startswith("DMSCAL_")}
    environment |= {
        "DMSCAL_DATA_DIR": str(data_dir),
        "DMSCAL_PORT": str(port),
        "DMSCAL_LOG_LEVEL": "WARNING",
        "DMSCAL_VIRTUAL_SPEED": str(virtual_speed),
    }
    with (data_dir / "service.log").open("wb") as log:
        _run("migrate", environment=environment)
        key = _run("keys", "add", "demo", "--role", "admin", environment=environment).strip().splitlines()[-1]
        process = subprocess.Popen(  # noqa: S603 - our own command
            [*COMMAND, "serve"],
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=subprocess.STDOUT,
        )
        url = f"http://127.0.0.1:{port}"
        try:
            _wait_until_ready(process, url, data_dir / "service.log")
            yield RunningService(url, key, process)
        finally:
            process.terminate()
            process.wait(timeout=30)


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def _run(*arguments: str, environment: dict[str, str]) -> str:
    outcome = subprocess.run(  # noqa: S603 - our own command
        [*COMMAND, *arguments], env=environment, capture_output=True, text=True, check=False
    )
    if outcome.returncode:
        raise ServiceDidNotStart(f"dmscal {arguments[0]}: {outcome.stderr.strip()}")
    return outcome.stdout


def _wait_until_ready(process: "subprocess.Popen[bytes]", url: str, log: Path) -> None:
    deadline = time.monotonic() + START_S
    while process.poll() is None and time.monotonic() < deadline:
        try:
            if httpx.get(f"{url}/readyz").is_success:
                return
        except httpx.TransportError:
            pass
        time.sleep(0.1)
    raise ServiceDidNotStart(f"no answer from {url}\n{log.read_text()[-2000:]}")
