"""Codes of everything that a gate can say, so that a user interface says it in its user's language.

A code stands for what PASS means, what is wrong and what to do. Most measurements have one, of their own
name; some have more, because what to do depends on the likely cause. Codes are stored with results, so they
are never renamed. Not here: the sentences themselves (gates_*.py in English, web/src/words in each language).
"""

from collections.abc import Mapping, Sequence
from enum import StrEnum

Fact = str | int | float | Sequence[str] | Sequence[int]
Facts = Mapping[str, Fact]
"""What a sentence names besides value and limit, such as `views`; NaN and infinity never."""


class Reason(StrEnum):
    """What a measurement says; by default the code is its name."""

    WRONG_TARGET = "wrong_target"
    REFUSED_IMAGES = "refused_images"
    FACING = "facing"
    NEAREST_CORNER = "nearest_corner"
    PARITY_SEPARATION = "parity_separation"
    CONTRAST = "contrast"
    SATURATED_SHARE = "saturated_share"
    EDGE_WIDTH = "edge_width_px"
    BLURRED_LENS = "blurred_lens"  # most views are blurred
    QUADRANT_RATIO = "quadrant_ratio"
    MISSING_POSES = "missing_poses"
    EARLY_FINISH = "early_finish"  # poses are missing, and the accuracy is proven without them
    MATCH = "match_px"
    VIEW_SEPARATION = "view_separation_px"
    IMAGE_COVERAGE = "image_coverage"
    COVERAGE = "coverage"
    RMS = "rms_px"
    RMS_NO_OPTIMUM = "rms_no_optimum"
    RMS_BENT_BOARD = "rms_bent_board"
    RMS_OTHER_LENS = "rms_other_lens"
    SMALLEST_RMS = "smallest_rms_px"
    WORST_VIEW_RATIO = "worst_view_ratio"
    OUTLIER_SHARE = "outlier_share"
    BOARD_BEND = "board_bend"
    FOCAL_SD_SHARE = "focal_sd_share"
    CENTRE_SD = "centre_sd_px"
    ZONE_MAPPING = "zone_mapping_px"
    VALID_MAPPING = "valid_mapping_px"
    CONVERGED = "converged"
    AGREEMENT = "agreement_px"
    MONOTONE_RATIO = "monotone_ratio"
    SQUARE_PIXELS = "square_pixels"
    BIAS_RATIO = "bias_ratio"
    NEIGHBOUR_CORRELATION = "neighbour_correlation"
    HALF_DIFFERENCE = "half_difference"
    HELD_OUT_RATIO = "held_out_ratio"
    FOCAL_OFF_SHARE = "focal_off_share"
    CENTRE_OFF = "centre_off_px"
    OTHER_SKU = "other_sku"
    POPULATION_UNITS = "population_units"
    POPULATION_DISTANCE = "population_distance"
    OTHER_POPULATION = "other_population"
    OTHER_POPULATION_TWIN = "other_population_twin"  # no picture tells the two SKUs apart
    USED_ELSEWHERE = "used_elsewhere"
    TRANSLATION_SD = "translation_sd_mm"
    ROTATION_SD = "rotation_sd_mdeg"
    MOUNTING_OFF = "mounting_off_mm"
    MOUNTING_TURNED = "mounting_off_mdeg"
    EXTRINSICS_RMS = "extrinsics_rms_px"
    IMAGE_AGREEMENT = "image_agreement_px"
    TILT_AMBIGUITY = "tilt_ambiguity"
    PAPER_SCORE = "paper_score"
    NOMINAL_DIFFERENCE = "nominal_difference_px"
