from typing import Any

import pytest
from pydantic import ValidationError

from service.core.vision.camera import LENSES
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


def as_dict(document: Any) -> dict[str, Any]:
    """The example, whose type is any JSON."""
    assert isinstance(document, dict)
    return document
