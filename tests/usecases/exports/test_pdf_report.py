"""The report on paper: three pages that say whose result it is and how it was judged, whatever the result."""

import base64
import re
import zlib

import numpy as np
import pytest

from service.core.quality.gates import Verdict
from service.core.vision.camera import LENSES
from service.core.vision.uncertainty import mapping_error
from service.usecases.certificate import result_hash
from service.usecases.exports import pdf_report
from service.usecases.exports.report.plots import expected_errors
from service.usecases.finished_run import FinishedRun
from tests.finished import PLACE, finished_run


def pages(content: bytes) -> list[str]:
    """The texts of a PDF's pages, as they are drawn, in the order of its streams."""
    streams = re.findall(rb"stream\r?\n(.*?)endstream", content, re.S)
    drawn = [zlib.decompress(base64.a85decode(stream.strip().removesuffix(b"~>"))) for stream in streams]
    return [b"\n".join(re.findall(rb"\((.*?)(?<!\\)\) Tj", page)).decode("cp1252") for page in drawn]


def texts(run: FinishedRun) -> list[str]:
    return pages(pdf_report.write(run))


def test_a_report_says_whose_result_it_is_on_each_of_three_pages() -> None:
    run = finished_run()
    first, gates, traces = texts(run)

    for number, page in enumerate((first, gates, traces), 1):
        assert "VIN-0001" in page
        assert "PASS" in page
        assert f"Page {number} of 3" in page
        assert str(run.facts.run_id) in page
    assert "1350.12" in first
    assert "0.21" in first
    assert "fixed" in first
    assert "max 0.35" in gates
    assert "0.233" in gates
    assert result_hash(run.document) in traces
    assert run.signed_by is not None
    assert run.signed_by in traces
    assert all(image.sha256 in traces for image in run.images)
    assert "opencv 5.0.0" in traces


def test_a_report_says_where_the_camera_is_in_the_vehicle_if_that_is_known() -> None:
    first, *_ = texts(finished_run(place=PLACE))

    for said in (
        "Camera in the vehicle",
        "1420.00",
        "0.30",
        "-126.051",
        "measured with the run",
    ):
        assert said in first
    assert "Camera in the vehicle" not in texts(finished_run())[0]


def test_a_fail_is_told_on_every_page_and_says_why() -> None:
    first, *others = texts(finished_run(verdict=Verdict.FAIL))

    assert "This calibration did not pass. Do not use it." in first
    assert "Take the images again with a sharp lens." in first
    assert all("FAIL - do not use" in page for page in (first, *others))


@pytest.mark.parametrize("lens", LENSES)
def test_every_lens_has_a_report(lens: str) -> None:
    assert len(texts(finished_run(lens))) == 3


def test_the_same_result_is_the_same_report() -> None:
    assert pdf_report.write(finished_run()) == pdf_report.write(finished_run())


def test_a_hundred_images_and_names_in_chinese_fit() -> None:
    run = finished_run(images=100, serial="车-0001 (\\)", sku_name="驾驶员监控摄像头 " * 20)

    content = pdf_report.write(run)

    assert content.count(b"/Type /Page\n") == 3
    assert b"STSong-Light" in content


def test_the_map_is_the_error_that_the_gates_measure() -> None:
    run = finished_run()
    errors = expected_errors(run, 48, 30)
    inside = errors[5:26, 7:41]  # the cells whose centres are in the working zone

    measured = mapping_error(run.facts.intrinsics, run.facts.covariance, zone_of(run))
    assert np.sqrt(np.mean(inside**2)) == pytest.approx(measured.mean_px, rel=0.1)


def zone_of(run: FinishedRun) -> np.ndarray:
    width, height = run.facts.intrinsics.image_size
    u, v = np.meshgrid(np.linspace(0.15, 0.85, 25) * (width - 1), np.linspace(0.15, 0.85, 17) * (height - 1))
    return np.stack([u.ravel(), v.ravel()], axis=-1)
