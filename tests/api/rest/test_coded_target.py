"""A SKU with a coded board over REST: planned, captured with a hand before some corners, and passed."""

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.vision.camera import project
from service.core.vision.transforms import Pose
from service.simulator.renderer import prepare
from service.simulator.scene import Scene
from service.usecases.sku_document import SkuDocument
from tests.api.rest.test_pose_sets import PATH, ended
from tests.plant import SKU, Plant, encode, problem

CODED: dict[str, Any] = {
    **SKU,
    "target": "charuco:8x5:30mm:22mm:4x4_250",
    "pose_space": {"separation_px": 30.0, "distance_m": [0.25, 0.7]},
}
HAND_GREY = 90


def pictures(poses: list[Pose], true_camera: dict[str, float]) -> list[NDArray[np.uint8]]:
    """What a camera sees at poses."""
    sku = SkuDocument.model_validate({**CODED, "nominal": true_camera}).to_revision()
    scene = prepare(Scene(intrinsics=sku.intrinsics, target=sku.target, noise_grey=1.0, blur_px=0.5))
    rng = np.random.default_rng(4)
    return [scene.render(pose, rng) for pose in poses]


def hold(image: NDArray[np.uint8], pose: Pose, corner: int) -> NDArray[np.uint8]:
    """A picture in which a hand is before one corner of the board."""
    sku = SkuDocument.model_validate(CODED).to_revision()
    place = sku.target.object_points[sku.target.outer_corners[corner]]
    u, v = project(sku.intrinsics, pose.rotation, pose.tvec, place[None])[0]
    held = image.copy()
    cv2.circle(held, (round(u), round(v)), 45, HAND_GREY, -1, cv2.LINE_AA)
    return held


def test_a_run_with_a_coded_board_is_planned_captured_in_part_and_passed(plant: Plant) -> None:
    plant.expect(201, plant.post("/skus", CODED))
    plant.expect(200, plant.post("/skus/tiny/revisions/1/publish"))
    made = plant.expect(202, plant.post(PATH, {"seed": 1, "candidates": 300}))
    assert ended(plant, made["job"]["id"])["state"] == "done"
    plant.expect(200, plant.post(f"/pose-sets/{made['pose_set']['id']}/publish"))
    planned = plant.expect(200, plant.get(f"/pose-sets/{made['pose_set']['id']}"))["poses"]
    poses = [Pose(np.array(one["rvec"]), np.array(one["tvec"])) for one in planned]
    truth = {**SKU["nominal"], "fx": 676.5, "fy": 677.4, "cx": 330.1}
    images = pictures(poses, truth)
    for i in (0, 3):
        images[i] = hold(images[i], poses[i], corner=i % 4)

    run_id = plant.open_run("VIN-CODED")
    captures = [
        plant.expect(201, plant.send(run_id, encode(image), pose_index=i)) for i, image in enumerate(images)
    ]
    result = plant.expect(200, plant.finish(run_id))

    assert result["verdict"] == "PASS", [
        one for gate in result["gates"] for one in gate["measurements"] if one["verdict"] != "PASS"
    ]
    for name, value in truth.items():
        assert abs(result["intrinsics"][name] - value) < 4 * result["sd"][name], name
    corners = [len(capture["corners"]) for capture in captures]
    assert max(corners) == 40
    assert 20 < corners[0] < 40
    assert 20 < corners[3] < 40
    assert all(capture["match_error_px"] < 12.8 for capture in captures)
    again = plant.expect(200, plant.get(f"/pose-sets/{made['pose_set']['id']}/review"))
    assert again["target"]["spec"] == CODED["target"]


def test_a_mirrored_coded_board_and_another_one_are_refused_by_name(small_plant: Plant) -> None:
    small_plant.expect(201, small_plant.post("/skus", CODED))
    small_plant.expect(200, small_plant.post("/skus/tiny/revisions/1/publish"))
    run_id = small_plant.open_run("VIN-MIRROR", purpose="trial")
    image = pictures([Pose(np.array([0.2, -0.1, 0.3]), np.array([-0.1, -0.06, 0.4]))], SKU["nominal"])[0]

    mirrored = problem(small_plant.send(run_id, encode(image[:, ::-1])), 422, "wrong-target")
    assert "mirrored" in mirrored["detail"]
    assert mirrored["facts"]["mirrored"] is True
