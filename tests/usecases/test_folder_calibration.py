"""Folders of images: what is read, what is refused by name, and what comes out of real ones."""

import json
import os
import shutil
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

from service.core.errors import FolderUnusable, IntrinsicsInvalid, TooFewViews
from service.core.quality.gates import Verdict
from service.core.vision.camera import LENSES
from service.core.vision.target import parse_target
from service.core.vision.transforms import Pose, stack_poses
from service.simulator.renderer import prepare
from service.simulator.scene import production_scene
from service.usecases.folder_calibration import FolderCalibration, calibrate_folder, list_images
from service.usecases.folder_report import report_document, report_text
from service.usecases.sku_document import SkuDocument
from tests.core.quality.seen_views import BOARD, CAMERA, NOMINAL, POSES

REAL = Path(__file__).resolve().parents[3] / "shared" / "data"


def real_images(folder: str, pattern: str, into: Path) -> Path:
    """Link some images of a real set into a folder; skips where the sets are absent."""
    if not REAL.is_dir() and "CI" not in os.environ:
        pytest.skip(f"no real images at {REAL}")
    for path in sorted((REAL / folder).glob(pattern)):
        (into / path.name).symlink_to(path)
    return into


@pytest.fixture(scope="module")
def rendered(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a rendered image of each of twelve poses."""
    folder = tmp_path_factory.mktemp("rendered")
    rng = np.random.default_rng(8)
    scene = prepare(production_scene(CAMERA, BOARD, seed=8))
    for i, pose in enumerate(POSES):
        assert cv2.imwrite(str(folder / f"{i}.png"), scene.render(pose, rng))
    return folder


@pytest.fixture(scope="module")
def calibrated(rendered: Path) -> FolderCalibration:
    return calibrate_folder(rendered, BOARD, "pinhole5")


def test_a_rendered_camera_is_found_within_its_uncertainty(calibrated: FolderCalibration) -> None:
    result = calibrated.judged.result
    for name in ("fx", "fy", "cx", "cy"):
        off = abs(result.intrinsics.parameters[name] - CAMERA.parameters[name])
        assert off < 3.5 * result.sd[name], name
        assert off < 0.5, name
    assert calibrated.judged.verdict is Verdict.PASS


def test_images_come_in_the_order_people_count(calibrated: FolderCalibration) -> None:
    assert [image.name for image in calibrated.images] == [f"{i}.png" for i in range(len(POSES))]
    assert all(image.status == "used" and image.rms_px for image in calibrated.images)


def test_a_folder_of_parts_of_a_coded_board_is_calibrated(tmp_path: Path) -> None:
    board = parse_target("aprilgrid:5x4:32mm:0.3")
    rng = np.random.default_rng(8)
    scene = prepare(production_scene(CAMERA, board, seed=8))
    for i, pose in enumerate(POSES):
        nearer = Pose(pose.rvec, pose.tvec - pose.rotation @ (board.centre - BOARD.centre))
        assert cv2.imwrite(str(tmp_path / f"{i}.png"), scene.render(nearer, rng))

    judged = calibrate_folder(tmp_path, board, "pinhole5").judged

    assert judged.verdict is not Verdict.FAIL
    seen = [len(view.detection.corner_ids) for view in judged.views]
    assert len(seen) == len(POSES)
    assert min(seen) < 80 == max(seen)
    for name in ("fx", "fy", "cx", "cy"):
        off = abs(judged.result.intrinsics.parameters[name] - CAMERA.parameters[name])
        assert off < 4.0 * judged.result.sd[name], name


def test_a_sku_adds_its_gates(rendered: Path) -> None:
    document = {
        "code": "lens1",
        "name": "Lens 1",
        "lens": "pinhole5",
        "image_size": [1280, 800],
        "nominal": NOMINAL.parameters,
        "target": BOARD.spec,
    }
    revision = SkuDocument.model_validate(document).to_revision()
    judged = calibrate_folder(rendered, BOARD, "pinhole5", revision=revision).judged
    names = {one.name for one in judged.measurements}
    assert {"coverage", "paper_score"} <= names
    assert "missing_poses" not in names
    assert judged.verdict is Verdict.PASS


def test_what_cannot_be_used_is_refused_by_name_and_the_rest_goes_on(rendered: Path, tmp_path: Path) -> None:
    for path in rendered.iterdir():
        (tmp_path / path.name).symlink_to(path)
    whole = (rendered / "0.png").read_bytes()
    (tmp_path / "cut.png").write_bytes(whole[: len(whole) // 2])
    (tmp_path / "notes.jpg").write_text("no image")
    (tmp_path / "notes.txt").write_text("nobody asks for this")
    cv2.imwrite(str(tmp_path / "blank.png"), np.full((800, 1280), 128, np.uint8))
    image = cv2.imread(str(rendered / "0.png"), cv2.IMREAD_GRAYSCALE)
    assert image is not None
    cv2.imwrite(str(tmp_path / "deep.png"), image.astype(np.uint16) * 256)
    cv2.imwrite(str(tmp_path / "odd.png"), np.pad(image, 1))
    calibration = calibrate_folder(tmp_path, BOARD, "pinhole5")
    refused = {image.name: image.reason for image in calibration.images if image.status == "refused"}
    assert refused == {
        "cut.png": "image-unreadable",
        "notes.jpg": "image-format-unsupported",
        "blank.png": "target-not-visible",
        "deep.png": "image-format-unsupported",
        "odd.png": "wrong-image-size",
    }
    assert calibration.judged.verdict is Verdict.MARGINAL
    text = report_text(calibration)
    assert all(f"{name}: " in text for name in refused)


def test_a_copied_image_fails_as_a_copy(rendered: Path, tmp_path: Path) -> None:
    for path in rendered.iterdir():
        (tmp_path / path.name).symlink_to(path)
    shutil.copy(rendered / "3.png", tmp_path / "copy.png")
    judged = calibrate_folder(tmp_path, BOARD, "pinhole5").judged
    (found,) = [one for one in judged.measurements if one.name == "view_separation_px"]
    assert found.verdict is Verdict.FAIL
    assert "copy.png" in found.advice


def test_the_document_is_json_without_nan(calibrated: FolderCalibration) -> None:
    document = json.loads(json.dumps(report_document(calibrated), allow_nan=False))
    assert document["verdict"] == "PASS"
    assert list(document["intrinsics"]) == list(document["sd"])
    assert set(document["gates"][0]) == {
        "gate", "name", "value", "unit", "limit", "comparison", "margin", "verdict", "advice",
        "reason", "facts",
    }  # fmt: skip
    assert set(document["images"][0]) == {"name", "status", "reason", "detail", "rms_px"}
    assert {"lens", "image_size", "sigma_px", "rms_px", "mapping", "score", "versions"} <= set(document)


def test_the_text_shows_the_verdict_and_every_measurement(calibrated: FolderCalibration) -> None:
    text = report_text(calibrated)
    assert text.isascii()
    assert "P   A   S   S" in text
    assert all(one.name in text for one in calibrated.judged.measurements)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda path: path, "does not exist"),
        (lambda path: path.write_text("x"), "is a file"),
        (lambda path: path.mkdir(), "holds no images"),
    ],
    ids=["unknown", "file", "empty"],
)
def test_a_folder_that_is_none_is_told_as_such(
    tmp_path: Path, make: Callable[[Path], object], said: str
) -> None:
    path = tmp_path / "folder"
    make(path)
    with pytest.raises(FolderUnusable, match=said):
        list_images(path)


def test_a_wrong_request_is_refused_before_any_image_is_read(tmp_path: Path) -> None:
    with pytest.raises(IntrinsicsInvalid, match="Cannot fix k9"):
        calibrate_folder(tmp_path / "absent", BOARD, "pinhole5", fixed=("k9",))


@pytest.mark.data
@pytest.mark.parametrize(
    ("pattern", "expected"),
    [("left*.jpg", (532.9, 533.0, 342.4, 233.9)), ("right*.jpg", (537.4, 537.0, 327.3, 249.0))],
)
def test_opencvs_cameras_come_out_as_known(tmp_path: Path, pattern: str, expected: tuple[float, ...]) -> None:
    folder = real_images("opencv_left_right", pattern, tmp_path)
    judged = calibrate_folder(folder, parse_target("chessboard:9x6"), "pinhole5").judged
    assert judged.result.rms_px <= 0.175
    np.testing.assert_allclose(judged.result.intrinsics.vector[:4], expected, atol=1.5)
    assert judged.verdict is not Verdict.FAIL


@pytest.mark.data
def test_the_curled_paper_fails_and_is_called_not_flat(tmp_path: Path) -> None:
    folder = real_images("udacity_lanes_9x6", "*.jpg", tmp_path)
    calibration = calibrate_folder(folder, parse_target("chessboard:9x6"), "pinhole5")
    (found,) = [one for one in calibration.judged.measurements if one.name == "rms_px"]
    assert found.verdict is Verdict.FAIL
    assert "not flat" in found.advice
    sizes = [image.name for image in calibration.images if image.reason == "wrong-image-size"]
    assert sizes == ["calibration7.jpg", "calibration15.jpg"]


@pytest.mark.data
def test_the_fisheye_fails_on_the_model(tmp_path: Path) -> None:
    folder = real_images("boofcv_fisheye_chess", "*.jpg", tmp_path)
    judged = calibrate_folder(folder, parse_target("chessboard:6x4"), "pinhole5").judged
    failed = {one.gate for one in judged.measurements if one.verdict is Verdict.FAIL}
    assert {"fit", "model"} <= failed


@pytest.mark.data
def test_the_fisheye_fits_a_fisheye_model(tmp_path: Path) -> None:
    folder = real_images("boofcv_fisheye_chess", "*.jpg", tmp_path)
    judged = calibrate_folder(folder, parse_target("chessboard:6x4:30mm"), "kannala_brandt4").judged
    assert len(judged.views) == 26
    assert judged.result.converged
    assert judged.result.rms_px < 0.25
    assert judged.valid_mapping.worst_px < 0.3
    failed = {one.gate for one in judged.measurements if one.verdict is Verdict.FAIL}
    assert failed <= {"sharpness"}  # one picture is a little blurred
    rotations, translations = stack_poses(judged.result.poses)
    points = np.swapaxes(rotations @ parse_target("chessboard:6x4:30mm").object_points.T, 1, 2)
    farthest = LENSES["kannala_brandt4"].radius(points + translations[:, None]).max()
    assert np.degrees(farthest) > 90.0  # corners behind the camera's own plane


@pytest.mark.data
def test_roads_are_no_calibration_and_are_named(tmp_path: Path) -> None:
    folder = real_images("neg_udacity_road", "*.jpg", tmp_path)
    with pytest.raises(TooFewViews) as caught:
        calibrate_folder(folder, parse_target("chessboard:9x6:25mm"), "pinhole5")
    names = [path.name for path in list_images(folder)]
    assert caught.value.facts["refused"] == names
    assert caught.value.facts["reasons"] == ["target-not-visible"] * len(names)
    assert all(name in caught.value.detail for name in names)
