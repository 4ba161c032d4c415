"""Text formats are read by their consumers' own parsers, with every digit."""

import csv
import hashlib
import io
import json
from dataclasses import replace
from typing import Any
from uuid import UUID

import cv2
import numpy as np
import pytest
import yaml

from service.core.quality.gates import Verdict
from service.core.vision.camera import LENSES, parameter_names, project_camera_points
from service.usecases.certificate import certificate_content, result_hash
from service.usecases.exports import csv_file, kalibr, opencv, ros, stored_json
from service.usecases.exports.yaml_text import yaml_number
from service.usecases.finished_run import FinishedRun
from service.usecases.result_problems import FormatCannotSay
from tests.fakes import START
from tests.finished import PLACE, finished_run

# Directions that every lens sees.
POINTS = np.array([[0.1, -0.2, 1.0], [-0.3, 0.15, 0.9], [0.0, 0.0, 0.5]])
# What ROS reads, and in which shape.
ROS_MATRICES = {
    "camera_matrix": (3, 3),
    "distortion_coefficients": (1, None),
    "rectification_matrix": (3, 3),
    "projection_matrix": (3, 4),
}


def storage(content: bytes) -> cv2.FileStorage:
    return cv2.FileStorage(content.decode(), cv2.FILE_STORAGE_READ | cv2.FILE_STORAGE_MEMORY)


def as_yaml(content: bytes) -> Any:
    return yaml.safe_load(content)


def expected_pixels(run: FinishedRun) -> np.ndarray:
    return project_camera_points(run.facts.intrinsics, POINTS)


@pytest.mark.parametrize("lens", LENSES)
def test_opencv_reads_its_file_and_projects_as_we_do(lens: str) -> None:
    run = finished_run(lens, serial='VIN-"1"/ä #')
    file = storage(opencv.write(run))
    K = file.getNode("camera_matrix").mat()
    D = file.getNode("distortion_coefficients").mat()

    assert np.array_equal(K, run.facts.intrinsics.camera_matrix)
    assert np.array_equal(D.ravel(), run.facts.intrinsics.dist_coeffs)
    assert D.shape == (len(parameter_names(lens)) - 4, 1)
    assert (file.getNode("image_width").real(), file.getNode("image_height").real()) == (1280, 800)
    assert file.getNode("serial").string() == 'VIN-"1"/ä #'
    assert file.getNode("verdict").string() == "PASS"
    still = np.zeros(3)
    if file.getNode("distortion_model").string() == "opencv_fisheye":
        pixels, _ = cv2.fisheye.projectPoints(POINTS[None], still, still, K, D)
    else:
        pixels, _ = cv2.projectPoints(POINTS, still, still, K, D)
    assert np.allclose(pixels.reshape(-1, 2), expected_pixels(run), atol=1e-9)


def test_opencv_reads_where_the_camera_is_in_the_vehicle() -> None:
    run = finished_run(place=replace(PLACE, later_id=UUID(int=5)))
    file = storage(opencv.write(run))

    assert np.array_equal(file.getNode("T_vehicle_cam").mat(), PLACE.pose.matrix)
    assert np.array_equal(file.getNode("T_vehicle_cam_covariance").mat(), PLACE.covariance)
    assert file.getNode("T_vehicle_cam_measured").string() == f"extrinsics {UUID(int=5)}"
    assert storage(opencv.write(finished_run())).getNode("T_vehicle_cam").isNone()


@pytest.mark.parametrize(
    ("lens", "model", "count"),
    [
        ("pinhole5", "plumb_bob", 5),
        ("rational8", "rational_polynomial", 8),
        ("kannala_brandt4", "equidistant", 4),
    ],
)
def test_ros_gets_the_names_and_models_of_rep_104(lens: str, model: str, count: int) -> None:
    run = finished_run(lens, serial="VIN-1/Ä")
    found = as_yaml(ros.write(run))

    assert set(found) == {"image_width", "image_height", "camera_name", "distortion_model", *ROS_MATRICES}
    assert (found["image_width"], found["image_height"], found["distortion_model"]) == (1280, 800, model)
    assert found["camera_name"] == "VIN_1__"
    for name, (rows, columns) in ROS_MATRICES.items():
        matrix = found[name]
        assert (matrix["rows"], matrix["cols"]) == (rows, columns or count)
        assert len(matrix["data"]) == matrix["rows"] * matrix["cols"]
        assert all(isinstance(value, float) for value in matrix["data"]), name
    K = np.array(found["camera_matrix"]["data"]).reshape(3, 3)
    assert np.array_equal(K, run.facts.intrinsics.camera_matrix)
    assert found["distortion_coefficients"]["data"] == run.facts.intrinsics.dist_coeffs.tolist()
    P = np.array(found["projection_matrix"]["data"]).reshape(3, 4)
    assert np.array_equal(P, np.hstack([K, np.zeros((3, 1))]))
    assert found["rectification_matrix"]["data"] == np.eye(3).ravel().tolist()


@pytest.mark.parametrize(
    ("run", "model", "count"),
    [(finished_run("pinhole5", k3=0.0), "radtan", 4), (finished_run("kannala_brandt4"), "equidistant", 4)],
    ids=["radtan", "equidistant"],
)
def test_kalibr_gets_a_camchain_of_its_own_models(run: FinishedRun, model: str, count: int) -> None:
    (chain,) = as_yaml(kalibr.write(run)).values()

    assert (chain["camera_model"], chain["distortion_model"]) == ("pinhole", model)
    assert chain["intrinsics"] == run.facts.intrinsics.vector[:4].tolist()
    assert chain["distortion_coeffs"] == run.facts.intrinsics.dist_coeffs[:count].tolist()
    assert chain["resolution"] == [1280, 800]
    assert chain["rostopic"].startswith("/")


@pytest.mark.parametrize(
    "run", [finished_run("pinhole5"), finished_run("rational8")], ids=["k3", "rational8"]
)
def test_kalibr_refuses_what_it_has_no_words_for(run: FinishedRun) -> None:
    with pytest.raises(FormatCannotSay, match="Kalibr has no words"):
        kalibr.write(run)


def test_a_fail_is_marked_in_every_text_format() -> None:
    run = finished_run("kannala_brandt4", Verdict.FAIL)

    for module in (opencv, ros, kalibr):
        assert "verdict: FAIL - this calibration did not pass" in module.write(run).decode()
    assert as_yaml(ros.write(run))["camera_name"] == "FAILED_VIN_0001"
    assert storage(opencv.write(run)).getNode("verdict").string() == "FAIL"


def test_a_serial_cannot_add_lines_to_a_text_format() -> None:
    run = finished_run("kannala_brandt4", serial="A: [1] # - {x} 中")

    assert as_yaml(ros.write(run))["camera_name"] == "A___1_______x___"
    assert list(as_yaml(kalibr.write(run))) == ["cam0"]


@pytest.mark.parametrize("value", [1e-05, -2e-22, 1e22, 0.0, -0.0, 5e-324, 1.7976931348623157e308, 12.5])
def test_numbers_of_yaml_are_read_as_the_same_doubles(value: float) -> None:
    read = yaml.safe_load(yaml_number(value))

    assert isinstance(read, float)
    assert repr(read) == repr(value)


def test_csv_has_a_row_for_everything_with_every_digit() -> None:
    run = finished_run(serial='=cmd|"x"!A1')
    content = csv_file.write(run).decode()
    rows = list(csv.DictReader(io.StringIO(content, newline="")))

    assert "\r\n" in content
    parameters = {row["name"]: float(row["value"]) for row in rows if row["kind"] == "parameter"}
    assert parameters == run.facts.intrinsics.parameters
    assert {row["name"]: float(row["sd"]) for row in rows if row["kind"] == "parameter"} == run.facts.sd
    measured = [row for row in rows if row["kind"] == "measurement"]
    assert [(row["gate"], row["limit"], row["measured_verdict"]) for row in measured] == [
        ("fit", "0.35", "PASS"),
        ("poses", "0.85", "PASS"),
        ("model", "1.0", "PASS"),
        ("score", "", "PASS"),
    ]
    # A spreadsheet would run what begins with =.
    assert {row["serial"] for row in rows} == {'\'=cmd|"x"!A1'}
    assert {row["finished_at"] for row in rows} == {"2026-03-01T06:01:00.000005Z"}


def test_the_stored_result_has_the_hash_that_the_certificate_names() -> None:
    run = finished_run()
    content = stored_json.write(run)

    named = certificate_content(run, START)["result"]["sha256"]
    assert hashlib.sha256(content).hexdigest() == result_hash(run.document) == named
    assert json.loads(content) == run.document
