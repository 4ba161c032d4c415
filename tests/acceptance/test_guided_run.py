"""Lens 1 guided to its verdict by the simulated hand: a real server, killed in mid-run and started again.

Time at the virtual station is compressed: its frames come as fast as they are judged.
"""

import os
import signal
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from service.core.vision.camera import PINHOLE
from service.demo.customer import Customer
from service.demo.server import RunningService, running_service
from service.demo.skus import PAPER_SKUS
from service.demo.virtual_vehicle import nominal_camera
from service.simulator.virtual_station import camera_of_serial
from tests.acceptance.guided_client import STATION, kiosk, set_up_lens1

POSES = 5
SPEED = 1000.0
SERIAL = "VIN-GUIDED-1"


@contextmanager
def customer_of(service: RunningService) -> Iterator[Customer]:
    """A customer whose connections are closed at the end."""
    customer = Customer.of(service.url, service.key)
    with customer.http:
        yield customer


@pytest.mark.timeout(600)
def test_a_guided_run_survives_kill_9_and_ends_in_a_pass_near_the_truth(tmp_path: Path) -> None:
    with running_service(tmp_path, 0, virtual_speed=SPEED) as service, customer_of(service) as customer:
        set_up_lens1(customer, POSES)
        with kiosk(service.url, service.key) as client:
            client.say("open_run", serial=SERIAL, sku="lens1")
            run = client.until("run")
            client.until("capture_accepted")
            accepted = client.until("capture_accepted")["captured"]
            os.kill(service.process.pid, signal.SIGKILL)
        service.process.wait(timeout=30)

    with running_service(tmp_path, 0, virtual_speed=SPEED) as service, customer_of(service) as customer:
        with kiosk(service.url, service.key) as client:
            resumed = client.until("run")
            verdict = client.until("verdict", within_s=400)
        result = customer.ask("GET", f"/runs/{run['run_id']}/result")
        stored = customer.ask("GET", f"/runs/{run['run_id']}")

    assert (resumed["run_id"], resumed["serial"]) == (run["run_id"], SERIAL)
    assert set(accepted) <= set(resumed["captured"])
    assert resumed["pose_index"] not in resumed["captured"]
    assert client.pictures > 10
    assert (verdict["verdict"], stored["state"], stored["captures"]) == ("PASS", "finished", POSES)
    assert stored["station"] == STATION
    truth = camera_of_serial(nominal_camera(PAPER_SKUS[0]), SERIAL).parameters
    for name in PINHOLE:
        error = abs(result["intrinsics"][name] - truth[name])
        assert error < 3.5 * result["sd"][name], name


def test_a_server_that_stops_lets_its_kiosks_go(tmp_path: Path) -> None:
    with running_service(tmp_path, 0) as service, customer_of(service) as customer:
        customer.add_virtual_station(STATION, "Virtual station")
        with kiosk(service.url, service.key):
            service.process.terminate()
            assert isinstance(service.process, subprocess.Popen)
            assert service.process.wait(timeout=30) in {0, -signal.SIGTERM}
