from typing import Any

import pytest
from pydantic import ValidationError

from service.core.planning.fixture import Box
from service.core.vision.camera import LENSES
from service.core.vision.tolerance import Tolerance
from service.usecases.sku_document import EXAMPLE, SkuDocument
from tests.plant import SKU


def test_the_example_is_a_valid_document() -> None:
    revision = SkuDocument.model_validate(EXAMPLE).to_revision()

    assert revision.intrinsics.parameters["fx"] == 1350.1
    assert revision.target.spec == "chessboard:9x6:25mm"
    assert list(revision.pose_space.yaw_deg) == [-45, 45]
    assert revision.limits.rms_px == 0.35


def test_a_document_survives_its_way_through_the_database() -> None:
    document = SkuDocument.model_validate(SKU)

    assert SkuDocument.model_validate(document.model_dump(mode="json")) == document
    assert SkuDocument.model_validate_json(document.model_dump_json()) == document


def test_what_is_not_given_takes_the_defaults_of_the_image_size() -> None:
    small = SkuDocument.model_validate(EXAMPLE).to_revision()
    large = SkuDocument.model_validate({**as_dict(EXAMPLE), "image_size": [1920, 1208]}).to_revision()

    assert (small.limits.zone_mapping_px, large.limits.zone_mapping_px) == (0.30, 0.40)
    assert (small.working_zone, small.fixed, small.pose_count) == (None, (), 12)


def test_every_lens_of_the_registry_may_be_declared_and_is_in_the_schema() -> None:
    for lens in LENSES:
        document = {**as_dict(EXAMPLE), "lens": lens}
        assert SkuDocument.model_validate(document).to_revision().intrinsics.lens == lens
    assert SkuDocument.model_json_schema()["properties"]["lens"]["enum"] == list(LENSES)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"code": "Lens 1"}, "pattern"),
        ({"name": "A\u0000B"}, "U+0000"),
        ({"name": ""}, "at least 1"),
        ({"lens": "fisheye"}, "pinhole5, rational8, kannala_brandt4"),
        ({"lens": 5}, "valid string"),
        ({"lens": "kannala_brandt4", "fixed": ["p1"]}, "p1"),
        ({"image_size": [1280]}, "Field required"),
        ({"image_size": [1280.5, 800]}, "integer"),
        ({"image_size": [1280, 10**9]}, "less than or equal"),
        ({"nominal": {"fx": 1000}}, "missing: fy, cx, cy"),
        ({"nominal": {"fx": -1, "fy": 1, "cx": 1, "cy": 1}}, "positive"),
        ({"nominal": {"fx": float("nan"), "fy": 1, "cx": 1, "cy": 1}}, "finite"),
        ({"nominal": {"fx": float("inf"), "fy": 1, "cx": 1, "cy": 1}}, "finite"),
        ({"nominal": {"fx": 1e300, "fy": 1, "cx": 1, "cy": 1}}, "less than or equal"),
        ({"nominal": {"fx": "1000", "fy": 1, "cx": 1, "cy": 1}}, "valid number"),
        ({"nominal": {"fx": 1, "fy": 1, "cx": 1, "cy": 1, "k9": 0}}, "unknown: k9"),
        ({"target": "chessboard"}, "chessboard:COLUMNSxROWS"),
        ({"target": "chessboard:2x6:25mm"}, "3x3"),
        ({"pose_count": 2}, "greater than or equal to 3"),
        ({"pose_count": True}, "valid integer"),
        ({"pose_space": {"yaw_deg": [45, -45]}}, "[smallest, largest]"),
        ({"pose_space": {"distance": [1, 2]}}, "not permitted"),
        ({"pose_space": {"distance_m": [0, 1]}}, "greater than 0"),
        ({"pose_space": {"depth_of_field_m": [0.9, 0.3]}}, "[smallest, largest]"),
        ({"pose_space": {"excluded_boxes": [{"low_m": [0, 1, 0], "high_m": [1, 0, 1]}]}}, "at most that"),
        ({"nominal": {}}, "missing: fx, fy, cx, cy"),
        ({"nominal": {}, "data_sheet": {"hfov_deg": 190}}, "190 degrees is impossible"),
        ({"tolerance": {"focal_share": -0.1}}, "greater than or equal"),
        ({"tolerance": {"focal": 0.1}}, "not permitted"),
        ({"required_mapping_px": 0}, "greater than 0"),
        ({"corner_noise_px": 0}, "greater than 0"),
        ({"fixed": ["k9"]}, "k9"),
        ({"limits": {"rms": 1}}, "rms_px"),
        ({"limits": {"rms_px": -1}}, "rms_px"),
        ({"limits": {"rms_px": "0.3"}}, "rms_px"),
        ({"working_zone": {"left_px": 5, "top_px": 0, "right_px": 5, "bottom_px": 9}}, "smaller"),
        ({"colour": "blue"}, "not permitted"),
    ],
)
def test_a_wrong_document_is_refused_with_words_that_help(change: dict[str, Any], words: str) -> None:
    with pytest.raises(ValidationError) as refusal:
        SkuDocument.model_validate({**as_dict(EXAMPLE), **change})

    assert words in str(refusal.value)


def test_a_data_sheet_stands_in_for_a_nominal_that_is_not_given() -> None:
    document = {**as_dict(EXAMPLE), "data_sheet": {"hfov_deg": 90.0}}
    given = SkuDocument.model_validate(document)
    del document["nominal"]
    derived = SkuDocument.model_validate(document)

    assert given.nominal == as_dict(EXAMPLE)["nominal"]
    assert derived.nominal["fx"] == pytest.approx(640.0)
    assert SkuDocument.model_validate_json(derived.model_dump_json()) == derived


def test_the_required_accuracy_is_by_default_where_the_gate_still_passes() -> None:
    revision = SkuDocument.model_validate(EXAMPLE).to_revision()
    strict = SkuDocument.model_validate({**as_dict(EXAMPLE), "required_mapping_px": 0.05}).to_revision()

    assert revision.required_mapping_px == pytest.approx(0.8 * 0.30)
    assert strict.required_mapping_px == 0.05


def test_a_fixture_a_depth_of_field_and_a_tolerance_become_the_cores_values() -> None:
    box = {"low_m": [-1.0, 0.2, 0.0], "high_m": [1.0, 0.5, 2.0]}
    space = {"excluded_boxes": [box], "depth_of_field_m": [0.3, 0.8]}
    change = {"pose_space": space, "tolerance": {"focal_share": 0.01, "coefficients": {"k1": 0.02}}}
    revision = SkuDocument.model_validate({**as_dict(EXAMPLE), **change}).to_revision()

    assert revision.pose_space.excluded_boxes == (Box((-1.0, 0.2, 0.0), (1.0, 0.5, 2.0)),)
    assert revision.pose_space.depth_of_field_m == (0.3, 0.8)
    assert (revision.tolerance.focal_share, revision.tolerance.coefficients) == (0.01, {"k1": 0.02})
    assert revision.tolerance.centre_px == Tolerance().centre_px


def as_dict(document: Any) -> dict[str, Any]:
    """The example, whose type is any JSON."""
    assert isinstance(document, dict)
    return document
