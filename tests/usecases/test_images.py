"""Decoding uploads: pixels come out exactly, and nothing but a problem comes out of anything else."""

import struct
import zlib

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from service.core.errors import ImageFormatUnsupported, ImageTooLarge, ImageUnreadable, ServiceError
from service.usecases.images import LARGEST_BYTES, check_image, decode_image, image_sha256

LOSSLESS = (".png", ".pgm", ".bmp", ".tif")
FORMATS = (*LOSSLESS, ".jpg")


def picture(*shape: int, dtype: str = "uint8") -> NDArray[np.uint8]:
    rng = np.random.default_rng(5)
    noise = rng.integers(0, 256, shape).astype(np.float32)
    return np.asarray(cv2.GaussianBlur(noise, (0, 0), 2), dtype=dtype)


def encode(image: NDArray[np.uint8], suffix: str) -> bytes:
    done, data = cv2.imencode(suffix, image)
    assert done
    return data.tobytes()


def png_chunk(kind: bytes, body: bytes) -> bytes:
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def png_of_size(width: int, height: int, bits: int = 8) -> bytes:
    header = struct.pack(">IIBBBBB", width, height, bits, 0, 0, 0, 0)
    chunks = png_chunk(b"IHDR", header) + png_chunk(b"IDAT", zlib.compress(b"\0")) + png_chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + chunks


def decode_or_refuse(data: bytes, name: str) -> NDArray[np.uint8] | ServiceError:
    try:
        return decode_image(data, name)
    except ServiceError as error:
        return error


@pytest.mark.parametrize("suffix", LOSSLESS)
def test_lossless_formats_give_the_very_pixels(suffix: str) -> None:
    image = picture(48, 65)
    decoded = decode_image(encode(image, suffix), "a")
    assert decoded.dtype == np.uint8
    np.testing.assert_array_equal(decoded, image)


@pytest.mark.parametrize("suffix", FORMATS)
def test_the_header_says_the_size_before_anything_is_decoded(suffix: str) -> None:
    header = check_image(encode(picture(48, 65), suffix), "a")
    assert (header.width, header.height, header.bits) == (65, 48, 8)


def test_colour_becomes_grey_by_the_usual_weights() -> None:
    image = picture(40, 50, 3)
    expected = cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)
    np.testing.assert_array_equal(decode_image(encode(image, ".png"), "a"), expected)
    np.testing.assert_array_equal(decode_image(encode(image, ".ppm"), "a"), expected)


def test_an_alpha_channel_is_dropped() -> None:
    grey = picture(40, 50)
    image = np.dstack([grey, grey, grey, np.full_like(grey, 7)])
    np.testing.assert_array_equal(decode_image(encode(image, ".png"), "a"), grey)


def test_an_orientation_in_the_metadata_does_not_turn_the_sensor() -> None:
    plain = encode(picture(48, 64), ".jpg")
    entry = struct.pack(">HHIHH", 0x0112, 3, 1, 6, 0)
    exif = b"Exif\0\0MM\0*" + struct.pack(">IH", 8, 1) + entry + struct.pack(">I", 0)
    turned = plain[:2] + b"\xff\xe1" + struct.pack(">H", len(exif) + 2) + exif + plain[2:]
    np.testing.assert_array_equal(decode_image(turned, "a"), decode_image(plain, "a"))


@pytest.mark.parametrize("suffix", [".png", ".tif", ".pgm"])
def test_sixteen_bits_are_refused_with_what_to_do(suffix: str) -> None:
    with pytest.raises(ImageFormatUnsupported, match="Save it with 8 bits"):
        decode_image(encode(picture(30, 40, dtype="uint16"), suffix), "deep")


@pytest.mark.parametrize(
    "data",
    [
        png_of_size(60_000, 60_000),
        b"P5 60000 60000 255\n" + bytes(100),
        b"P2 60000 60000 255\n" + bytes(100),
        b"BM" + struct.pack("<IIIIiiHHI", 100, 0, 54, 40, 60_000, 60_000, 1, 8, 1) + bytes(100),
        b"II*\0\x08\0\0\0\x02\0" + struct.pack("<HHIIHHII", 256, 4, 1, 60_000, 257, 4, 1, 60_000),
    ],
    ids=["png", "pgm", "pgm-text", "bmp", "tiff"],
)
def test_a_small_file_that_declares_a_huge_image_is_refused_by_its_header(data: bytes) -> None:
    with pytest.raises((ImageTooLarge, ImageUnreadable)):
        decode_image(data, "bomb")


def test_a_huge_jpeg_is_refused_by_its_header() -> None:
    data = bytearray(encode(picture(48, 64), ".jpg"))
    frame = data.index(b"\xff\xc0")
    data[frame + 5 : frame + 9] = struct.pack(">HH", 60_000, 60_000)
    with pytest.raises(ImageTooLarge) as caught:
        decode_image(bytes(data), "bomb")
    assert caught.value.facts["width"] == 60_000


def test_more_bytes_than_are_accepted_are_not_even_looked_at() -> None:
    with pytest.raises(ImageTooLarge, match="MB"):
        decode_image(bytes(LARGEST_BYTES + 1), "big")


@pytest.mark.parametrize("data", [b"", b"hello", b"GIF89a" + bytes(50), b"%PDF-1.7", b"RIFF0000WEBPVP8 "])
def test_what_is_no_accepted_image_is_told_the_formats(data: bytes) -> None:
    with pytest.raises(ImageFormatUnsupported, match="PNG, JPEG, PGM"):
        decode_image(data, "notes.txt")


@pytest.mark.parametrize("suffix", FORMATS)
def test_a_file_that_is_cut_off_anywhere_is_refused(suffix: str) -> None:
    data = encode(picture(60, 80), suffix)
    for share in (0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.98):
        with pytest.raises((ImageUnreadable, ImageFormatUnsupported)):
            decode_image(data[: int(share * len(data))], "part")


@pytest.mark.parametrize("suffix", FORMATS)
@settings(max_examples=60, deadline=None)
@given(where=st.floats(0, 0.999), damage=st.binary(min_size=1, max_size=12))
def test_damage_gives_an_image_or_a_problem_and_never_a_fault(
    suffix: str, where: float, damage: bytes
) -> None:
    data = bytearray(encode(picture(24, 32), suffix))
    place = int(where * len(data))
    data[place : place + len(damage)] = damage
    outcome = decode_or_refuse(bytes(data), "damaged")
    assert "damaged" in outcome.detail if isinstance(outcome, ServiceError) else outcome.ndim == 2


@settings(max_examples=200, deadline=None)
@given(
    start=st.sampled_from(
        [b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff", b"P5", b"P2 3 3 255\n", b"BM", b"II*\0", b"MM\0*"]
    ),
    rest=st.binary(max_size=200),
)
def test_whatever_follows_a_signature_is_no_fault(start: bytes, rest: bytes) -> None:
    outcome = decode_or_refuse(start + rest, "odd")
    assert "odd" in outcome.detail if isinstance(outcome, ServiceError) else outcome.ndim == 2


def test_the_hash_is_that_of_the_file() -> None:
    assert image_sha256(b"abc").startswith("ba7816bf")
