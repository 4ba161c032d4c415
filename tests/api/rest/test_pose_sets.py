import time
from typing import Any
from uuid import uuid4

from tests.plant import SKU, Plant, poses_json, problem

PATH = "/skus/tiny/revisions/1/pose-sets"


def ended(plant: Plant, job_id: str) -> dict[str, Any]:
    """The job, once it has ended."""
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        job: dict[str, Any] = plant.get(f"/jobs/{job_id}").json()
        if job["state"] in {"done", "failed", "cancelled"}:
            return job
        time.sleep(0.02)
    raise AssertionError("the job did not end")


def test_a_pose_set_is_planned_in_the_background(plant: Plant) -> None:
    plant.publish_sku(with_poses=False)

    made = plant.expect(202, plant.post(PATH, {"seed": 1, "candidates": 300}))
    job = ended(plant, made["job"]["id"])
    planned = plant.expect(200, plant.get(f"/pose-sets/{made['pose_set']['id']}"))

    assert (made["pose_set"]["poses"], made["pose_set"]["prediction"]) == ([], None)
    assert (job["state"], job["progress"], job["problem"]) == ("done", 1.0, None)
    assert [{"rvec": p["rvec"], "tvec": p["tvec"]} for p in planned["poses"]] == poses_json()
    assert planned["prediction"]["norm_px"] > 0
    assert (planned["provenance"]["seed"], planned["provenance"]["candidates"]) == (1, 300)
    assert all(0 <= u <= 639 and 0 <= v <= 399 for p in planned["poses"] for u, v in p["outer_corners"])


def test_a_plan_that_is_impossible_fails_with_its_reason(small_plant: Plant) -> None:
    small_plant.post("/skus", {**SKU, "pose_space": {"smallest_square_px": 300}})

    made = small_plant.post(PATH, {}).json()
    job = ended(small_plant, made["job"]["id"])

    assert (job["state"], job["problem"]["code"]) == ("failed", "pose-space-empty")
    assert "smallest_square_px" in job["problem"]["detail"]
    problem(small_plant.post(f"/pose-sets/{made['pose_set']['id']}/publish"), 409, "state-forbids")
    problem(small_plant.post(f"/jobs/{job['id']}/cancel"), 409, "job-already-ended")


def test_an_imported_set_tells_what_it_promises(plant: Plant) -> None:
    plant.publish_sku(with_poses=False)

    made = plant.expect(201, plant.post(PATH, {"poses": poses_json()}))

    assert made["job"] is None
    assert made["pose_set"]["prediction"]["norm_px"] > 0
    assert made["pose_set"]["provenance"]["planner"] == "imported"


def test_poses_out_of_the_picture_are_refused_by_number(small_plant: Plant) -> None:
    small_plant.publish_sku(with_poses=False)
    poses = poses_json()
    poses[2]["tvec"] = [5.0, 0.0, 1.0]
    poses[4]["tvec"] = [0.0, 0.0, -1.0]

    refused = problem(small_plant.post(PATH, {"poses": poses}), 422, "pose-set-infeasible")

    assert refused["facts"]["poses"] == [2, 4]


def test_poses_that_do_not_determine_the_camera_are_refused(small_plant: Plant) -> None:
    small_plant.publish_sku(with_poses=False)

    problem(small_plant.post(PATH, {"poses": [poses_json()[0]] * 3}), 422, "pose-set-infeasible")


def test_planning_and_importing_at_once_is_refused(small_plant: Plant) -> None:
    small_plant.publish_sku(with_poses=False)

    problem(small_plant.post(PATH, {"poses": poses_json(), "seed": 1}), 422, "validation-failed")


def test_publishing_a_set_retires_the_one_before(small_plant: Plant) -> None:
    small_plant.publish_sku()
    first = small_plant.open_run("VIN-1")
    second = small_plant.post(PATH, {"poses": poses_json()[:5]}).json()["pose_set"]["id"]

    small_plant.expect(200, small_plant.post(f"/pose-sets/{second}/publish"))

    old = small_plant.get(f"/runs/{first}").json()
    assert (old["poses"], small_plant.get(f"/pose-sets/{old['pose_set_id']}").json()["state"]) == (
        8,
        "retired",
    )
    assert small_plant.get(f"/runs/{small_plant.open_run('VIN-2')}").json()["poses"] == 5


def test_an_unknown_set_or_job_is_not_found(small_plant: Plant) -> None:
    problem(small_plant.get(f"/pose-sets/{uuid4()}"), 404, "not-found")
    problem(small_plant.post(f"/pose-sets/{uuid4()}/publish"), 404, "not-found")
    problem(small_plant.get(f"/jobs/{uuid4()}"), 404, "not-found")
    problem(small_plant.post(f"/jobs/{uuid4()}/cancel"), 404, "not-found")


def test_the_papers_procedure_is_there_to_compare_with(small_plant: Plant) -> None:
    small_plant.publish_sku(with_poses=False)
    made = small_plant.expect(
        202, small_plant.post(PATH, {"planner": "paper", "candidates": 100, "sets": 40})
    )

    assert ended(small_plant, made["job"]["id"])["problem"] is None
    planned = small_plant.get(f"/pose-sets/{made['pose_set']['id']}").json()

    assert (planned["provenance"]["planner"], planned["provenance"]["objective"]) == ("paper-1", "score")
    assert len(planned["poses"]) == SKU["pose_count"]


def test_weights_of_ones_own_are_kept_and_the_curve_tells_how_many_poses_are_enough(
    small_plant: Plant,
) -> None:
    small_plant.publish_sku(with_poses=False)
    weights = {"parameters": 1.0, "mapping_mean": 0.0, "mapping_worst": 2.0}
    made = small_plant.expect(
        202, small_plant.post(PATH, {"weights": weights, "candidates": 200, "draws": 2})
    )

    assert ended(small_plant, made["job"]["id"])["problem"] is None
    planned = small_plant.get(f"/pose-sets/{made['pose_set']['id']}").json()

    provenance, prediction = planned["provenance"], planned["prediction"]
    assert (provenance["objective"], provenance["weights"], provenance["draws"]) == ("weighted", weights, 2)
    assert len(prediction["pose_sigma_px"]) == SKU["pose_count"]
    enough = [
        p["poses"] for p in prediction["curve"] if p["mapping_mean_px"] <= prediction["required_mapping_px"]
    ]
    assert prediction["smallest_count"] == min(enough)


def test_weights_that_weigh_nothing_and_two_aims_at_once_are_refused(small_plant: Plant) -> None:
    small_plant.publish_sku(with_poses=False)
    problem(small_plant.post(PATH, {"weights": {"parameters": 0}}), 422, "validation-failed")
    both = {"weights": {"parameters": 1}, "objective": "worst"}
    problem(small_plant.post(PATH, both), 422, "validation-failed")
