"""ROS camera_info YAML, with the names that camera_calibration_parsers reads and REP 104's models.

The camera stands alone: its rectification is none, and its projection is its own matrix.
"""

from collections.abc import Iterable

from service.core.quality.gates import Verdict
from service.usecases.exports.format import Format, headline
from service.usecases.exports.yaml_text import yaml_numbers, yaml_text
from service.usecases.finished_run import FinishedRun

MODELS = {"pinhole5": "plumb_bob", "rational8": "rational_polynomial", "kannala_brandt4": "equidistant"}
UNTURNED = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


def write(run: FinishedRun) -> bytes:
    """Return the file; raises KeyError for a lens without a model's name, which a test holds."""
    facts, intrinsics = run.facts, run.facts.intrinsics
    fx, fy, cx, cy = intrinsics.vector[:4]
    lines = [
        f"# {headline(facts)}",
        f"image_width: {intrinsics.image_size[0]}",
        f"image_height: {intrinsics.image_size[1]}",
        f"camera_name: {yaml_text(camera_name(facts.serial, facts.verdict))}",
        *_matrix("camera_matrix", 3, 3, intrinsics.camera_matrix.ravel()),
        f"distortion_model: {MODELS[intrinsics.lens]}",
        *_matrix("distortion_coefficients", 1, len(intrinsics.dist_coeffs), intrinsics.dist_coeffs),
        *_matrix("rectification_matrix", 3, 3, UNTURNED),
        *_matrix("projection_matrix", 3, 4, (fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0)),
    ]
    return ("\n".join(lines) + "\n").encode("utf-8")


def camera_name(serial: str, verdict: Verdict) -> str:
    """Return the serial as a name that ROS takes (letters, digits and _), marked where the camera failed."""
    name = "".join(c if c.isascii() and c.isalnum() else "_" for c in serial)
    return f"FAILED_{name}" if verdict is Verdict.FAIL else name


def _matrix(name: str, rows: int, columns: int, values: Iterable[float]) -> list[str]:
    return [f"{name}:", f"  rows: {rows}", f"  cols: {columns}", f"  data: {yaml_numbers(values)}"]


FORMAT = Format("ros", "ROS camera_info", "application/yaml", "yaml", write)
