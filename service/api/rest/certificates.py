"""Certificates: the signed result of a run, and the public keys that it is checked with."""

from typing import Literal

from fastapi import APIRouter, Response
from pydantic import Field

from service.api.auth import PUBLIC, Viewer
from service.api.dependencies import Now, Of
from service.api.files import attachment
from service.api.shapes import Answer, Id
from service.usecases import certificate
from service.usecases.signing import key_set

router = APIRouter(tags=["Results"])
public_keys = APIRouter(tags=["Results"], dependencies=[PUBLIC])

KEYS_KEPT_S = 300


class PublicKey(Answer):
    """A public key that certificates were signed with (RFC 8037)."""

    kty: Literal["OKP"]
    crv: Literal["Ed25519"]
    x: str = Field(description="The key, base64url.")
    kid: str = Field(description="Its id: the thumbprint of RFC 7638.")
    alg: Literal["EdDSA"]
    use: Literal["sig"]


class PublicKeys(Answer):
    """A JSON Web Key Set (RFC 7517)."""

    keys: list[PublicKey] = Field(description="The one that signs now first, then those before it.")


@router.get(
    "/runs/{run_id}/certificate",
    summary="Read the certificate of a run",
    response_class=Response,
    responses={200: {"content": {certificate.MEDIA_TYPE: {}}, "description": "A compact JWS."}},
)
def read_certificate(run_id: Id, caller: Viewer, of: Of, now: Now) -> Response:
    """Give the result as a signed document: a compact JWS (EdDSA), always the same bytes for a run.

    `dmscal verify FILE --jwks KEYS` checks it anywhere, with the keys of `/.well-known/jwks.json` saved
    before. A camera that failed has a certificate too, and it says FAIL.
    """
    found = certificate.read_certificate(of.database, of.signing_keys, run_id, caller.name, now)
    return attachment(found.token.encode("ascii"), certificate.MEDIA_TYPE, found.file_name)


@public_keys.get("/.well-known/jwks.json", summary="Read the keys that check certificates")
def read_public_keys(of: Of, response: Response) -> PublicKeys:
    """Give the public keys of all certificates, as a JSON Web Key Set. Save it to check them offline."""
    response.headers["Cache-Control"] = f"public, max-age={KEYS_KEPT_S}"
    return PublicKeys.model_validate(key_set(of.signing_keys))
