"""The signing keys as files of one directory: `key-0001.pem`, `key-0002.pem`, …; the last one signs.

Files hold a private key (PKCS 8) or, for keys that shall no longer sign, the public one alone. They are only
ever added. Not here: what keys are used for.
"""

import logging
import os
import re
from pathlib import Path
from tempfile import NamedTemporaryFile

from cryptography.exceptions import UnsupportedAlgorithm
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey, Ed25519PublicKey
from cryptography.hazmat.primitives.serialization import (
    Encoding,
    NoEncryption,
    PrivateFormat,
    load_pem_private_key,
    load_pem_public_key,
)

from service.core.errors import Unavailable

log = logging.getLogger(__name__)

NAME = re.compile(r"key-(\d{4})\.pem")
LARGEST_BYTES = 16_384


def load_signing_keys(directory: Path) -> tuple[Ed25519PrivateKey, list[Ed25519PublicKey]]:
    """Return the key that signs and the public ones of before it, newest first; makes the first of all.

    Raises Unavailable naming the file or directory that cannot be used.
    """
    if not _key_files(directory):
        # By its number: of several that start at once, the others then find this one in their way.
        _add(directory, 1)
    signer, *older = [_read(path) for path in reversed(_key_files(directory))]
    if not isinstance(signer, Ed25519PrivateKey):
        raise Unavailable(
            f"The newest signing key in '{directory}' is a public one, which cannot sign. Add a private one: "
            "`dmscal signing rotate`."
        )
    return signer, [_public(key) for key in older]


def load_public_keys(directory: Path) -> list[Ed25519PublicKey]:
    """Return all public keys, newest first, and none where there are none; makes nothing."""
    return [_public(_read(path)) for path in reversed(_key_files(directory))]


def add_signing_key(directory: Path) -> None:
    """Make a key that signs from the next start on; of two who do so at once, one has an effect."""
    numbers = [int(path.stem[4:]) for path in _key_files(directory)]
    _add(directory, max(numbers, default=0) + 1)


def _add(directory: Path, number: int) -> None:
    content = Ed25519PrivateKey.generate().private_bytes(Encoding.PEM, PrivateFormat.PKCS8, NoEncryption())
    _write_once(directory / f"key-{number:04d}.pem", content)


def _key_files(directory: Path) -> list[Path]:
    try:
        found = list(directory.iterdir()) if directory.is_dir() else []
    except OSError as error:
        raise _unusable(directory, error) from error
    return sorted(path for path in found if NAME.fullmatch(path.name))


def _write_once(path: Path, content: bytes) -> None:
    """Write a whole file that only its owner reads, unless there is one of this name already."""
    try:
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        # Such files are made with mode 0600.
        with NamedTemporaryFile(dir=path.parent, prefix=".new-") as draft:
            draft.write(content)
            draft.flush()
            os.fsync(draft.fileno())
            os.link(draft.name, path)
        descriptor = os.open(path.parent, os.O_RDONLY | os.O_DIRECTORY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
    except FileExistsError:
        log.info("another process has just made %s", path.name)
    except OSError as error:
        raise _unusable(path, error) from error


def _read(path: Path) -> Ed25519PrivateKey | Ed25519PublicKey:
    try:
        content = path.read_bytes()[:LARGEST_BYTES]
        mode = path.stat().st_mode
    except OSError as error:
        raise _unusable(path, error) from error
    if b"PRIVATE" not in content:
        return _check_kind(path, _load_public(path, content))
    if mode & 0o077:
        log.warning(
            "others than its owner may read or change the signing key %s (mode %o)", path, mode & 0o777
        )
    try:
        return _check_kind(path, load_pem_private_key(content, password=None))
    except (ValueError, TypeError, UnsupportedAlgorithm) as error:
        raise Unavailable(f"'{path}' is no private key in PEM without a password.") from error


def _load_public(path: Path, content: bytes) -> object:
    try:
        return load_pem_public_key(content)
    except (ValueError, UnsupportedAlgorithm) as error:
        raise Unavailable(f"'{path}' holds no key in PEM.") from error


def _check_kind(path: Path, key: object) -> Ed25519PrivateKey | Ed25519PublicKey:
    if not isinstance(key, Ed25519PrivateKey | Ed25519PublicKey):
        raise Unavailable(f"'{path}' holds a key of another kind than Ed25519.")
    return key


def _public(key: Ed25519PrivateKey | Ed25519PublicKey) -> Ed25519PublicKey:
    return key.public_key() if isinstance(key, Ed25519PrivateKey) else key


def _unusable(path: Path, error: OSError) -> Unavailable:
    return Unavailable(f"The signing keys at '{path}' cannot be used: {error.strerror}.")
