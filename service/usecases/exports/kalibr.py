"""Kalibr's camchain YAML of one camera: `pinhole` with `radtan` (k1 k2 p1 p2) or `equidistant` (k1 k2 k3 k4).

Kalibr has no k3 of Brown's polynomial and no rational lens. Leaving a coefficient out would be another
camera, so that such results are refused.
"""

from collections.abc import Sequence

from service.core.vision.camera import Intrinsics
from service.usecases.exports.format import Format, headline
from service.usecases.exports.yaml_text import yaml_numbers
from service.usecases.finished_run import FinishedRun
from service.usecases.result_problems import FormatCannotSay

TOPIC = "/cam0/image_raw"


def write(run: FinishedRun) -> bytes:
    """Return the file; raises FormatCannotSay for a lens that Kalibr has not."""
    intrinsics = run.facts.intrinsics
    model, coefficients = distortion(intrinsics)
    width, height = intrinsics.image_size
    lines = [
        f"# {headline(run.facts)}",
        "cam0:",
        "  cam_overlaps: []",
        "  camera_model: pinhole",
        f"  distortion_coeffs: {yaml_numbers(coefficients)}",
        f"  distortion_model: {model}",
        f"  intrinsics: {yaml_numbers(intrinsics.vector[:4])}",
        f"  resolution: [{width}, {height}]",
        f"  rostopic: {TOPIC}",
    ]
    return ("\n".join(lines) + "\n").encode("utf-8")


def distortion(intrinsics: Intrinsics) -> tuple[str, Sequence[float]]:
    """Return Kalibr's name of a distortion and its coefficients; raises FormatCannotSay."""
    coefficients = [float(value) for value in intrinsics.dist_coeffs]
    if intrinsics.lens == "kannala_brandt4":
        return "equidistant", coefficients
    if intrinsics.lens == "pinhole5" and coefficients[4] == 0.0:
        return "radtan", coefficients[:4]
    why = f"a k3 of {coefficients[4]:g}" if intrinsics.lens == "pinhole5" else f"the lens {intrinsics.lens}"
    raise FormatCannotSay(
        f"Kalibr has no words for {why}: its radtan is k1 k2 p1 p2, its equidistant k1 k2 k3 k4. Take "
        "another format, or let a new revision of the SKU fix k3 at 0.",
        format=FORMAT.name,
        lens=intrinsics.lens,
    )


FORMAT = Format("kalibr", "Kalibr camchain", "application/yaml", "yaml", write)
