"""Signing keys and signed documents: Ed25519 signatures as compact JWS (RFC 7515, RFC 8037).

Keys are named by their thumbprint (RFC 7638), which is computed here and never believed. Only one algorithm
is known, so that no header can choose a weaker one. Not here: where keys are kept (an adapter) and what is
signed.
"""

import base64
import binascii
import hashlib
import json
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final, Self

from cryptography.exceptions import InvalidSignature
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey, Ed25519PublicKey

from service.usecases.canonical_json import canonical_json
from service.usecases.result_problems import CertificateRefused, KeySetUnreadable

JsonObject = dict[str, Any]

ALGORITHM: Final = "EdDSA"
HEADER_NAMES: Final = {"alg", "kid", "typ"}
KEY_BYTES: Final = 32


@dataclass(frozen=True)
class KeyRing:
    """The key that signs, and the public keys that verify by their ids, the signing one's first."""

    signer: Ed25519PrivateKey
    public: Mapping[str, Ed25519PublicKey]

    @classmethod
    def of(cls, signer: Ed25519PrivateKey, older: Sequence[Ed25519PublicKey] = ()) -> Self:
        """Return the ring of a signing key and of those that signed before it, newest first."""
        keys = [signer.public_key(), *older]
        return cls(signer, {thumbprint(key): key for key in keys})

    @property
    def key_id(self) -> str:
        """The id of the key that signs."""
        return thumbprint(self.signer.public_key())


def thumbprint(key: Ed25519PublicKey) -> str:
    """Return the id of a key: SHA-256 of its required members as canonical JSON (RFC 7638), base64url."""
    members = {"crv": "Ed25519", "kty": "OKP", "x": _encode(key.public_bytes_raw())}
    return _encode(hashlib.sha256(canonical_json(members)).digest())


def key_set(keys: KeyRing) -> JsonObject:
    """Return the public keys as a JSON Web Key Set (RFC 7517)."""
    return {
        "keys": [
            {
                "kty": "OKP",
                "crv": "Ed25519",
                "x": _encode(key.public_bytes_raw()),
                "kid": key_id,
                "alg": ALGORITHM,
                "use": "sig",
            }
            for key_id, key in keys.public.items()
        ]
    }


def read_key_set(content: bytes) -> dict[str, Ed25519PublicKey]:
    """Return the Ed25519 keys of a key set by their ids; keys of other kinds are passed over.

    Raises KeySetUnreadable for what is no key set and for one without such a key.
    """
    try:
        document = json.loads(content)
        found = [key for key in document["keys"] if (key["kty"], key.get("crv")) == ("OKP", "Ed25519")]
        public = [Ed25519PublicKey.from_public_bytes(_decode(key["x"])) for key in found]
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        raise KeySetUnreadable(
            "This is no JSON Web Key Set. Save the service's /.well-known/jwks.json as it is."
        ) from error
    if not public:
        raise KeySetUnreadable("The key set holds no Ed25519 key. Save the service's /.well-known/jwks.json.")
    return {thumbprint(key): key for key in public}


def sign(payload: bytes, kind: str, keys: KeyRing) -> str:
    """Return a payload signed as compact JWS; `kind` goes into the header, where `verify` looks for it."""
    header = canonical_json({"alg": ALGORITHM, "kid": keys.key_id, "typ": kind})
    signed = f"{_encode(header)}.{_encode(payload)}"
    return f"{signed}.{_encode(keys.signer.sign(signed.encode('ascii')))}"


def verify(token: bytes, kinds: Collection[str], keys: Mapping[str, Ed25519PublicKey]) -> tuple[bytes, str]:
    """Return the payload of a signed document of one of the kinds and the id of the key that signed it.

    Raises CertificateRefused, naming why, for everything that is not exactly what one of the keys has signed.
    """
    parts = token.split(b".")
    if len(parts) != 3:
        raise CertificateRefused(
            "This is no certificate: it is not three parts with dots between.", reason="form"
        )
    try:
        header_text, payload, signature = (_decode(part) for part in parts)
        header = json.loads(header_text)
    except (ValueError, RecursionError) as error:
        raise CertificateRefused(
            "A part of the certificate is not base64url, or its header no JSON.", reason="form"
        ) from error
    key_id = _check_header(header, kinds)
    if key_id not in keys:
        raise CertificateRefused(
            f"It names the key '{key_id}', which is not among the keys given. Get the key set of the service "
            "that it claims to be from; if the key is not there either, do not trust it.",
            reason="key-unknown",
            key_id=key_id,
        )
    try:
        keys[key_id].verify(signature, parts[0] + b"." + parts[1])
    except InvalidSignature as error:
        raise CertificateRefused(
            "The signature does not fit the content: it was changed after it was signed. Do not trust it.",
            reason="signature",
            key_id=key_id,
        ) from error
    return payload, key_id


def _check_header(header: object, kinds: Collection[str]) -> str:
    if not isinstance(header, dict) or header.get("alg") != ALGORITHM:
        raise CertificateRefused(
            f"Its signature is not by {ALGORITHM}, the only algorithm of certificates. Do not trust it.",
            reason="algorithm",
        )
    if set(header) != HEADER_NAMES or header["typ"] not in kinds or not isinstance(header["kid"], str):
        raise CertificateRefused(
            f"Its header is not that of a {' or a '.join(kinds)}: it must hold alg, kid and typ.",
            reason="header",
        )
    return str(header["kid"][:200])


def _encode(content: bytes) -> str:
    return base64.urlsafe_b64encode(content).rstrip(b"=").decode("ascii")


def _decode(text: bytes | str) -> bytes:
    """Return the bytes of base64url without padding; raises ValueError for any other spelling of them."""
    encoded = text.encode("ascii") if isinstance(text, str) else text
    try:
        content = base64.b64decode(encoded + b"=" * (-len(encoded) % 4), altchars=b"-_", validate=True)
    except binascii.Error as error:
        raise ValueError("this is no base64url") from error
    # The last character has bits that say nothing: another spelling of the same bytes is a changed file.
    if _encode(content).encode("ascii") != encoded:
        raise ValueError("this is not the only spelling of these bytes")
    return content
