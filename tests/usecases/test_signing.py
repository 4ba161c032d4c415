"""Signatures: only what a known key has signed, to the last byte, is believed."""

import base64
import hashlib
import hmac
import json
from typing import Any

import pytest
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey, Ed25519PublicKey

from service.usecases.result_problems import CertificateRefused, KeySetUnreadable
from service.usecases.signing import KeyRing, key_set, read_key_set, sign, thumbprint, verify

KIND = "a-kind"
# The key of RFC 8037, appendix A.
RFC_SEED = base64.urlsafe_b64decode("nWGxne_9WmC6hEr0kuwsxERJxWl7MmkZcDusAxyuf2A=")
RFC_THUMBPRINT = "kPrK_qmxVWaYVA9wwBF6Iuo3vVzz7TxHCTwXBygrS4k"


def ring(seed: int, *older: int) -> KeyRing:
    keys = [Ed25519PrivateKey.from_private_bytes(bytes([number]) * 32) for number in (seed, *older)]
    return KeyRing.of(keys[0], [key.public_key() for key in keys[1:]])


def encode(content: bytes) -> bytes:
    return base64.urlsafe_b64encode(content).rstrip(b"=")


def header(**members: Any) -> bytes:
    return encode(json.dumps(members).encode())


def reason(token: bytes, keys: dict[str, Ed25519PublicKey]) -> object:
    with pytest.raises(CertificateRefused) as refused:
        verify(token, [KIND], keys)
    return refused.value.facts["reason"]


def test_a_key_is_named_by_its_thumbprint() -> None:
    key = Ed25519PrivateKey.from_private_bytes(RFC_SEED)

    assert thumbprint(key.public_key()) == RFC_THUMBPRINT


def test_what_was_signed_is_verified_by_the_published_keys_and_always_the_same() -> None:
    keys = ring(1)
    token = sign(b"{}", KIND, keys)

    published = read_key_set(json.dumps(key_set(keys)).encode())

    assert verify(token.encode(), [KIND], published) == (b"{}", keys.key_id)
    assert sign(b"{}", KIND, keys) == token


def test_a_key_that_signs_no_more_still_verifies() -> None:
    token = sign(b"{}", KIND, ring(1)).encode()
    rotated = ring(2, 1)

    assert verify(token, [KIND], rotated.public)[0] == b"{}"
    assert list(rotated.public) == [rotated.key_id, ring(1).key_id]


def test_every_changed_byte_is_refused() -> None:
    keys = ring(1)
    token = sign(b'{"verdict":"FAIL"}', KIND, keys).encode()

    for place in range(len(token)):
        for other in (b"A", b"B", b"."):
            changed = token[:place] + other + token[place + 1 :]
            if changed != token:
                assert reason(changed, dict(keys.public))


def test_another_spelling_of_the_same_signature_is_refused() -> None:
    keys = ring(1)
    token = sign(b"{}", KIND, keys).encode()
    alphabet = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"
    spelt = token[:-1] + bytes([alphabet[alphabet.index(token[-1]) ^ 1]])

    assert base64.urlsafe_b64decode(spelt.split(b".")[2] + b"==") == base64.urlsafe_b64decode(
        token.split(b".")[2] + b"=="
    )
    assert reason(spelt, dict(keys.public)) == "form"


def test_no_header_chooses_another_algorithm() -> None:
    keys = ring(1)
    _, payload, _ = sign(b"{}", KIND, keys).encode().split(b".")
    public = keys.public[keys.key_id].public_bytes_raw()
    for algorithm in ("none", "None", "HS256", "ES256", "Ed448", None):
        start = header(alg=algorithm, kid=keys.key_id, typ=KIND) + b"." + payload
        by_public_key = hmac.new(public, start, hashlib.sha256).digest()

        assert reason(start + b".", dict(keys.public)) == "algorithm"
        assert reason(start + b"." + encode(by_public_key), dict(keys.public)) == "algorithm"


@pytest.mark.parametrize(
    ("members", "why"),
    [
        ({"alg": "EdDSA", "kid": "unknown", "typ": KIND}, "key-unknown"),
        ({"alg": "EdDSA", "kid": "unknown", "typ": "another"}, "header"),
        ({"alg": "EdDSA", "kid": 1, "typ": KIND}, "header"),
        ({"alg": "EdDSA", "kid": "k", "typ": KIND, "jwk": {}}, "header"),
        ({"alg": "EdDSA", "kid": "k", "typ": KIND, "crit": ["b64"]}, "header"),
        ({"alg": "EdDSA"}, "header"),
    ],
)
def test_a_header_says_exactly_what_it_must(members: dict[str, Any], why: str) -> None:
    token = header(**members) + b".e30." + encode(bytes(64))

    assert reason(token, dict(ring(1).public)) == why


@pytest.mark.parametrize(
    "token",
    [b"", b"..", b"a.b", b"!.e30.AA", b"e30=.e30.AA", b"bnVsbA.e30.AA", b"\xff.\xff.\xff", b"W10.e30.AA"],
)
def test_what_is_no_signed_document_is_refused(token: bytes) -> None:
    assert reason(token, dict(ring(1).public)) in {"form", "algorithm"}


@pytest.mark.parametrize(
    "content",
    [b"", b"[]", b"{}", b'{"keys": 1}', b'{"keys": []}', b'{"keys": [{"kty": "RSA"}]}', b"\xff",
     b"[" * 100_000, b'{"keys": [{"kty": "OKP", "crv": "Ed25519", "x": "AA"}]}', b'{"keys": ["x"]}'],
)  # fmt: skip
def test_what_is_no_key_set_is_refused(content: bytes) -> None:
    with pytest.raises(KeySetUnreadable):
        read_key_set(content)


def test_a_published_id_is_not_believed() -> None:
    """A key set that gives a key another's id lets it verify nothing in that one's name."""
    honest, liar = ring(1), ring(2)
    published = key_set(liar)
    published["keys"][0]["kid"] = honest.key_id

    found = read_key_set(json.dumps(published).encode())

    assert list(found) == [liar.key_id]
