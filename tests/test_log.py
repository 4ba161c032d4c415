"""Log lines: one a line, in UTC, with the ids they belong to."""

import json
import logging
import re
import subprocess
import sys

import pytest

from service.log import JsonFormatter, TextFormatter, logged_with


def record(message: str, *arguments: object) -> logging.LogRecord:
    return logging.LogRecord("service.app", logging.INFO, __file__, 1, message, arguments, None)


def failed_record() -> logging.LogRecord:
    try:
        raise ValueError("first\nsecond")
    except ValueError:
        return logging.LogRecord("service.app", logging.ERROR, __file__, 1, "crashed", (), sys.exc_info())


def test_a_line_has_its_time_in_utc_and_the_ids_of_its_block() -> None:
    with logged_with(run="r1", station=None), logged_with(trace="t1"):
        line = TextFormatter().format(record("captured %d", 3))

    assert re.fullmatch(
        r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z INFO service\.app captured 3 run=r1 trace=t1", line
    )


def test_ids_end_with_their_block() -> None:
    with logged_with(run="r1"):
        pass

    assert "run=" not in TextFormatter().format(record("later"))


@pytest.mark.parametrize("formatter", [TextFormatter(), JsonFormatter()], ids=["text", "json"])
def test_whatever_is_logged_stays_on_one_line(formatter: logging.Formatter) -> None:
    forged = formatter.format(record("serial %s", "A\n2026-01-01T00:00:00.000Z INFO service.app PASS"))
    crashed = formatter.format(failed_record())

    assert "\n" not in forged + crashed
    assert "ValueError: first" in crashed


def test_json_lines_are_json() -> None:
    with logged_with(run="r1"):
        line = json.loads(JsonFormatter().format(record("captured")))

    assert line["time"].endswith("Z")
    assert (line["level"], line["message"], line["run"]) == ("INFO", "captured", "r1")


def test_a_process_logs_in_the_chosen_form_and_from_the_chosen_level() -> None:
    said = (
        "import logging; from service.log import configure_logging; configure_logging('INFO', 'json');"
        "logging.getLogger('service').debug('hidden'); logging.getLogger('service').info('shown');"
        "logging.getLogger('sqlalchemy.engine').info('hidden')"
    )

    outcome = subprocess.run([sys.executable, "-c", said], capture_output=True, text=True, check=True)  # noqa: S603 - our own command

    assert [json.loads(line)["message"] for line in outcome.stderr.splitlines()] == ["shown"]
