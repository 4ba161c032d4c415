"""Binary blocks: written as `struct` reads them, checked before and after, refused where wrong."""

import binascii
import struct
from functools import partial
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from service.core.quality.gates import Verdict
from service.usecases.block_check import check_block
from service.usecases.block_codec import checksum, decode_field, encode_block, encode_field
from service.usecases.block_layout import BlockCrc, BlockField, BlockLayout
from service.usecases.block_sources import value_of
from service.usecases.certificate import result_hash
from service.usecases.finished_run import FinishedRun
from service.usecases.result_problems import BlockLayoutUnusable
from tests.finished import PLACE, finished_run

LAYOUT: dict[str, Any] = {
    "name": "cabin-eeprom",
    "version": 2,
    "size": 128,
    "fields": [
        {"name": "magic", "type": "ascii", "size": 4, "constant": "DMSC"},
        {"name": "version", "type": "u16", "source": "layout.version"},
        {"name": "size", "type": "u16", "source": "layout.size", "byte_order": "big"},
        {"name": "verdict", "type": "u8", "source": "run.verdict_number"},
        {"name": "fx", "type": "f32", "at": 12, "source": "intrinsics.fx"},
        {"name": "fy", "type": "f64", "source": "intrinsics.fy"},
        {"name": "cx", "type": "uq11.5", "source": "intrinsics.cx"},
        {"name": "k1", "type": "q1.14", "source": "intrinsics.k1"},
        {"name": "k2", "type": "i32", "source": "intrinsics.k2", "scale": 1e-6},
        {"name": "cy", "type": "u16", "source": "intrinsics.cy", "scale": 0.1, "offset": 100.0},
        {"name": "finished", "type": "u32", "source": "run.finished_at"},
        {"name": "serial", "type": "ascii", "size": 20, "source": "run.serial", "pad": 32},
        {"name": "hash", "type": "bytes", "size": 32, "source": "result.sha256"},
        {"name": "mark", "type": "bytes", "size": 2, "constant": "a5 5a"},
    ],
    "crc": {"kind": "crc16-ccitt-false", "at": 126, "first": 4},
}
RUN = finished_run()


def layout(**changes: Any) -> BlockLayout:
    return BlockLayout.model_validate(LAYOUT | changes)


def block(run: FinishedRun = RUN, by: BlockLayout | None = None) -> bytes:
    by = by or layout()
    return encode_block(by, partial(value_of, run, by))


def test_struct_reads_what_the_layout_says() -> None:
    found = block()

    assert len(found) == 128
    magic, version, size, verdict = struct.unpack_from("<4sH2sB", found)
    assert (magic, version, size, verdict) == (b"DMSC", 2, b"\x00\x80", 0)
    assert found[9:12] == b"\xff\xff\xff"
    fx, fy, cx, k1, k2, cy, finished = struct.unpack_from("<fdHhiHI", found, 12)
    wanted = RUN.facts.intrinsics.parameters
    assert fx == pytest.approx(wanted["fx"], rel=1e-7)
    assert fy == wanted["fy"]
    assert cx / 2**5 == pytest.approx(wanted["cx"], abs=2**-6)
    assert k1 / 2**14 == pytest.approx(wanted["k1"], abs=2**-15)
    assert k2 * 1e-6 == pytest.approx(wanted["k2"], abs=5e-7)
    assert 100 + 0.1 * cy == pytest.approx(wanted["cy"], abs=0.05)
    assert finished == int(RUN.facts.finished_at.timestamp())
    serial, digest, mark = struct.unpack_from("<20s32s2s", found, 38)
    assert serial == b"VIN-0001" + b" " * 12
    assert digest.hex() == result_hash(RUN.document)
    assert mark == b"\xa5\x5a"
    assert struct.unpack_from("<H", found, 126) == (binascii.crc_hqx(found[4:126], 0xFFFF),)


@pytest.mark.parametrize(("kind", "value"), [("crc16-ccitt-false", 0x29B1), ("crc32", 0xCBF43926)])
def test_checksums_have_the_values_of_their_catalogues(kind: str, value: int) -> None:
    crc = BlockCrc.model_validate({"kind": kind, "at": 9})

    assert checksum(crc, b"123456789") == value


@given(st.sampled_from(["u8", "i8", "u16", "i16", "u32", "i32", "u64", "i64"]), st.integers(-(2**65), 2**65))
def test_whole_numbers_fit_exactly_or_are_refused(kind: str, value: int) -> None:
    field = BlockField.model_validate({"name": "n", "type": kind, "source": "sku.revision"})
    bits = 8 * field.bytes
    low, high = (-(2 ** (bits - 1)), 2 ** (bits - 1)) if kind[0] == "i" else (0, 2**bits)

    if low <= value < high:
        assert decode_field(field, encode_field(field, value, "big"), "big") == value
    else:
        with pytest.raises(BlockLayoutUnusable, match="is not from"):
            encode_field(field, value, "big")


@given(st.sampled_from(["q3.12", "uq4.12", "q15.16", "q0.7", "q31.32"]), st.floats(-70000, 70000))
def test_fixed_point_is_right_to_half_a_step_or_refused(kind: str, value: float) -> None:
    field = BlockField.model_validate({"name": "n", "type": kind, "source": "intrinsics.fx"})
    try:
        written = encode_field(field, value, "little")
    except BlockLayoutUnusable:
        assert abs(value) > 0.49 or kind.startswith("u")
        return
    read = decode_field(field, written, "little")

    assert isinstance(read, float)
    assert abs(read - value) <= 2.0 ** -int(kind.rsplit(".", maxsplit=1)[1]) / 2 + 1e-12


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"fields": []}, "at least 1"),
        ({"size": 100}, "ends behind|behind the block"),
        ({"size": 0}, "greater than or equal to 1"),
        ({"size": 70_000}, "less than or equal to 65536"),
        ({"unknown": 1}, "Extra inputs"),
        ({"crc": {"kind": "crc8", "at": 126}}, "crc16-ccitt-false"),
        ({"crc": {"kind": "crc32", "at": 126}}, "behind the block"),
        ({"crc": {"kind": "crc32", "at": 124, "end": 128}}, "must not cover itself"),
        ({"crc": {"kind": "crc32", "at": 0}}, "covers nothing"),
        ({"crc": {"kind": "crc32", "at": 0, "first": 4, "end": 200}}, "behind the block"),
        ({"crc": {"kind": "crc32", "at": 80}}, "overlap"),
    ],
)
def test_a_layout_that_contradicts_itself_is_refused(changes: dict[str, Any], said: str) -> None:
    with pytest.raises(ValidationError, match=said):
        layout(**changes)


@pytest.mark.parametrize(
    ("field", "said"),
    [
        ({"type": "u24", "source": "intrinsics.fx"}, "not known"),
        ({"type": "q3.3", "source": "intrinsics.fx"}, "not known"),
        ({"type": "u8"}, "either a source or a constant"),
        ({"type": "u8", "source": "run.id", "constant": 1}, "either a source or a constant"),
        ({"type": "ascii", "source": "run.serial"}, "needs a size"),
        ({"type": "ascii", "size": 4, "constant": 7}, "is text"),
        ({"type": "ascii", "size": 4, "constant": "x", "scale": 2.0}, "only numbers"),
        ({"type": "bytes", "size": 4, "constant": "xyz"}, "hex"),
        ({"type": "u8", "constant": "7"}, "is a number"),
        ({"type": "u8", "size": 1, "constant": 7}, "its own size"),
        ({"type": "f32", "constant": 7, "scale": 0.0}, "must not be 0"),
        ({"type": "u8", "source": "../../etc"}, "pattern"),
    ],
)
def test_a_field_that_makes_no_sense_is_refused(field: dict[str, Any], said: str) -> None:
    with pytest.raises(ValidationError, match=said):
        layout(fields=[{"name": "n", **field}])


@pytest.mark.parametrize(
    "fields",
    [
        [{"name": "a", "type": "u32", "constant": 1}, {"name": "b", "type": "u8", "at": 3, "constant": 1}],
        [{"name": "a", "type": "u8", "constant": 1}, {"name": "a", "type": "u8", "constant": 1}],
        [{"name": "a", "type": "u32", "at": 124, "constant": 1}],
        [{"name": "crc", "type": "u8", "constant": 1}],
    ],
)
def test_fields_neither_overlap_nor_share_a_name(fields: list[dict[str, Any]]) -> None:
    with pytest.raises(ValidationError):
        layout(fields=fields)


@pytest.mark.parametrize(
    ("field", "said"),
    [
        ({"type": "u8", "source": "intrinsics.fx"}, "is not from 0 to 255"),
        ({"type": "ascii", "size": 4, "source": "run.serial"}, "takes 8 bytes and the field has 4"),
        ({"type": "u8", "source": "run.serial"}, "no number"),
        ({"type": "bytes", "size": 4, "source": "intrinsics.fx"}, "no bytes"),
        ({"type": "u8", "source": "intrinsics.k6"}, "has no 'intrinsics.k6'"),
        ({"type": "u8", "source": "nothing"}, "has no 'nothing'"),
        ({"type": "f32", "source": "intrinsics.fx", "scale": 1e-40}, "too large for f32"),
        ({"type": "u64", "source": "intrinsics.fx", "scale": 1e-20}, "whole number"),
    ],
)
def test_a_value_without_room_names_its_field_or_source(field: dict[str, Any], said: str) -> None:
    with pytest.raises(BlockLayoutUnusable, match=said):
        block(by=layout(fields=[{"name": "n", **field}]))


def test_the_place_in_the_vehicle_is_written_where_it_was_measured() -> None:
    names = ("x_m", "y_m", "z_m", "qw", "qx", "qy", "qz", "sd_x_m", "sd_rz_rad")
    fields = [{"name": name, "type": "f64", "source": f"extrinsics.{name}"} for name in names]
    by = layout(fields=fields)

    x, y, z, qw, qx, qy, qz, sd_x, sd_rz = struct.unpack_from("<9d", block(finished_run(place=PLACE), by))

    assert (x, y, z) == tuple(PLACE.pose.tvec)
    angle = np.linalg.norm(PLACE.pose.rvec)
    assert (qx, qy, qz) == pytest.approx(tuple(PLACE.pose.rvec * np.sin(angle / 2) / angle))
    assert (qw, sd_x, sd_rz) == pytest.approx((np.cos(angle / 2), 3e-4, 1e-4))
    with pytest.raises(BlockLayoutUnusable, match="nobody measured"):
        block(by=by)
    with pytest.raises(BlockLayoutUnusable, match=r"no 'extrinsics\.yaw'"):
        value_of(finished_run(place=PLACE), by, "extrinsics.yaw")


def test_a_serial_beyond_ascii_is_refused_and_never_changed() -> None:
    with pytest.raises(BlockLayoutUnusable, match="no ASCII"):
        block(finished_run(serial="VIN-Ä"))


def test_a_failed_camera_is_marked_in_its_block() -> None:
    assert block(finished_run(verdict=Verdict.FAIL))[8] == 2


def test_what_was_written_matches() -> None:
    checked = check_block(RUN, layout(), block())

    assert (checked.matches, checked.crc_holds, checked.differences) == (True, True, ())


def test_another_cameras_block_differs_in_its_values_though_its_checksum_holds() -> None:
    other = finished_run(serial="VIN-0002", fx=1351.0)

    checked = check_block(RUN, layout(), block(other))

    assert (checked.matches, checked.crc_holds) == (False, True)
    found = {one.field: one for one in checked.differences}
    assert set(found) == {"fx", "serial", "crc"}
    assert found["fx"].expected == pytest.approx(1350.1235, abs=1e-3)
    assert found["fx"].found == 1351.0
    assert (found["serial"].expected, found["serial"].found) == ("VIN-0001", "VIN-0002")
    assert found["serial"].at == 38


@pytest.mark.parametrize("place", range(128))
def test_every_changed_byte_is_named(place: int) -> None:
    changed = bytearray(block())
    changed[place] ^= 0x11

    checked = check_block(RUN, layout(), bytes(changed))

    assert not checked.matches
    assert len(checked.differences) == 1
    assert checked.crc_holds is (place < 4)


def test_an_empty_memory_is_told_field_by_field() -> None:
    checked = check_block(RUN, layout(), b"\xff" * 128)

    found = {one.field: one.found for one in checked.differences}
    assert (checked.matches, checked.crc_holds) == (False, False)
    assert (found["fx"], found["magic"], found["verdict"]) == ("nan", "ffffffff", 255)
    assert found["crc"] == "ffff"


def test_a_block_of_another_length_is_told_as_that() -> None:
    checked = check_block(RUN, layout(), block()[:-1])

    (difference,) = checked.differences
    assert (difference.field, difference.expected, difference.found) == ("size", 128, 127)
