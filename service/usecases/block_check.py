"""Compare what was read back from a camera's memory with the block that its result gives, field by field."""

import math
from dataclasses import dataclass
from functools import partial

from service.usecases.block_codec import as_shown, checksum, decode_field, encode_block, unused_bytes
from service.usecases.block_layout import BlockLayout
from service.usecases.block_sources import value_of
from service.usecases.finished_run import FinishedRun

Shown = str | int | float | None


@dataclass(frozen=True)
class Difference:
    """One field whose bytes are not those that were to be written; `at` is its first byte."""

    field: str
    at: int
    expected: Shown
    found: Shown


@dataclass(frozen=True)
class BlockCheck:
    """What a read-back says. matches: it is the block of the result, to the last byte.

    crc_holds: the checksum that was read fits the bytes that were read; None where the layout has none.
    """

    matches: bool
    crc_holds: bool | None
    differences: tuple[Difference, ...]


def check_block(run: FinishedRun, layout: BlockLayout, found: bytes) -> BlockCheck:
    """Return how a block that was read back differs; raises BlockLayoutUnusable."""
    expected = encode_block(layout, partial(value_of, run, layout))
    if len(found) != layout.size:
        return BlockCheck(False, None, (Difference("size", 0, layout.size, len(found)),))
    differences = [*_fields(layout, expected, found), *_rest(layout, expected, found)]
    crc = _crc(layout, found)
    return BlockCheck(found == expected, crc, tuple(differences))


def _fields(layout: BlockLayout, expected: bytes, found: bytes) -> list[Difference]:
    return [
        Difference(
            field.name,
            at,
            as_shown(decode_field(field, expected[at : at + field.bytes], layout.byte_order)),
            _finite(as_shown(decode_field(field, found[at : at + field.bytes], layout.byte_order))),
        )
        for field, at in layout.placed
        if expected[at : at + field.bytes] != found[at : at + field.bytes]
    ]


def _rest(layout: BlockLayout, expected: bytes, found: bytes) -> list[Difference]:
    """Return the differences of the checksum and of the bytes where no field is."""
    differences = []
    if layout.crc is not None:
        place = slice(layout.crc.at, layout.crc.at + layout.crc.bytes)
        if expected[place] != found[place]:
            differences.append(Difference("crc", place.start, expected[place].hex(), found[place].hex()))
    changed = [place for place in unused_bytes(layout) if expected[place] != found[place]]
    if changed:
        first = changed[0]
        differences.append(Difference("unused bytes", first, layout.fill, found[first]))
    return differences


def _crc(layout: BlockLayout, found: bytes) -> bool | None:
    if layout.crc is None:
        return None
    crc = layout.crc
    read = int.from_bytes(found[crc.at : crc.at + crc.bytes], crc.byte_order or layout.byte_order)
    return read == checksum(crc, found)


def _finite(value: str | float) -> Shown:
    """Return the value, or as text what JSON cannot say: an empty memory reads as NaN."""
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    return value
