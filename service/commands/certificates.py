"""`dmscal verify` and `dmscal signing`: check certificates anywhere; show and rotate a service's keys."""

import argparse
from pathlib import Path

import httpx
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey

from service.adapters.signing_keys_files import add_signing_key, load_public_keys, load_signing_keys
from service.commands.installation import add_data_dir, read_settings
from service.commands.terminal import DONE, FAILED, print_text, read_file, tell_problem, to_json
from service.core.quality.gates import Verdict
from service.usecases.certificate import Genuine, check_certificate
from service.usecases.result_problems import CertificateRefused, KeySetUnreadable
from service.usecases.signing import KeyRing, key_set, read_key_set, thumbprint

LARGEST_CERTIFICATE = 4_000_000
LARGEST_KEY_SET = 1_000_000
FETCH_S = 10.0
ASKED_FOR = ("http://", "https://")
SAID = {
    Verdict.PASS: "PASS      The certificate is genuine.",
    Verdict.MARGINAL: "MARGINAL  The certificate is genuine; the camera passed with little margin.",
    Verdict.FAIL: "FAIL      The certificate is genuine, and it says that this camera FAILED. Do not use it.",
}

SAID_OF_PLACE = {
    Verdict.PASS: "PASS      The certificate of the camera's place in the vehicle is genuine.",
    Verdict.MARGINAL: "MARGINAL  The certificate is genuine; the place in the vehicle has little margin.",
    Verdict.FAIL: "FAIL      The certificate is genuine; the place in the vehicle FAILED. Do not use it.",
}


def add_verify(parser: argparse.ArgumentParser) -> None:
    """Describe the verb."""
    parser.add_argument("file", type=Path, help="the certificate (.jws)")
    parser.add_argument(
        "--jwks",
        metavar="FILE_OR_URL",
        help="the service's /.well-known/jwks.json, saved or its address; by default this service's own keys",
    )
    parser.add_argument("--json", action="store_true", help="print the content as one JSON object")
    add_data_dir(parser)
    parser.set_defaults(run=_verify)


def add_signing(parser: argparse.ArgumentParser) -> None:
    """Describe the verb."""
    verbs = parser.add_subparsers(required=True, metavar="COMMAND")
    shown = verbs.add_parser("jwks", help="print the public keys, to save and to give away")
    shown.set_defaults(run=_show)
    rotated = verbs.add_parser("rotate", help="add a key; it signs from the next start of the service on")
    rotated.set_defaults(run=_rotate)
    for verb in (shown, rotated):
        add_data_dir(verb)


def _verify(arguments: argparse.Namespace) -> int:
    keys = _keys(arguments)
    token = read_file(arguments.file, LARGEST_CERTIFICATE).strip()
    try:
        genuine = check_certificate(token, keys)
    except CertificateRefused as refused:
        tell_problem(refused, as_json=arguments.json)
        return FAILED
    if arguments.json:
        print_text(to_json({"key_id": genuine.key_id, "certificate": genuine.content}))
    else:
        print_text(_report(genuine))
    return DONE


def _report(genuine: Genuine) -> str:
    content, run, result = genuine.content, genuine.content["run"], genuine.content["result"]
    later = content.get("extrinsics")
    extrinsics = later or result.get("extrinsics")
    lines = {
        "serial": run["serial"],
        "SKU": f"{run['sku']}, revision {run['revision']}",
        "station": (later or run)["station"] or "none named",
        "purpose": run["purpose"],
        "finished": run["finished_at"],
        "issued": content["issued_at"],
        "signed by": genuine.key_id,
        "run": run["id"],
        "lens": f"{result['lens']}, {result['image_size'][0]}x{result['image_size'][1]} px",
        "intrinsics": ", ".join(f"{name} {value:.6g}" for name, value in result["intrinsics"].items()),
        "result": f"SHA-256 {result['sha256']}",
    }
    if extrinsics is not None:
        lines["place"] = _place(extrinsics["pose"])
    failed = [one["name"] for one in content["measurements"] if one["verdict"] == Verdict.FAIL.value]
    if failed:
        lines["failed"] = ", ".join(failed)
    told = [f"{name:<10}{value}" for name, value in lines.items()]
    said = SAID_OF_PLACE if later else SAID
    return "\n".join([said[Verdict(content["verdict"])], *told])


def _place(pose: dict[str, list[float]]) -> str:
    position, rotation = (", ".join(f"{v:.6g}" for v in pose[name]) for name in ("tvec", "rvec"))
    return f"T_vehicle_cam at {position} m, rotation vector {rotation} rad"


def _keys(arguments: argparse.Namespace) -> dict[str, Ed25519PublicKey]:
    """Return the keys to check with; raises KeySetUnreadable, BadRequest."""
    if arguments.jwks is None:
        found = load_public_keys(Path(read_settings(arguments).signing_keys_dir))
        if not found:
            raise KeySetUnreadable(
                "There are no signing keys here. Give --jwks with the /.well-known/jwks.json of the service "
                "that the certificate is from."
            )
        return {thumbprint(key): key for key in found}
    if arguments.jwks.startswith(ASKED_FOR):
        return read_key_set(_fetch(arguments.jwks))
    return read_key_set(read_file(Path(arguments.jwks), LARGEST_KEY_SET))


def _fetch(address: str) -> bytes:
    try:
        with httpx.stream("GET", address, timeout=FETCH_S) as answer:
            answer.raise_for_status()
            content = b""
            for part in answer.iter_bytes():
                content += part
                if len(content) > LARGEST_KEY_SET:
                    raise KeySetUnreadable(f"What '{address}' answers is too large for a key set.")
    except (httpx.HTTPError, httpx.InvalidURL) as error:
        raise KeySetUnreadable(f"'{address}' does not answer a key set: {error}.") from error
    return content


def _show(arguments: argparse.Namespace) -> int:
    print_text(to_json(key_set(_ring(arguments))))
    return DONE


def _rotate(arguments: argparse.Namespace) -> int:
    directory = Path(read_settings(arguments).signing_keys_dir)
    add_signing_key(directory)
    print_text(f"Key {_ring(arguments).key_id} signs from the next start on; those before it stay published.")
    return DONE


def _ring(arguments: argparse.Namespace) -> KeyRing:
    signer, older = load_signing_keys(Path(read_settings(arguments).signing_keys_dir))
    return KeyRing.of(signer, older)
