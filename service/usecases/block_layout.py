"""The layout of a binary block for a camera's memory: data of a SKU, or given with a request. docs/exports.md

Here: its fields and all checks that need no result. Not here: how bytes are made and read by it
(`block_codec`), and what its sources mean (`block_sources`).
"""

import re
from itertools import pairwise
from typing import Annotated, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

LARGEST_BLOCK = 65_536
LARGEST_FIELD = 1024
MOST_FIELDS = 256

NUMBERS = {"u8": 1, "i8": 1, "u16": 2, "i16": 2, "u32": 4, "i32": 4, "u64": 8, "i64": 8, "f32": 4, "f64": 8}
FIXED_POINT = re.compile(r"(u?)q(\d{1,2})\.(\d{1,2})")
CRC_BYTES = {"crc16-ccitt-false": 2, "crc32": 4}

Place = Annotated[int, Field(ge=0, lt=LARGEST_BLOCK)]
ByteOrder = Literal["little", "big"]
Source = Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]*(\.[a-z][a-z0-9_]*)?$", max_length=60)]
Name = Annotated[str, Field(pattern=r"^[A-Za-z_][A-Za-z0-9_.-]*$", max_length=60)]


class LayoutPart(BaseModel):
    """A part of a layout: strict types, finite numbers, no unknown fields."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, allow_inf_nan=False)


class BlockField(LayoutPart):
    """One value of a block: where it stands, how it is written, and what it is."""

    name: Name
    type: Annotated[str, Field(max_length=8)] = Field(
        description="u8 i8 u16 i16 u32 i32 u64 i64, f32 f64, q3.12 or uq4.12 (fixed point), ascii, bytes."
    )
    at: Place | None = Field(default=None, description="First byte; null: right after the field before.")
    size: Annotated[int, Field(ge=1, le=LARGEST_FIELD)] | None = Field(
        default=None, description="Bytes of an ascii or bytes field."
    )
    byte_order: ByteOrder | None = Field(default=None, description="If it differs from the layout's.")
    source: Source | None = Field(
        default=None, description="What to write, such as intrinsics.fx, run.serial or image.width."
    )
    constant: int | float | str | None = Field(
        default=None, description="Write this instead: a number, text, or hex digits for bytes."
    )
    scale: float = Field(default=1.0, description="Value = written number * scale + offset.")
    offset: float = 0.0
    pad: Annotated[int, Field(ge=0, le=255)] = Field(
        default=0, description="Byte behind text that is too short."
    )

    @model_validator(mode="after")
    def _makes_sense(self) -> Self:
        if (self.source is None) == (self.constant is None):
            raise ValueError("give either a source or a constant")
        if self.type in {"ascii", "bytes"}:
            if self.size is None:
                raise ValueError(f"a field of type {self.type} needs a size in bytes")
            if (self.scale, self.offset) != (1.0, 0.0):
                raise ValueError("only numbers have a scale and an offset")
            self._check_text()
        elif number_bytes(self.type) is None:
            raise ValueError(f"the type {self.type!r} is not known")
        elif self.size is not None:
            raise ValueError(f"the type {self.type} has its own size; leave size out")
        elif isinstance(self.constant, str):
            raise ValueError("the constant of a number is a number")
        if self.scale == 0:
            raise ValueError("scale must not be 0")
        return self

    def _check_text(self) -> None:
        if self.constant is not None and not isinstance(self.constant, str):
            raise ValueError(f"the constant of a field of type {self.type} is text")
        if self.type == "bytes" and self.constant is not None:
            try:
                bytes.fromhex(self.constant)
            except ValueError as error:
                raise ValueError("the constant of a bytes field is an even number of hex digits") from error

    @property
    def bytes(self) -> int:
        """How many bytes it takes."""
        return self.size or number_bytes(self.type) or 0


class BlockCrc(LayoutPart):
    """The checksum of a block; it covers the bytes from `first` up to, and without, `end`."""

    kind: Literal["crc16-ccitt-false", "crc32"]
    at: Place
    first: Place = 0
    end: Annotated[int, Field(ge=1, le=LARGEST_BLOCK)] | None = Field(
        default=None, description="Null: up to the checksum."
    )
    byte_order: ByteOrder | None = Field(default=None, description="If it differs from the layout's.")

    @model_validator(mode="after")
    def _covers_others(self) -> Self:
        if self.first >= self.stop:
            raise ValueError("the checksum covers nothing: first must be smaller than end")
        if self.first < self.at + self.bytes and self.stop > self.at:
            raise ValueError("the checksum must not cover itself")
        return self

    @property
    def bytes(self) -> int:
        """How many bytes it takes."""
        return CRC_BYTES[self.kind]

    @property
    def stop(self) -> int:
        """The first byte that it does not cover."""
        return self.at if self.end is None else self.end


class BlockLayout(LayoutPart):
    """The layout of a block: fields at their places, a checksum, and what fills the rest."""

    name: Name
    version: Annotated[int, Field(ge=0, lt=2**32)] = 1
    size: Annotated[int, Field(ge=1, le=LARGEST_BLOCK)]
    byte_order: ByteOrder = "little"
    fill: Annotated[int, Field(ge=0, le=255)] = Field(default=255, description="Byte where no field is.")
    fields: Annotated[tuple[BlockField, ...], Field(min_length=1, max_length=MOST_FIELDS, strict=False)]
    crc: BlockCrc | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        taken = sorted((at, at + field.bytes, field.name) for field, at in self.placed)
        if self.crc is not None:
            taken = sorted([*taken, (self.crc.at, self.crc.at + self.crc.bytes, "crc")])
            if self.crc.stop > self.size:
                raise ValueError("the checksum covers bytes behind the block's end")
        names = [name for _, _, name in taken]
        if len(set(names)) != len(names):
            raise ValueError("two fields have the same name")
        for (_, end, name), (start, _, other) in pairwise(taken):
            if start < end:
                raise ValueError(f"{name} and {other} overlap")
        if max(end for _, end, _ in taken) > self.size:
            raise ValueError(f"{taken[-1][2]} ends behind the block's {self.size} bytes")
        return self

    @property
    def placed(self) -> list[tuple[BlockField, int]]:
        """The fields with their first bytes."""
        found, following = [], 0
        for field in self.fields:
            at = following if field.at is None else field.at
            found.append((field, at))
            following = at + field.bytes
        return found


def fixed_point(kind: str) -> tuple[bool, int, int] | None:
    """Return whether a q type has a sign, and its bits before (less the sign) and behind the point; or None.

    q3.12 has a sign, 3 bits before and 12 behind the point: 16 bits. uq4.12 has no sign.
    """
    found = FIXED_POINT.fullmatch(kind)
    if found is None:
        return None
    signed, whole, fraction = not found[1], int(found[2]), int(found[3])
    return (signed, whole, fraction) if signed + whole + fraction in {8, 16, 32, 64} else None


def number_bytes(kind: str) -> int | None:
    """Return how many bytes a number of this type takes, or None for what is no type of a number."""
    point = fixed_point(kind)
    return NUMBERS.get(kind) if point is None else sum(point) // 8
