"""What an image file says about itself before it is decoded: format, size, depth, and whether it is whole.

Decoders believe the declared size and allocate for it, so it is read here first, from the first bytes of each
accepted format. Not here: decoding and the limits (images.py).
"""

import struct
import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass

PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"
JPEG_SIGNATURE = b"\xff\xd8\xff"
PNM_SAMPLES = {b"P2": 1, b"P3": 3, b"P5": 1, b"P6": 3}
# Markers without a length: TEM, RST0-7, SOI.
JPEG_BARE = frozenset({0x01, *range(0xD0, 0xD9)})
# SOF0-15 without DHT, JPG and DAC, which share the range.
JPEG_FRAMES = frozenset(range(0xC0, 0xD0)) - {0xC4, 0xC8, 0xCC}
TIFF_WIDTH, TIFF_HEIGHT, TIFF_BITS = 256, 257, 258
TIFF_SHORT, TIFF_LONG = 3, 4


class DamagedError(ValueError):
    """The header cannot be read or the file ends too early; the message says which."""


@dataclass(frozen=True)
class ImageHeader:
    """What a file declares: its format and media type, size in px and bits per sample."""

    format: str
    media_type: str
    width: int
    height: int
    bits: int


def read_header(data: bytes) -> ImageHeader | None:
    """Return what an image file declares; None when it is of none of the accepted formats.

    Raises DamagedError when the header is broken or, for PNG, JPEG, PNM and BMP, the file ends too early.
    """
    for starts, read in READERS:
        if data.startswith(starts):
            try:
                return read(data)
            except (struct.error, IndexError) as error:
                raise DamagedError("it ends within its header") from error
    return None


def _read_png(data: bytes) -> ImageHeader:
    """Read IHDR; the checksums of all chunks up to IEND must hold (PNG specification, section 5)."""
    width, height, bits = struct.unpack_from(">IIB", data, 16)
    position, kind = len(PNG_SIGNATURE), b""
    while kind != b"IEND":
        length, kind = struct.unpack_from(">I4s", data, position)
        end = position + 8 + length
        (checksum,) = struct.unpack_from(">I", data, end)
        if zlib.crc32(data[position + 4 : end]) != checksum:
            raise DamagedError("a checksum does not hold")
        position = end + 4
    return ImageHeader("PNG", "image/png", width, height, bits)


def _read_jpeg(data: bytes) -> ImageHeader:
    """Read the frame header, and go through all markers to the end of the image (ITU T.81, annex B)."""
    header: ImageHeader | None = None
    for marker, position in _jpeg_segments(data):
        if marker in JPEG_FRAMES and header is None:
            bits, height, width = struct.unpack_from(">BHH", data, position + 4)
            header = ImageHeader("JPEG", "image/jpeg", width, height, bits)
    if header is None:
        raise DamagedError("it holds no picture")
    return header


def _jpeg_segments(data: bytes) -> Iterator[tuple[int, int]]:
    """Yield each marker with its position up to the end-of-image marker, which must be there."""
    position = 2
    while True:
        position = data.find(b"\xff", position)
        if position < 0 or position + 1 >= len(data):
            raise DamagedError("it ends too early")
        marker = data[position + 1]
        if marker == 0xD9:
            return
        if marker == 0xFF:
            position += 1
        elif marker == 0x00 or marker in JPEG_BARE:
            position += 2
        else:
            yield marker, position
            (length,) = struct.unpack_from(">H", data, position + 2)
            position += 2 + length


def _read_pnm(data: bytes) -> ImageHeader:
    """Read the words of a portable grey or pixel map; comments run from # to the end of the line."""
    words: list[int] = []
    position = 2
    while len(words) < 3:
        while data[position : position + 1].isspace():
            position += 1
        if data[position : position + 1] == b"#":
            position = data.index(b"\n", position) if b"\n" in data[position:] else len(data)
            continue
        end = position
        while data[end : end + 1].isdigit() and end - position < 10:
            end += 1
        if end == position:
            raise DamagedError("its header is not complete")
        words.append(int(data[position:end]))
        position = end
    width, height, largest = words
    bits = 8 if largest <= 255 else 16
    raw = width * height * PNM_SAMPLES[data[:2]] * (bits // 8) if data[:2] in {b"P5", b"P6"} else 0
    if len(data) < position + 1 + raw:
        raise DamagedError("it ends too early")
    return ImageHeader("PNM", "image/x-portable-anymap", width, height, bits)


def _read_bmp(data: bytes) -> ImageHeader:
    """Read the BITMAPINFOHEADER; plain rows are padded to four bytes, a negative height means top first."""
    (offset,) = struct.unpack_from("<I", data, 10)
    width, height, _, depth, compression = struct.unpack_from("<iiHHI", data, 18)
    row = (abs(width) * depth + 31) // 32 * 4
    if width <= 0 or (compression == 0 and len(data) < offset + row * abs(height)):
        raise DamagedError("it ends too early")
    return ImageHeader("BMP", "image/bmp", width, abs(height), 16 if depth == 16 else 8)


def _read_tiff(data: bytes) -> ImageHeader:
    """Read size and bits of the first directory (TIFF 6.0, section 2)."""
    order = "<" if data[:2] == b"II" else ">"
    (directory,) = struct.unpack_from(f"{order}I", data, 4)
    (entries,) = struct.unpack_from(f"{order}H", data, directory)
    values = {TIFF_BITS: 1}
    for i in range(entries):
        tag, kind, count, raw = struct.unpack_from(f"{order}HHI4s", data, directory + 2 + 12 * i)
        if tag in {TIFF_WIDTH, TIFF_HEIGHT, TIFF_BITS}:
            values[tag] = _tiff_value(data, order, kind, count, raw)
    if TIFF_WIDTH not in values or TIFF_HEIGHT not in values:
        raise DamagedError("it declares no size")
    return ImageHeader("TIFF", "image/tiff", values[TIFF_WIDTH], values[TIFF_HEIGHT], values[TIFF_BITS])


def _tiff_value(data: bytes, order: str, kind: int, count: int, raw: bytes) -> int:
    """Return the first value of an entry; more values than fit its four bytes are stored elsewhere."""
    if kind == TIFF_LONG:
        (value,) = struct.unpack(f"{order}I", raw)
    elif kind == TIFF_SHORT and count <= 2:
        (value,) = struct.unpack_from(f"{order}H", raw)
    elif kind == TIFF_SHORT:
        (offset,) = struct.unpack(f"{order}I", raw)
        (value,) = struct.unpack_from(f"{order}H", data, offset)
    else:
        raise DamagedError("it declares no size")
    return int(value)


READERS: tuple[tuple[tuple[bytes, ...], Callable[[bytes], ImageHeader]], ...] = (
    ((PNG_SIGNATURE,), _read_png),
    ((JPEG_SIGNATURE,), _read_jpeg),
    (tuple(PNM_SAMPLES), _read_pnm),
    ((b"BM",), _read_bmp),
    ((b"II*\x00", b"MM\x00*"), _read_tiff),
)
