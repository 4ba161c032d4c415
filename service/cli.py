"""The command `dmscal`: one verb each, the same use cases as the service.

Exit status: 0 done (calibrate: PASS or MARGINAL; verify: genuine), 1 calibrate: FAIL, verify: refused, block
check: different, 2 bad input or something that is not there, 130 interrupted. Problems go to stderr, with
--json to stdout as a problem document. Not here: what the verbs do (use cases), verbs with a file of their
own (`commands`), and how the service is put together (app).
"""

import argparse
import os
import sys
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from typing import NoReturn
from uuid import UUID

import uvicorn
from pydantic import TypeAdapter, ValidationError

from service import __version__
from service.adapters.clock_system import SystemClock
from service.api.schemas import write_schemas
from service.app import MOST_REQUESTS, create_app, largest_socket_message, open_database, open_key_ring
from service.commands.certificates import add_signing, add_verify
from service.commands.exports import add_block, add_export
from service.commands.installation import WHO, add_data_dir, opened_database, read_settings
from service.commands.terminal import (
    BAD_INPUT,
    DONE,
    FAILED,
    INTERRUPTED,
    PIPE_CLOSED,
    print_text,
    tell_problem,
    to_json,
    write_file,
)
from service.core.errors import BadRequest, ServiceError
from service.core.planning.criterion import OBJECTIVES
from service.core.quality.gates import Verdict
from service.core.vision.camera import LENSES
from service.core.vision.target import parse_target
from service.log import configure_logging
from service.storage.database import Database
from service.storage.migration import revision_of, upgrade
from service.storage.words import Role
from service.usecases.access import create_key, list_keys, revoke_key
from service.usecases.folder_calibration import calibrate_folder
from service.usecases.folder_place import PlacePictures, read_place_pictures
from service.usecases.folder_report import report_document, report_text
from service.usecases.paging import PageRequest
from service.usecases.plan_report import plan_text
from service.usecases.planning import PlanRequest, plan_for, planned_document
from service.usecases.pose_set_document import pose_set_document
from service.usecases.sheets import SMALLEST_THAT_FITS, make_sheet
from service.usecases.sku_file import read_sku_file
from service.usecases.text import Label

KEYS_SHOWN = 1000
# A kiosk that vanished without a word must free its station soon.
SOCKET_PING_S = 5.0


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command with these arguments (by default the process's) and return its exit status."""
    given = sys.argv[1:] if argv is None else list(argv)
    try:
        arguments = build_parser().parse_args(given)
        status: int = arguments.run(arguments)
        sys.stdout.flush()
    except ServiceError as error:
        tell_problem(error, as_json="--json" in given)
        return BAD_INPUT
    except BrokenPipeError:
        # Whoever read the output has enough; Python must not try again at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return PIPE_CLOSED
    except KeyboardInterrupt:
        sys.stderr.write("Interrupted.\n")
        return INTERRUPTED
    return status


class _Parser(argparse.ArgumentParser):
    """Tells wrong arguments as any other bad input, so that --json gets its problem document for them too."""

    def error(self, message: str) -> NoReturn:
        raise BadRequest(f"{message}. {' '.join(self.format_usage().split())}")


def build_parser() -> argparse.ArgumentParser:
    """Return the parser of all verbs; each sets `run`, a function from the arguments to the exit status."""
    parser = _Parser(prog="dmscal", description="Camera calibration with pose guidance.")
    verbs = parser.add_subparsers(required=True, metavar="COMMAND")
    _add_calibrate(verbs.add_parser("calibrate", help="calibrate from a folder of images, without a server"))
    _add_plan(verbs.add_parser("plan", help="plan the poses of a SKU, without a server"))
    _add_sheet(verbs.add_parser("sheet", help="write a target's sheet to print"))
    _add_serve(verbs.add_parser("serve", help="start the service"))
    _add_migrate(verbs.add_parser("migrate", help="bring the database to the tables of this version"))
    _add_keys(verbs.add_parser("keys", help="add, list and revoke API keys"))
    add_verify(verbs.add_parser("verify", help="check a certificate, also without a server"))
    add_signing(verbs.add_parser("signing", help="show and rotate the keys that sign certificates"))
    add_export(verbs.add_parser("export", help="write a stored result as a file"))
    add_block(verbs.add_parser("block", help="check what was read back from a camera's memory"))
    schemas = verbs.add_parser(
        "schemas", help="write the schemas in docs and the web's types (in a checkout)"
    )
    schemas.set_defaults(run=_schemas)
    verbs.add_parser("version", help="print the version").set_defaults(run=_version, program=parser.prog)
    return parser


def _add_calibrate(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", type=Path, help="folder with the images of one camera")
    parser.add_argument(
        "--target",
        help="chessboard:9x6:25mm, charuco:11x8:25mm:18mm:4x4_250 (both by inner corners), "
        "aprilgrid:6x6:24mm:0.3 or circles:4x11:20mm:10mm; by default the SKU's",
    )
    parser.add_argument("--lens", help=f"{', '.join(LENSES)}; by default the SKU's, else pinhole5")
    parser.add_argument("--fix", metavar="NAMES", help="parameters that are not estimated, such as k3,p1,p2")
    parser.add_argument(
        "--sku", type=Path, metavar="FILE", help="SKU document (JSON): nominal camera and limits"
    )
    parser.add_argument(
        "--fixture", type=Path, metavar="FILE", help="a station's fixture (JSON), for T_vehicle_cam"
    )
    parser.add_argument(
        "--fixture-image",
        type=Path,
        metavar="IMAGE",
        nargs="+",
        action="extend",
        help="pictures of the fixture's target, taken with the camera where it is mounted",
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.set_defaults(run=_calibrate)


def _calibrate(arguments: argparse.Namespace) -> int:
    revision = read_sku_file(arguments.sku) if arguments.sku else None
    if arguments.target is not None:
        target = parse_target(arguments.target)
    elif revision is not None:
        target = revision.target
    else:
        raise BadRequest("Say which target the images show, for example --target chessboard:9x6:25mm.")
    lens = arguments.lens or (revision.intrinsics.lens if revision else "pinhole5")
    fixed = revision.fixed if revision else ()
    if arguments.fix is not None:
        fixed = tuple(name.strip() for name in arguments.fix.split(",") if name.strip())
    place = _place_pictures(arguments)
    calibration = calibrate_folder(
        arguments.folder, target, lens, fixed=fixed, revision=revision, place=place
    )
    print_text(to_json(report_document(calibration)) if arguments.json else report_text(calibration))
    return FAILED if calibration.judged.verdict is Verdict.FAIL else DONE


def _place_pictures(arguments: argparse.Namespace) -> PlacePictures | None:
    if arguments.fixture is None and arguments.fixture_image is None:
        return None
    if arguments.fixture is None or arguments.fixture_image is None:
        raise BadRequest(
            "Where the camera is in the vehicle takes both: --fixture FILE says where the target stands, "
            "--fixture-image IMAGE shows it."
        )
    return read_place_pictures(arguments.fixture, arguments.fixture_image)


def _add_plan(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("sku", type=Path, help="SKU document (JSON)")
    parser.add_argument("--out", type=Path, metavar="FILE", help="write the pose set to this file")
    parser.add_argument("--count", type=int, metavar="N", help="number of poses; by default the SKU's")
    parser.add_argument("--seed", type=int, default=0, help="the same seed gives the same poses (default 0)")
    parser.add_argument(
        "--objective", choices=OBJECTIVES, default="balanced", help="what to make small (default balanced)"
    )
    parser.add_argument(
        "--planner",
        choices=("exchange", "paper"),
        default="exchange",
        help="paper: its procedure, to compare",
    )
    parser.add_argument("--json", action="store_true", help="print the pose set as one JSON object")
    parser.set_defaults(run=_plan)


def _plan(arguments: argparse.Namespace) -> int:
    revision = read_sku_file(arguments.sku)
    plan = PlanRequest(arguments.seed, objective=arguments.objective, planner=arguments.planner)
    pose_set = plan_for(revision, plan, count=arguments.count)
    document = to_json(pose_set_document(revision, None, planned_document(revision, pose_set)))
    if arguments.out is not None:
        write_file(arguments.out, f"{document}\n".encode())
    if arguments.json:
        print_text(document)
    else:
        print_text(plan_text(revision.code, pose_set))
    return DONE


def _add_sheet(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("target", help="such as chessboard:9x6:25mm")
    parser.add_argument("--out", type=Path, required=True, metavar="FILE", help="FILE.pdf or FILE.svg")
    parser.add_argument(
        "--paper",
        default=SMALLEST_THAT_FITS,
        help="A4 to A0 or a size such as 700x500mm; by default the smallest of A4 to A0 that fits",
    )
    parser.set_defaults(run=_sheet)


def _sheet(arguments: argparse.Namespace) -> int:
    suffix = arguments.out.suffix.lower()
    if suffix not in {".pdf", ".svg"}:
        raise BadRequest(f"'{arguments.out}' is neither .pdf nor .svg; say which one by the name of --out.")
    sheet = make_sheet(arguments.target, "pdf" if suffix == ".pdf" else "svg", arguments.paper)
    write_file(arguments.out, sheet.content)
    paper = sheet.paper
    print_text(
        f"{arguments.out}: {paper.name}, {paper.width_mm:g} x {paper.height_mm:g} mm. "
        "Print it at 100 %, not fitted to the page, and measure both rulers."
    )
    return DONE


def _add_serve(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--host", help="address to listen on (else DMSCAL_HOST, else 127.0.0.1)")
    parser.add_argument("--port", type=int, help="port to listen on (else DMSCAL_PORT, else 8000)")
    parser.add_argument("--reload", action="store_true", help="start again when the code changes")
    add_data_dir(parser)
    parser.set_defaults(run=_serve)


def _serve(arguments: argparse.Namespace) -> int:
    settings = read_settings(arguments)
    given = {name: getattr(arguments, name) for name in ("host", "port")}
    settings = settings.model_copy(update={name: value for name, value in given.items() if value is not None})
    configure_logging(settings.log_level, settings.log_format)
    # What is wrong with database or keys is told here in one line, and not by a server that fails to start.
    open_database(settings).close()
    open_key_ring(settings)
    if arguments.reload:
        # The server imports the application in a process of its own, which knows the environment only.
        os.environ |= {
            "DMSCAL_DATA_DIR": str(settings.data_dir),
            "DMSCAL_DATABASE_URL": settings.database_url,
            "DMSCAL_BLOBS_URL": settings.blobs_url,
            "DMSCAL_SIGNING_KEYS_DIR": settings.signing_keys_dir,
        }
    uvicorn.run(
        "service.app:create_app_from_environment" if arguments.reload else create_app(settings),
        factory=arguments.reload,
        reload=arguments.reload,
        host=settings.host,
        port=settings.port,
        log_config=None,
        timeout_graceful_shutdown=round(settings.shutdown_grace_s),
        limit_concurrency=MOST_REQUESTS,
        # Pictures do not shrink, and compressing them takes longer than sending them.
        ws_per_message_deflate=False,
        ws_max_size=largest_socket_message(settings),
        ws_ping_interval=SOCKET_PING_S,
        ws_ping_timeout=2 * SOCKET_PING_S,
    )
    return DONE


def _add_migrate(parser: argparse.ArgumentParser) -> None:
    add_data_dir(parser)
    parser.set_defaults(run=_migrate)


def _migrate(arguments: argparse.Namespace) -> int:
    with closing(Database.open(read_settings(arguments).database_url)) as database:
        before = revision_of(database)
        upgrade(database)
        after = revision_of(database)
    print_text(f"The database was at revision {before or 'none'} and is at {after}.")
    return DONE


def _add_keys(parser: argparse.ArgumentParser) -> None:
    verbs = parser.add_subparsers(required=True, metavar="COMMAND")
    add = verbs.add_parser("add", help="make a key; it is printed this once")
    add.add_argument("name", help="whose key it is")
    add.add_argument("--role", required=True, choices=[role.value for role in Role])
    add.set_defaults(run=_add_key)
    listing = verbs.add_parser("list", help="list the keys")
    listing.set_defaults(run=_list_keys)
    revoke = verbs.add_parser("revoke", help="make a key worthless at once")
    revoke.add_argument("id", help="the key's id, as `keys list` prints it")
    revoke.set_defaults(run=_revoke_key)
    for verb in (add, listing, revoke):
        add_data_dir(verb)


def _add_key(arguments: argparse.Namespace) -> int:
    try:
        TypeAdapter(Label).validate_python(arguments.name)
    except ValidationError as error:
        raise BadRequest(
            f"The name cannot be used: {error.errors()[0]['msg']}. Choose another one."
        ) from error
    with opened_database(arguments) as database, database.write() as session:
        made = create_key(session, arguments.name, Role(arguments.role), WHO, SystemClock().now())
    # The key alone goes to stdout, so that a script can take it.
    sys.stderr.write(f"Key of '{made.name}', role {made.role.value}, id {made.id}. It is shown this once.\n")
    print_text(made.key)
    return DONE


def _list_keys(arguments: argparse.Namespace) -> int:
    with opened_database(arguments) as database, database.read() as session:
        keys = list_keys(session, PageRequest(limit=KEYS_SHOWN)).items
    for key in keys:
        state = "revoked" if key.revoked_at else "valid"
        print_text(
            f"{key.id}  {key.role.value:<9} {state:<8} {key.created_at:%Y-%m-%d}  {key.prefix}  {key.name}"
        )
    return DONE


def _revoke_key(arguments: argparse.Namespace) -> int:
    try:
        key_id = UUID(arguments.id)
    except ValueError as error:
        raise BadRequest(f"'{arguments.id}' is no key id; `dmscal keys list` prints the ids.") from error
    with opened_database(arguments) as database, database.write() as session:
        row = revoke_key(session, key_id, WHO, SystemClock().now())
    print_text(f"The key of '{row.name}' is revoked.")
    return DONE


def _schemas(arguments: argparse.Namespace) -> int:
    project = Path.cwd()
    if not (project / "pyproject.toml").is_file() or not (project / "web").is_dir():
        raise BadRequest(
            "Run this in the root of a checkout: the files that it writes belong to the sources."
        )
    changed = write_schemas(project)
    print_text("\n".join(f"written: {path}" for path in changed) or "The generated files are up to date.")
    return DONE


def _version(arguments: argparse.Namespace) -> int:
    print_text(f"{arguments.program} {__version__}")
    return DONE
