"""The README's first command, as a process: both of the paper's lenses PASS within the promised accuracy, and
so does a vehicle that is guided through the socket."""

import subprocess
import sys

import pytest


@pytest.mark.timeout(400)
def test_the_demo_calibrates_both_lenses_and_guides_a_vehicle_to_a_pass() -> None:
    command = [sys.executable, "-m", "service.demo", "--once", "--seed", "7"]

    outcome = subprocess.run(command, capture_output=True, text=True, check=False)  # noqa: S603 - our own command

    assert outcome.returncode == 0, outcome.stdout[-4000:] + outcome.stderr[-2000:]
    assert outcome.stdout.count("verdict: PASS") == 3
    assert "verdict at the kiosk: PASS" in outcome.stdout
    assert "capture 12 of 12" in outcome.stdout
