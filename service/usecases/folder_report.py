"""The outcome of a folder's calibration as one JSON object, and as text for people.

Text is plain ASCII, so that it can be read on any terminal. Not here: printing (cli).
"""

from collections.abc import Iterator
from dataclasses import asdict
from math import degrees
from typing import Any

from service.core.quality.gates import Measurement
from service.usecases.extrinsics_document import extrinsics_document
from service.usecases.folder_calibration import FolderCalibration
from service.usecases.observation import number_or_null
from service.usecases.result_document import versions

JsonObject = dict[str, Any]
PIXEL_PARAMETERS = frozenset({"fx", "fy", "cx", "cy"})


def report_document(calibration: FolderCalibration) -> JsonObject:
    """Return all of a folder's calibration as JSON; NaN and infinity are null."""
    judged = calibration.judged
    result = judged.result
    zone, valid = judged.zone_mapping, judged.valid_mapping
    return {
        "verdict": judged.verdict.value,
        "lens": result.intrinsics.lens,
        "target": calibration.target.spec,
        "image_size": list(result.intrinsics.image_size),
        "intrinsics": result.intrinsics.parameters,
        "sd": {name: number_or_null(value) for name, value in result.sd.items()},
        "fixed": list(result.fixed),
        "rms_px": result.rms_px,
        "sigma_px": result.sigma_px,
        "mapping": {
            "zone_mean_px": number_or_null(zone.mean_px),
            "zone_worst_px": number_or_null(zone.worst_px),
            "valid_mean_px": number_or_null(valid.mean_px),
            "valid_worst_px": number_or_null(valid.worst_px),
        },
        "score": judged.score,
        "extrinsics": _extrinsics_document(calibration),
        "gates": [asdict(measurement) for measurement in judged.measurements],
        "images": [{**asdict(image), "status": image.status} for image in calibration.images],
        "starts": [{**asdict(start), "rms_px": number_or_null(start.rms_px)} for start in result.starts],
        "agreement_px": number_or_null(result.agreement_px),
        "versions": versions(),
    }


def report_text(calibration: FolderCalibration) -> str:
    """Return the report for people: verdict, intrinsics with their sd, gates, refused images."""
    return "\n".join(
        [
            *_headline(calibration),
            "",
            *_intrinsics(calibration),
            "",
            *_extrinsics(calibration),
            *_gates(calibration.judged.measurements),
            *_refused(calibration),
        ]
    )


def _headline(calibration: FolderCalibration) -> Iterator[str]:
    judged = calibration.judged
    width, height = judged.result.intrinsics.image_size
    word = "   ".join(judged.verdict.value)
    yield "=" * (len(word) + 12)
    yield f"      {word}"
    yield "=" * (len(word) + 12)
    yield (
        f"{len(judged.views)} of {len(calibration.images)} images used, {width}x{height} px, "
        f"{calibration.target.spec}, lens {judged.result.intrinsics.lens}"
    )
    for measurement in judged.measurements:
        if measurement.verdict is judged.verdict and measurement.verdict.value != "PASS":
            yield f"  * {measurement.advice}"


def _intrinsics(calibration: FolderCalibration) -> Iterator[str]:
    result = calibration.judged.result
    yield f"{'Intrinsics':<12}{'value':>14}{'sd':>12}"
    sd = result.sd
    for name, value in result.intrinsics.parameters.items():
        in_pixels = name in PIXEL_PARAMETERS
        decimals, unit = (3, " px") if in_pixels else (6, "")
        deviation = "fixed" if name in result.fixed else f"{sd[name]:.{decimals}f}"
        yield f"  {name:<10}{value:>14.{decimals}f}{deviation:>12}{unit}"
    zone, valid = calibration.judged.zone_mapping, calibration.judged.valid_mapping
    yield f"RMS error {result.rms_px:.4f} px, corner noise {result.sigma_px:.4f} px"
    yield (
        f"Expected mapping error: {zone.mean_px:.3f} px over the working zone, "
        f"at most {valid.worst_px:.3f} px in the valid region"
    )
    if calibration.judged.score is not None:
        yield (
            f"Score of the paper {calibration.judged.score:.4f}, "
            f"{calibration.judged.score_difference_px:.3f} px from the nominal camera"
        )


def _extrinsics_document(calibration: FolderCalibration) -> JsonObject | None:
    """Return where the camera is in the vehicle; its pictures have no ids, only names."""
    judged = calibration.judged
    if judged.extrinsics is None or calibration.fixture is None:
        return None
    names = {name: name for name in judged.fixed_views}
    document = extrinsics_document(judged.extrinsics, list(names), names, calibration.fixture.to_json())
    for view in document["views"]:
        del view["capture_id"]
    return document


def _extrinsics(calibration: FolderCalibration) -> Iterator[str]:
    document = _extrinsics_document(calibration)
    if document is None:
        return
    yield f"{'Extrinsics':<12}{'value':>14}{'sd':>12}  T_vehicle_cam"
    places = zip(document["pose"]["tvec"], document["translation_sd_mm"], strict=True)
    for axis, (place, sd) in zip("xyz", places, strict=True):
        yield f"  {axis:<10}{1000.0 * place:>14.3f}{sd:>12.3f} mm"
    turns = zip(document["pose"]["rvec"], document["rotation_sd_mdeg"], strict=True)
    for axis, (turn, sd_mdeg) in zip("xyz", turns, strict=True):
        yield f"  {'turn ' + axis:<10}{degrees(turn):>14.4f}{sd_mdeg / 1000.0:>12.4f} deg"
    parts = document["parts"]
    for name in ("translation_sd_mm", "rotation_sd_mdeg"):
        sources = ", ".join(f"{source} {part[name]:.3g}" for source, part in parts.items())
        yield f"  {name} by source: {sources}"
    yield (
        f"{len(document['views'])} picture(s) of {document['fixture']['target']}, "
        f"RMS error {document['rms_px']:.4f} px"
    )
    yield ""


def _gates(measurements: tuple[Measurement, ...]) -> Iterator[str]:
    yield f"{'Gate':<12}{'measurement':<23}{'value':>12}    {'limit':<10}{'':<13}{'verdict'}"
    for one in measurements:
        value = "unknown" if one.value is None else f"{one.value:.4g}"
        limit = "" if one.limit is None else f"{one.comparison} {one.limit:.4g}"
        verdict = "reported" if one.limit is None else one.verdict.value
        yield f"{one.gate:<12}{one.name:<23}{value:>12}    {limit:<10}{one.unit:<13}{verdict}"


def _refused(calibration: FolderCalibration) -> Iterator[str]:
    refused = [image for image in calibration.images if image.status == "refused"]
    if not refused:
        return
    yield ""
    yield "Images that were not used"
    for image in refused:
        yield f"  {image.name}: {image.detail}"
