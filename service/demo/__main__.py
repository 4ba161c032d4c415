"""`python -m service.demo [--once] [--port N] [--seed N]`: what `make demo` runs."""

import argparse
import sys
import tempfile
from pathlib import Path

import numpy as np

from service.demo.customer import Customer, Refused
from service.demo.guided import guide_vehicle
from service.demo.report import is_proven, show_pose_set, show_progress, show_result
from service.demo.server import RunningService, ServiceDidNotStart, running_service
from service.demo.skus import PAPER_SKUS
from service.demo.virtual_vehicle import draw_vehicle, nominal_camera, photograph
from service.simulator.virtual_station import camera_of_serial

# Of a virtual station: with nobody there to watch, and with somebody.
AS_FAST_AS_IT_CAN, WATCHABLE = 1000.0, 2.0


def main() -> int:
    """Return 0 if all vehicles passed, 1 if not, 2 if the service refused or did not start."""
    parser = argparse.ArgumentParser(prog="make demo", description=__doc__)
    parser.add_argument("--once", action="store_true", help="end after the vehicles")
    parser.add_argument("--port", type=int, default=0, help="port to serve on (default: a free one)")
    parser.add_argument("--seed", type=int, default=1, help="which vehicles")
    arguments = parser.parse_args()
    data_dir = Path(tempfile.mkdtemp(prefix="dmscal-demo-"))
    try:
        speed = AS_FAST_AS_IT_CAN if arguments.once else WATCHABLE
        with running_service(data_dir, arguments.port, virtual_speed=speed) as service:
            return _demonstrate(service, data_dir, arguments.once, arguments.seed)
    except (Refused, ServiceDidNotStart) as problem:
        print(problem, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 0


def _demonstrate(service: RunningService, data_dir: Path, once: bool, seed: int) -> int:
    print(f"service at {service.url}, data in {data_dir}\n")
    customer = Customer.of(service.url, service.key)
    proven = [_one_vehicle(customer, service.url, number, seed) for number in range(len(PAPER_SKUS))]
    proven.append(_guided_vehicle(customer, service, seed))
    print(
        "all vehicles PASS within the promised accuracy"
        if all(proven)
        else "NOT within the promised accuracy"
    )
    if not once:
        print(f"\nthe runs       {service.url}/#key={service.key}")
        print(f"the kiosk      {service.url}/kiosk?station=virtual-{PAPER_SKUS[0]['code']}#key={service.key}")
        print(f"try it by hand {service.url}/kiosk?station=virtual#key={service.key}")
        print(f"the API's docs {service.url}/api/docs")
        print("Ctrl-C ends the demo", flush=True)
        service.process.wait()
    return 0 if all(proven) else 1


def _one_vehicle(customer: Customer, url: str, number: int, seed: int) -> bool:
    sku = PAPER_SKUS[number]
    serial = f"DEMO-{sku['code'].upper()}-{seed:04d}"
    print(f"{sku['name']}, vehicle {serial}")
    customer.describe_sku(sku)
    pose_set = customer.plan_poses(sku["code"], show_progress)
    show_pose_set(pose_set)
    truth = draw_vehicle(sku, np.random.default_rng([seed, number]))
    images = photograph(truth, sku, pose_set["poses"], seed)
    order = {"sku": sku["code"], "serial": serial, "purpose": "simulated"}
    result = customer.calibrate(order, images)
    show_result(result, truth, f"{url}/api/v1/vehicles/{serial}")
    print(flush=True)
    return is_proven(result, truth)


def _guided_vehicle(customer: Customer, service: RunningService, seed: int) -> bool:
    for sku in PAPER_SKUS:
        customer.add_virtual_station(f"virtual-{sku['code']}", f"Virtual station, {sku['name']}")
    customer.add_virtual_station("virtual", "Virtual station, by mouse", "virtual:mouse")
    sku = PAPER_SKUS[0]
    serial = f"GUIDED-{sku['code'].upper()}-{seed:04d}"
    print(f"{sku['name']}, vehicle {serial}, guided at a virtual station by a hand that reads only the hints")
    verdict = guide_vehicle(service.url, service.key, f"virtual-{sku['code']}", serial, sku["code"])
    result = customer.ask("GET", f"/runs/{verdict['run_id']}/result")
    truth = camera_of_serial(nominal_camera(sku), serial)
    show_result(result, truth, f"{service.url}/api/v1/vehicles/{serial}")
    print(flush=True)
    return is_proven(result, truth)


if __name__ == "__main__":
    sys.exit(main())
