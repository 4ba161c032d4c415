from tests.line import FAIL, MARGINAL, Line
from tests.plant import SKU, Plant, pose_set, problem


def make_runs(plant: Plant) -> None:
    """Three runs of today: one of each kind."""
    services = plant.app.state.services
    now = services.clock.now()
    with services.database.write() as session:
        line = Line(session)
        line.run("V1", at=now)
        line.run("V2", MARGINAL, at=now, station=None)
        line.run("V3", FAIL, at=now, failed=("coverage",))


def test_the_yield_of_the_last_days_is_read(plant: Plant) -> None:
    make_runs(plant)

    view = plant.expect(200, plant.get("/statistics/yield?days=7"))

    assert sum(count["passed"] for count in view["counts"]) == 1
    assert sum(count["first_runs"] for count in view["counts"]) == 3
    assert sum(count["first_passed"] for count in view["counts"]) == 2
    assert {count["station"] for count in view["counts"]} == {"cal1", None}
    assert view["gates"] == [{"gate": "fit", "name": "coverage", "runs": 1}]
    assert view["until"] > view["since"]


def test_too_many_days_and_odd_codes_are_refused(small_plant: Plant) -> None:
    for query in ("days=32", "days=0", "days=x", "sku=No%20Code", "station=ä"):
        problem(small_plant.get(f"/statistics/yield?{query}"), 422, "validation-failed")


def test_runs_are_listed_by_filters_and_in_parts(plant: Plant) -> None:
    make_runs(plant)

    def serials(query: str) -> list[str]:
        return [run["serial"] for run in plant.expect(200, plant.get(f"/runs?{query}"))["items"]]

    assert serials("station=cal1&verdict=FAIL") == ["V3"]
    assert sorted(serials("sku=lens1")) == ["V1", "V2", "V3"]
    assert serials("sku=lens2") == []
    assert serials("failed=coverage&counted=true") == ["V3"]
    assert serials("until=2020-01-01") == []
    first = plant.get("/runs?counted=true&limit=2").json()
    rest = plant.get(f"/runs?counted=true&limit=2&cursor={first['next_cursor']}").json()
    assert sorted(run["serial"] for run in first["items"] + rest["items"]) == ["V1", "V2", "V3"]
    assert rest["next_cursor"] is None


def test_filters_that_mean_nothing_are_refused(small_plant: Plant) -> None:
    for query in ("verdict=GOOD", "since=yesterday", "until=9999-12-31", "counted=perhaps", "sku=A B"):
        problem(small_plant.get(f"/runs?{query}"), 422, "validation-failed")


def test_stations_are_listed_with_what_they_do(plant: Plant) -> None:
    plant.publish_sku()
    plant.expect(201, plant.post("/stations", {"code": "cal1", "name": "Calibration 1"}))
    run_id = plant.open_run("VIN-1", station="cal1")
    plant.expect(201, plant.upload(run_id, 0))

    (standing,) = plant.expect(200, plant.get("/statistics/stations"))["items"]

    assert (standing["code"], standing["name"], standing["last_run"]) == ("cal1", "Calibration 1", None)
    assert (standing["open_run"]["id"], standing["open_run"]["captures"]) == (run_id, 1)
    assert standing["open_run"]["poses"] == len(pose_set().poses)


def test_a_sku_names_the_pose_set_its_runs_follow(plant: Plant) -> None:
    plant.publish_sku()

    (listed,) = plant.expect(200, plant.get("/skus"))["items"]
    (summary,) = plant.expect(200, plant.get("/skus/tiny/pose-sets"))["items"]

    assert listed["published_pose_set"] == {"id": summary["id"], "poses": len(pose_set().poses)}
    assert (summary["state"], summary["pose_count"]) == ("published", len(pose_set().poses))
    assert summary["sku"] == {"code": "tiny", "revision": 1}
    problem(plant.get("/skus/nothing/pose-sets"), 404, "not-found")


def test_the_limits_of_a_revision_are_its_own_and_else_the_defaults(small_plant: Plant) -> None:
    small_plant.publish_sku(with_poses=False)

    read = small_plant.expect(200, small_plant.get("/skus/tiny/revisions/1/limits"))
    limits = {limit["name"]: limit for limit in read["limits"]}

    assert limits["focal_sd_share"] == {
        "name": "focal_sd_share",
        "value": SKU["limits"]["focal_sd_share"],
        "marginal_share": 0.8,
        "is_default": False,
    }
    assert (limits["coverage"]["value"], limits["coverage"]["is_default"]) == (0.85, True)
    problem(small_plant.get("/skus/tiny/revisions/2/limits"), 404, "not-found")
