"""Signing keys on the disk: made once, for their owner alone, added and never lost."""

import stat
from pathlib import Path
from threading import Thread

import pytest
from cryptography.hazmat.primitives.asymmetric.ec import SECP256R1, generate_private_key
from cryptography.hazmat.primitives.serialization import Encoding, NoEncryption, PrivateFormat, PublicFormat

from service.adapters.signing_keys_files import add_signing_key, load_public_keys, load_signing_keys
from service.core.errors import Unavailable


def raw(directory: Path) -> list[bytes]:
    signer, older = load_signing_keys(directory)
    return [key.public_bytes_raw() for key in (signer.public_key(), *older)]


def test_the_first_key_is_made_once_and_for_its_owner_alone(tmp_path: Path) -> None:
    directory = tmp_path / "new" / "keys"
    first = raw(directory)

    assert raw(directory) == first
    assert [path.name for path in directory.iterdir()] == ["key-0001.pem"]
    assert stat.S_IMODE((directory / "key-0001.pem").stat().st_mode) == 0o600
    assert stat.S_IMODE(directory.stat().st_mode) == 0o700


def test_a_new_key_signs_and_the_old_one_stays(tmp_path: Path) -> None:
    (first,) = raw(tmp_path)
    add_signing_key(tmp_path)
    second, *older = raw(tmp_path)

    assert second != first
    assert older == [first]


def test_public_keys_are_read_without_making_any(tmp_path: Path) -> None:
    assert load_public_keys(tmp_path / "none") == []
    assert not (tmp_path / "none").exists()


def test_an_old_key_may_be_kept_as_its_public_half(tmp_path: Path) -> None:
    (first,) = raw(tmp_path)
    signer, _ = load_signing_keys(tmp_path)
    public = signer.public_key().public_bytes(Encoding.PEM, PublicFormat.SubjectPublicKeyInfo)
    (tmp_path / "key-0001.pem").write_bytes(public)

    with pytest.raises(Unavailable, match="signing rotate"):
        load_signing_keys(tmp_path)
    add_signing_key(tmp_path)

    assert raw(tmp_path)[1] == first


def test_many_that_start_at_once_make_one_key(tmp_path: Path) -> None:
    found: list[bytes] = []
    threads = [Thread(target=lambda: found.extend(raw(tmp_path / "keys"))) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()

    assert len(found) == 8
    assert len(set(found)) == 1


def test_a_key_that_others_may_read_is_warned_about(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    raw(tmp_path)
    (tmp_path / "key-0001.pem").chmod(0o644)
    raw(tmp_path)

    assert "key-0001.pem" in caplog.text


@pytest.mark.parametrize("content", [b"", b"junk", b"-----BEGIN PRIVATE KEY-----\njunk\n"])
def test_what_is_no_key_is_named(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "key-0001.pem").write_bytes(content)

    with pytest.raises(Unavailable, match=r"key-0001\.pem"):
        load_signing_keys(tmp_path)


def test_a_key_of_another_kind_is_named(tmp_path: Path) -> None:
    other = generate_private_key(SECP256R1()).private_bytes(Encoding.PEM, PrivateFormat.PKCS8, NoEncryption())
    (tmp_path / "key-0001.pem").write_bytes(other)

    with pytest.raises(Unavailable, match="another kind"):
        load_signing_keys(tmp_path)


def test_a_place_that_cannot_be_used_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").touch()

    with pytest.raises(Unavailable, match="file"):
        load_signing_keys(tmp_path / "file" / "keys")
