"""`dmscal export` and `dmscal block check`: a stored result as a file, and a camera's memory against it."""

import argparse
from dataclasses import asdict
from pathlib import Path
from uuid import UUID

from pydantic import ValidationError

from service.adapters.clock_system import SystemClock
from service.commands.installation import WHO, add_data_dir, opened_database
from service.commands.terminal import DONE, FAILED, print_text, read_file, to_json, write_file
from service.core.errors import BadRequest
from service.usecases.block_check import BlockCheck
from service.usecases.block_layout import LARGEST_BLOCK, BlockLayout
from service.usecases.exports.formats import FORMATS
from service.usecases.result_exports import check_run_block, export_run, make_block
from service.usecases.result_problems import BlockLayoutUnusable

LARGEST_LAYOUT = 1_000_000
PROBLEMS_SHOWN = 5


def add_export(parser: argparse.ArgumentParser) -> None:
    """Describe the verb."""
    parser.add_argument("run_id", metavar="RUN", help="id of a finished run")
    parser.add_argument(
        "--format", required=True, choices=[*FORMATS], help="as docs/exports.md describes them"
    )
    parser.add_argument("--out", type=Path, metavar="FILE", help="by default a name with the serial, here")
    parser.add_argument("--layout", type=Path, metavar="FILE", help="of a block (JSON); by default the SKU's")
    parser.add_argument(
        "--allow-failed", action="store_true", help="export a result with the verdict FAIL, too"
    )
    add_data_dir(parser)
    parser.set_defaults(run=_export)


def add_block(parser: argparse.ArgumentParser) -> None:
    """Describe the verb."""
    verbs = parser.add_subparsers(required=True, metavar="COMMAND")
    check = verbs.add_parser("check", help="compare what was read back from a camera with its result")
    check.add_argument("run_id", metavar="RUN", help="id of a finished run")
    check.add_argument("file", type=Path, help="the bytes that were read back")
    check.add_argument("--layout", type=Path, metavar="FILE", help="layout (JSON); by default the SKU's")
    check.add_argument("--json", action="store_true", help="print one JSON object")
    add_data_dir(check)
    check.set_defaults(run=_check)


def _export(arguments: argparse.Namespace) -> int:
    run_id, layout = _run_id(arguments), _layout(arguments)
    if layout is not None and arguments.format != "block":
        raise BadRequest("Only the format block has a layout. Leave --layout out.")
    with opened_database(arguments) as database, database.read() as session:
        if layout is not None:
            file = make_block(session, run_id, layout, allow_failed=arguments.allow_failed)
        else:
            file = export_run(session, run_id, arguments.format, allow_failed=arguments.allow_failed)
    path = arguments.out or Path(file.name)
    write_file(path, file.content)
    print_text(f"written: {path}")
    return DONE


def _check(arguments: argparse.Namespace) -> int:
    run_id, layout = _run_id(arguments), _layout(arguments)
    found = read_file(arguments.file, LARGEST_BLOCK)
    with opened_database(arguments) as database, database.write() as session:
        checked = check_run_block(session, run_id, layout, found, who=WHO, now=SystemClock().now())
    print_text(to_json(asdict(checked)) if arguments.json else _report(checked))
    return DONE if checked.matches else FAILED


def _report(checked: BlockCheck) -> str:
    if checked.matches:
        return "The block matches the stored result, to the last byte."
    held = {True: "The checksum fits the bytes.", False: "The checksum does NOT fit the bytes.", None: ""}
    lines = [
        f"{one.field} (byte {one.at}): expected {one.expected}, found {one.found}"
        for one in checked.differences
    ]
    return "\n".join(["The block DIFFERS from the stored result.", held[checked.crc_holds], *lines])


def _run_id(arguments: argparse.Namespace) -> UUID:
    try:
        return UUID(arguments.run_id)
    except ValueError as error:
        raise BadRequest(
            f"'{arguments.run_id}' is no id of a run; the dashboard and the API show it."
        ) from error


def _layout(arguments: argparse.Namespace) -> BlockLayout | None:
    if arguments.layout is None:
        return None
    try:
        return BlockLayout.model_validate_json(read_file(arguments.layout, LARGEST_LAYOUT))
    except ValidationError as error:
        wrong = "; ".join(
            f"{'.'.join(map(str, one['loc'])) or 'the file'}: {one['msg']}"
            for one in error.errors()[:PROBLEMS_SHOWN]
        )
        raise BlockLayoutUnusable(f"'{arguments.layout}' is no layout. Correct {wrong}.") from error
