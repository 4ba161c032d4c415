"""Bytes by a layout: made from values, and read back. Not here: what the values are (`block_sources`)."""

import binascii
import math
import struct
from collections.abc import Callable, Iterator
from typing import Literal

from service.usecases.block_layout import BlockCrc, BlockField, BlockLayout, fixed_point
from service.usecases.result_problems import BlockLayoutUnusable

Value = int | float | str | bytes
ValueOf = Callable[[str], Value]
"""The value of a source; raises BlockLayoutUnusable for one that the result has not."""

FLOATS = {"f32": "f", "f64": "d"}
# Doubles hold whole numbers up to here.
EXACT = 2**53


def encode_block(layout: BlockLayout, value_of: ValueOf) -> bytes:
    """Return the block; raises BlockLayoutUnusable naming the field that has no room for its value."""
    block = bytearray([layout.fill]) * layout.size
    for field, at in layout.placed:
        value = field.constant if field.constant is not None else value_of(field.source or "")
        block[at : at + field.bytes] = encode_field(field, value, layout.byte_order)
    if layout.crc is not None:
        crc = layout.crc
        block[crc.at : crc.at + crc.bytes] = checksum(crc, bytes(block)).to_bytes(
            crc.bytes, crc.byte_order or layout.byte_order
        )
    return bytes(block)


def encode_field(field: BlockField, value: Value, byte_order: Literal["little", "big"]) -> bytes:
    """Return the bytes of one value."""
    order = field.byte_order or byte_order
    if field.type == "bytes":
        return _padded(field, bytes.fromhex(value) if isinstance(value, str) else _raw(field, value))
    if field.type == "ascii":
        return _padded(field, _text(field, value))
    if isinstance(value, str | bytes):
        raise _no_room(field, f"its value {value!r} is no number; use the type ascii or bytes")
    if field.type in FLOATS:
        return _float(field, (value - field.offset) / field.scale, order)
    return _integer(field, value, order)


def decode_field(field: BlockField, content: bytes, byte_order: Literal["little", "big"]) -> Value:
    """Return the value of one field's bytes; text without its padding, and bytes that are no text as hex."""
    order = field.byte_order or byte_order
    if field.type == "bytes":
        return content.hex()
    if field.type == "ascii":
        text = content.rstrip(bytes([field.pad]))
        return (
            text.decode("ascii") if text.isascii() and text.decode("ascii").isprintable() else content.hex()
        )
    if field.type in FLOATS:
        (number,) = struct.unpack(f"{'<' if order == 'little' else '>'}{FLOATS[field.type]}", content)
        return float(number) * field.scale + field.offset
    signed, step = _integer_form(field)
    written = int.from_bytes(content, order, signed=signed)
    if step == 1 and field.offset == 0:
        return written
    return written * step + field.offset


def checksum(crc: BlockCrc, block: bytes) -> int:
    """Return the checksum of the bytes that it covers.

    CRC-16/CCITT-FALSE has the polynomial 0x1021 and starts with 0xFFFF; CRC-32 is that of Ethernet and zip.
    """
    covered = block[crc.first : crc.stop]
    if crc.kind == "crc16-ccitt-false":
        return binascii.crc_hqx(covered, 0xFFFF)
    return binascii.crc32(covered)


def unused_bytes(layout: BlockLayout) -> Iterator[int]:
    """Yield the places of a block where no field is."""
    taken = {place for field, at in layout.placed for place in range(at, at + field.bytes)}
    if layout.crc is not None:
        taken |= set(range(layout.crc.at, layout.crc.at + layout.crc.bytes))
    yield from (place for place in range(layout.size) if place not in taken)


def _integer_form(field: BlockField) -> tuple[bool, float]:
    """Return whether a field of whole numbers has a sign, and what one step of it is worth."""
    point = fixed_point(field.type)
    if point is None:
        return field.type.startswith("i"), field.scale
    return point[0], field.scale * 2.0 ** -point[2]


def _integer(field: BlockField, value: float, order: Literal["little", "big"]) -> bytes:
    signed, step = _integer_form(field)
    exact = isinstance(value, int) and step == 1 and field.offset == 0
    written = value if exact else (value - field.offset) / step
    if not math.isfinite(written) or (not exact and abs(written) > EXACT):
        raise _no_room(field, f"{value:g} cannot be written as a whole number")
    try:
        return round(written).to_bytes(field.bytes, order, signed=signed)
    except OverflowError as error:
        bits = 8 * field.bytes - signed
        largest = (2**bits - 1) * step + field.offset
        smallest = (-(2**bits) * step if signed else 0.0) + field.offset
        raise _no_room(field, f"{value:g} is not from {smallest:g} to {largest:g}") from error


def _float(field: BlockField, value: float, order: Literal["little", "big"]) -> bytes:
    if not math.isfinite(value):
        raise _no_room(field, "its value is not finite")
    try:
        return struct.pack(f"{'<' if order == 'little' else '>'}{FLOATS[field.type]}", value)
    except OverflowError as error:
        raise _no_room(field, f"{value:g} is too large for {field.type}") from error


def _text(field: BlockField, value: Value) -> bytes:
    text = value if isinstance(value, str) else f"{value!r}"
    if isinstance(value, bytes) or not text.isascii():
        raise _no_room(field, f"{text!r} is no ASCII text")
    return text.encode("ascii")


def _raw(field: BlockField, value: Value) -> bytes:
    if not isinstance(value, bytes):
        raise _no_room(field, f"its value {value!r} is no bytes; use ascii or the type of a number")
    return value


def _padded(field: BlockField, content: bytes) -> bytes:
    if len(content) > field.bytes:
        raise _no_room(field, f"its value takes {len(content)} bytes and the field has {field.bytes}")
    return content + bytes([field.pad]) * (field.bytes - len(content))


def _no_room(field: BlockField, why: str) -> BlockLayoutUnusable:
    return BlockLayoutUnusable(
        f"The field '{field.name}' ({field.type}) cannot hold its value: {why}. Correct the layout.",
        field=field.name,
    )


def as_shown(value: Value) -> str | int | float:
    """Return a value as JSON can show it."""
    return value.hex() if isinstance(value, bytes) else value
