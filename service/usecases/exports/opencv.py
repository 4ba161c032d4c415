"""OpenCV's FileStorage YAML, with the names of its calibration sample; read by `cv2.FileStorage`.

A fisheye's coefficients belong to `cv2.fisheye` and not to `cv2.undistort`, and both are four numbers or
more: `distortion_model` says which.
"""

import cv2
import numpy as np

from service.usecases.exports.format import Format, headline
from service.usecases.finished_run import FinishedRun
from service.usecases.vehicle_place import VehiclePlace

MODELS = {"pinhole5": "opencv", "rational8": "opencv_rational", "kannala_brandt4": "opencv_fisheye"}


def write(run: FinishedRun) -> bytes:
    """Return the file; raises KeyError for a lens without a model's name, which a test holds."""
    facts, intrinsics = run.facts, run.facts.intrinsics
    storage = cv2.FileStorage("result.yml", cv2.FILE_STORAGE_WRITE | cv2.FILE_STORAGE_MEMORY)
    storage.writeComment(headline(facts), False)
    texts = {
        "verdict": facts.verdict.value,
        "serial": facts.serial,
        "sku": facts.sku,
        "run_id": str(facts.run_id),
        "calibration_time": f"{facts.finished_at:%Y-%m-%dT%H:%M:%SZ}",
        "distortion_model": MODELS[intrinsics.lens],
    }
    for name, said in texts.items():
        storage.write(name, said)
    storage.write("nr_of_frames", len(run.views))
    storage.write("image_width", intrinsics.image_size[0])
    storage.write("image_height", intrinsics.image_size[1])
    storage.write("camera_matrix", intrinsics.camera_matrix)
    storage.write("distortion_coefficients", intrinsics.dist_coeffs.reshape(-1, 1))
    storage.write("avg_reprojection_error", facts.rms_px)
    storage.write("standard_deviations", np.array([*facts.sd.values()]).reshape(-1, 1))
    if run.place is not None:
        storage.write("T_vehicle_cam", run.place.pose.matrix)
        storage.write("T_vehicle_cam_covariance", run.place.covariance)
        storage.write("T_vehicle_cam_measured", measured_in(run.place))
    text: str = storage.releaseAndGetString()
    return text.encode("utf-8")


def measured_in(place: VehiclePlace) -> str:
    """Return which measurement a place is from."""
    return "run" if place.later_id is None else f"extrinsics {place.later_id}"


FORMAT = Format("opencv", "OpenCV", "application/yaml", "yml", write)
