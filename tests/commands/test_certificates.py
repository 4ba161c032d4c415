"""`dmscal verify` and `dmscal signing`: what they print, and with which exit status."""

import http.server
import json
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from uuid import UUID

import pytest

from service.adapters.signing_keys_files import load_signing_keys
from service.cli import main
from service.core.quality.gates import Verdict
from service.usecases.canonical_json import canonical_json
from service.usecases.certificate import EXTRINSICS_KIND, KIND, certificate_content
from service.usecases.later_certificate import later_content
from service.usecases.later_extrinsics_views import LaterExtrinsicsView
from service.usecases.observation import pose_to_json
from service.usecases.signing import KeyRing, key_set, sign
from tests.fakes import START
from tests.finished import PLACE, finished_run

Printed = pytest.CaptureFixture[str]


def run(*arguments: object) -> int:
    return main([str(argument) for argument in arguments])


@pytest.fixture
def keys(tmp_path: Path) -> KeyRing:
    signer, older = load_signing_keys(tmp_path / "signing-keys")
    return KeyRing.of(signer, older)


@pytest.fixture
def jwks(tmp_path: Path, keys: KeyRing) -> Path:
    path = tmp_path / "jwks.json"
    path.write_text(json.dumps(key_set(keys)))
    return path


def issue(directory: Path, keys: KeyRing, verdict: Verdict = Verdict.PASS, **changes: Any) -> Path:
    content = certificate_content(finished_run(verdict=verdict), START) | changes
    path = directory / "certificate.jws"
    path.write_text(sign(canonical_json(content), KIND, keys))
    return path


def test_a_genuine_certificate_is_told_with_whose_it_is_and_by_which_key(
    tmp_path: Path, keys: KeyRing, jwks: Path, capsys: Printed
) -> None:
    assert run("verify", issue(tmp_path, keys), "--jwks", jwks) == 0
    printed = capsys.readouterr().out

    assert printed.startswith("PASS ")
    for said in ("VIN-0001", "lens1, revision 3", "line1-cal2", "2026-03-01T06:01:00.000005Z", keys.key_id):
        assert said in printed


def test_the_certificate_of_a_place_in_the_vehicle_is_checked_like_any_other(
    tmp_path: Path, keys: KeyRing, jwks: Path, capsys: Printed
) -> None:
    measured = LaterExtrinsicsView(
        id=UUID(int=9),
        run_id=UUID(int=1),
        serial="VIN-0001",
        station="place1",
        verdict=Verdict.MARGINAL,
        extrinsics={"pose": pose_to_json(PLACE.pose), "covariance": [], "fixture": {}},
        gates=[],
        pictures=[],
        versions={},
        created_at=START,
        created_by="robot",
    )
    content = later_content(finished_run(), measured, START)
    path = tmp_path / "place.jws"
    path.write_text(sign(canonical_json(content), EXTRINSICS_KIND, keys))

    assert run("verify", path, "--jwks", jwks) == 0

    printed = capsys.readouterr().out
    assert printed.startswith("MARGINAL ")
    for said in ("place in the vehicle", "place1", "at 1.42, -0.36, 0.98 m", "VIN-0001"):
        assert said in printed


def test_a_fail_is_genuine_and_says_fail_plainly(
    tmp_path: Path, keys: KeyRing, jwks: Path, capsys: Printed
) -> None:
    path = issue(tmp_path, keys, Verdict.FAIL)

    assert run("verify", path, "--jwks", jwks) == 0
    printed = capsys.readouterr().out
    assert printed.startswith("FAIL ")
    assert "FAILED. Do not use it." in printed
    assert "failed    rms_px" in printed
    assert "PASS" not in printed
    assert run("verify", path, "--jwks", jwks, "--json") == 0
    document = json.loads(capsys.readouterr().out)
    assert (document["certificate"]["verdict"], document["key_id"]) == ("FAIL", keys.key_id)


def test_a_changed_certificate_is_refused(tmp_path: Path, keys: KeyRing, jwks: Path, capsys: Printed) -> None:
    path = issue(tmp_path, keys)
    token = path.read_text()
    changed = "A" if token[200] != "A" else "B"
    path.write_text(f"{token[:200]}{changed}{token[201:]}")

    assert run("verify", path, "--jwks", jwks) == 1
    printed = capsys.readouterr()
    assert printed.out == ""
    assert "changed after it was signed" in printed.err
    assert run("verify", path, "--jwks", jwks, "--json") == 1
    assert json.loads(capsys.readouterr().out)["code"] == "certificate-refused"


def test_another_services_certificate_is_refused(tmp_path: Path, jwks: Path, capsys: Printed) -> None:
    other = KeyRing.of(load_signing_keys(tmp_path / "other")[0])

    assert run("verify", issue(tmp_path, other), "--jwks", jwks) == 1
    assert other.key_id in capsys.readouterr().err


def test_a_certificate_of_another_version_is_refused(tmp_path: Path, keys: KeyRing, jwks: Path) -> None:
    assert run("verify", issue(tmp_path, keys, format_version=2), "--jwks", jwks) == 1


def test_a_line_end_behind_the_certificate_is_no_change(tmp_path: Path, keys: KeyRing, jwks: Path) -> None:
    path = issue(tmp_path, keys)
    path.write_text(path.read_text() + "\r\n")

    assert run("verify", path, "--jwks", jwks) == 0


def test_on_the_service_itself_its_own_keys_are_taken(tmp_path: Path, keys: KeyRing, capsys: Printed) -> None:
    path = issue(tmp_path, keys)

    assert run("verify", path, "--data-dir", tmp_path) == 0
    assert run("signing", "rotate", "--data-dir", tmp_path) == 0
    assert run("verify", path, "--data-dir", tmp_path) == 0
    assert run("verify", path, "--data-dir", tmp_path / "none") == 2
    assert "--jwks" in capsys.readouterr().err
    assert not (tmp_path / "none").exists()


@pytest.mark.parametrize("content", [None, b"", b"{}", b"\xff\xfe", b'{"keys": []}'])
def test_keys_that_cannot_be_read_are_bad_input(
    tmp_path: Path, keys: KeyRing, content: bytes | None, capsys: Printed
) -> None:
    path = tmp_path / "keys.json"
    if content is not None:
        path.write_bytes(content)

    assert run("verify", issue(tmp_path, keys), "--jwks", path) == 2
    assert capsys.readouterr().err.startswith("dmscal: ")


def test_a_certificate_that_is_not_there_is_bad_input(tmp_path: Path, jwks: Path, capsys: Printed) -> None:
    assert run("verify", tmp_path / "none.jws", "--jwks", jwks) == 2
    assert "none.jws" in capsys.readouterr().err


@contextmanager
def served(content: bytes, status: int = 200) -> Iterator[str]:
    """The address of a server that answers everything with this."""

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self.send_response(status)
            self.end_headers()
            self.wfile.write(content)

        def log_message(self, *_: object) -> None:
            pass

    server = http.server.HTTPServer(("127.0.0.1", 0), Handler)
    thread = threading.Thread(target=server.serve_forever)
    thread.start()
    yield f"http://127.0.0.1:{server.server_port}/.well-known/jwks.json"
    server.shutdown()
    thread.join()
    server.server_close()


def test_keys_may_be_asked_for_at_an_address(tmp_path: Path, keys: KeyRing, jwks: Path) -> None:
    path = issue(tmp_path, keys)

    with served(jwks.read_bytes()) as address:
        assert run("verify", path, "--jwks", address) == 0
    with served(b"gone", 404) as address:
        assert run("verify", path, "--jwks", address) == 2
    with served(b" " * 1_000_001) as address:
        assert run("verify", path, "--jwks", address) == 2
    assert run("verify", path, "--jwks", address) == 2
    assert run("verify", path, "--jwks", "http://") == 2


def test_the_keys_are_shown_and_rotated(tmp_path: Path, capsys: Printed) -> None:
    assert run("signing", "jwks", "--data-dir", tmp_path) == 0
    (first,) = json.loads(capsys.readouterr().out)["keys"]
    assert run("signing", "rotate", "--data-dir", tmp_path) == 0
    said = capsys.readouterr().out
    assert run("signing", "jwks", "--data-dir", tmp_path) == 0
    second, older = json.loads(capsys.readouterr().out)["keys"]

    assert older == first
    assert second["kid"] in said
    assert "d" not in second
