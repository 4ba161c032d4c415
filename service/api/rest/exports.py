"""Exports: results as files for OpenCV, ROS, Kalibr, a camera's memory, tables and paper."""

import base64
from typing import Annotated

from fastapi import APIRouter, Path, Query, Response
from pydantic import AfterValidator, ConfigDict, Field, JsonValue

from service.api.auth import Mes, Viewer
from service.api.dependencies import Db, Now, ReadDb
from service.api.files import attachment
from service.api.rest.runs import Wanted
from service.api.shapes import Answer, Id, Request
from service.usecases import result_exports
from service.usecases.block_layout import LARGEST_BLOCK, BlockLayout
from service.usecases.exports.formats import FORMATS
from service.usecases.paging import PageRequest

router = APIRouter(tags=["Exports"])

TABLES = [one.name for one in FORMATS.values() if one.write_many is not None]
FormatName = Annotated[
    str, Path(max_length=40, json_schema_extra={"enum": [*FORMATS]}, description="Name of the format.")
]
TableName = Annotated[
    str, Path(max_length=40, json_schema_extra={"enum": [*TABLES]}, description="Name of the format.")
]
AllowFailed = Annotated[
    bool, Query(description="Give results with the verdict FAIL, too; the file says so where it can.")
]
FILE: dict[int | str, dict[str, object]] = {
    200: {
        "description": "The file.",
        "content": {one.media_type.partition(";")[0]: {} for one in FORMATS.values()},
    }
}
NEXT_CURSOR, RUNS = "X-Next-Cursor", "X-Runs"
EXAMPLE_LAYOUT: JsonValue = {
    "name": "cabin-eeprom",
    "version": 2,
    "size": 64,
    "fields": [
        {"name": "magic", "type": "ascii", "size": 4, "constant": "DMSC"},
        {"name": "version", "type": "u16", "source": "layout.version"},
        {"name": "verdict", "type": "u8", "source": "run.verdict_number"},
        {"name": "fx", "type": "f32", "at": 8, "source": "intrinsics.fx"},
        {"name": "fy", "type": "f32", "source": "intrinsics.fy"},
        {"name": "cx", "type": "uq11.5", "source": "intrinsics.cx"},
        {"name": "k1", "type": "i32", "at": 20, "source": "intrinsics.k1", "scale": 1e-6},
        {"name": "serial", "type": "ascii", "size": 32, "at": 24, "source": "run.serial"},
    ],
    "crc": {"kind": "crc32", "at": 60},
}


def check_base64(text: str) -> str:
    """Return the text, or raise ValueError where it is no base64."""
    # What Python would pass over may be a byte that was lost on the way.
    base64.b64decode(text, validate=True)
    return text


class ExportFormat(Answer):
    """A format of exports."""

    name: str
    label: str = Field(description="What its readers call it.")
    media_type: str
    is_table: bool = Field(description="Whether one file may hold many runs.")


class ExportFormats(Answer):
    """All formats, in the order in which they are offered."""

    formats: list[ExportFormat]


class BlockOrder(Request):
    """By which layout to make a block."""

    model_config = ConfigDict(json_schema_extra={"examples": [{"layout": EXAMPLE_LAYOUT}]})

    layout: BlockLayout


class ReadBack(Request):
    """What was read back from a camera's memory."""

    model_config = ConfigDict(json_schema_extra={"examples": [{"block": "RE1TQwIAAP8=", "layout": None}]})

    block: Annotated[str, Field(max_length=2 * LARGEST_BLOCK), AfterValidator(check_base64)] = Field(
        description="The bytes, base64."
    )
    layout: BlockLayout | None = Field(default=None, description="Null: the layout of the run's SKU.")


class BlockDifference(Answer):
    """A field whose bytes are not those of the result."""

    field: str = Field(description="Name of the field; also `size`, `crc` and `unused bytes`.")
    at: int = Field(description="Its first byte.")
    expected: str | int | float | None
    found: str | int | float | None


class BlockChecked(Answer):
    """How what was read back compares with the stored result."""

    matches: bool = Field(description="It is the block of this result, to the last byte.")
    crc_holds: bool | None = Field(
        description="The checksum that was read fits the bytes that were read; null: not known."
    )
    differences: list[BlockDifference]


@router.get("/exports", summary="List the formats of exports")
def list_formats(caller: Viewer) -> ExportFormats:
    """List the formats in which a result can be had; docs/exports.md says what is in each."""
    formats = [
        ExportFormat(
            name=one.name,
            label=one.label,
            media_type=one.media_type.partition(";")[0],
            is_table=one.write_many is not None,
        )
        for one in FORMATS.values()
    ]
    return ExportFormats(formats=formats)


@router.get("/exports/{name}", summary="Export many runs", response_class=Response, responses=FILE)
def export_runs(
    name: TableName,
    *,
    caller: Viewer,
    db: ReadDb,
    wanted: Wanted,
    allow_failed: AllowFailed = False,
    limit: Annotated[
        int, Query(ge=1, le=result_exports.MOST_RUNS, description="Most runs in one file.")
    ] = 500,
    cursor: Annotated[
        str | None, Query(max_length=200, description="`X-Next-Cursor` of the file before.")
    ] = None,
) -> Response:
    """Give the finished runs that meet all the filters as one table, newest first.

    A file holds at most `limit` runs; the header `X-Runs` says how many it does, and `X-Next-Cursor` is there
    while there are more. Runs with the verdict FAIL are left out unless `allow_failed` is true.
    """
    page = PageRequest(limit, cursor)
    exported = result_exports.export_runs(db, name, wanted, page, allow_failed=allow_failed)
    answer = _attachment(exported.file)
    answer.headers[RUNS] = str(exported.runs)
    if exported.next_cursor is not None:
        answer.headers[NEXT_CURSOR] = exported.next_cursor
    return answer


@router.get(
    "/runs/{run_id}/exports/{name}", summary="Export a result", response_class=Response, responses=FILE
)
def export_run(
    run_id: Id, name: FormatName, *, caller: Viewer, db: ReadDb, allow_failed: AllowFailed = False
) -> Response:
    """Give the result of a finished run as a file, under a name with its serial.

    A result with the verdict FAIL is refused (`result-failed`) unless `allow_failed` is true. A result that
    the format has no words for is refused (`format-cannot-say`) and never written as another one.
    """
    return _attachment(result_exports.export_run(db, run_id, name, allow_failed=allow_failed))


@router.post(
    "/runs/{run_id}/block",
    summary="Make a block by a layout",
    response_class=Response,
    responses={200: {"description": "The block.", "content": {"application/octet-stream": {}}}},
)
def make_block(
    run_id: Id, body: BlockOrder, *, caller: Viewer, db: ReadDb, allow_failed: AllowFailed = False
) -> Response:
    """Give the block for a camera's memory by a layout that comes with the request.

    By the layout of the SKU, it is the export `block`.
    """
    return _attachment(result_exports.make_block(db, run_id, body.layout, allow_failed=allow_failed))


@router.post("/runs/{run_id}/block/check", summary="Check a block that was read back")
def check_block(run_id: Id, body: ReadBack, caller: Mes, db: Db, now: Now) -> BlockChecked:
    """Compare what was read back from a camera's memory with the stored result, field by field.

    The audit trail keeps who asked and what came out.
    """
    found = base64.b64decode(body.block)
    checked = result_exports.check_run_block(db, run_id, body.layout, found, who=caller.name, now=now)
    return BlockChecked.model_validate(checked)


def _attachment(file: result_exports.ExportedFile) -> Response:
    return attachment(file.content, file.media_type, file.name)
