"""How many kiosks at 15 frames a second one service process holds, frame sent to state received below 100 ms.

The real service as its command in a process of its own, real sockets, and the kiosks (browser sources with
half-size raw frames) in another process, on the same machine. Six frames in ten show the board, at a new pose
each, the others none or a part. Held means: 95 % of the states within 100 ms, and 95 % of the frames
answered; a frame that a newer one replaced in the service counts as not answered.
"""

import json
import os
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from bench.detection import SPACE, cut_off
from bench.guidance_rates import NOWHERE
from bench.kiosk_clients import Heard, Orders
from service.core.planning.pose_space import PoseSpace, sample_poses
from service.core.vision.target import parse_target
from service.core.vision.transforms import Pose
from service.demo.customer import Customer
from service.demo.server import RunningService, running_service
from service.demo.skus import PAPER_SKUS
from service.demo.virtual_vehicle import nominal_camera
from service.simulator.live_renderer import LiveRenderer
from service.simulator.scene import production_scene

SEED = 3
FRAMES_PER_S = 15.0
LIMIT_MS, LEAST_ANSWERED = 100.0, 0.95
POSES, FRAMES = 8, 40
MOST = 32
QUICK_S, FULL_S = 2.0, 15.0
QUICK_COUNTS = (2, 4, 5, 6, 8)
CLIENTS = (sys.executable, "-m", "bench.kiosk_clients")


def run(quick: bool) -> dict[str, Any]:
    """Return `kiosks`, the most that were held, and the times of their states; then each number tried."""
    sku = PAPER_SKUS[0]
    tried: list[dict[str, Any]] = []
    with TemporaryDirectory() as directory:
        frames = Path(directory) / "frames.npy"
        np.save(frames, draw_frames(sku))
        data_dir = Path(directory) / "data"
        data_dir.mkdir()
        with running_service(data_dir, 0) as service:
            stations = prepare_stations(Customer.of(service.url, service.key), sku)
            for count in QUICK_COUNTS if quick else range(1, MOST + 1):
                seconds = QUICK_S if quick else FULL_S
                orders = Orders(
                    service.url,
                    service.key,
                    sku["code"],
                    stations[:count],
                    str(frames),
                    FRAMES_PER_S,
                    seconds,
                )
                tried.append({"kiosks": count, **_load(service, orders)})
                if not tried[-1]["held"]:
                    break
    held = [one for one in tried if one["held"]]
    best = held[-1] if held else {"kiosks": 0, **{k: v for k, v in tried[0].items() if k != "kiosks"}}
    return {**best, "frames_per_s": FRAMES_PER_S, "limit_ms": LIMIT_MS, "tried": tried, "seeds": [SEED]}


def table(result: Mapping[str, Any]) -> str:
    """Return the result as text."""
    columns = ("kiosks", "p50_ms", "p95_ms", "max_ms", "answered", "cpu_ms_per_frame")
    lines = ["".join(f"{column:>18}" for column in columns)]
    lines += ["".join(f"{one[column]:>18.2f}" for column in columns) for one in result["tried"]]
    held = f"{result['kiosks']} kiosks at {result['frames_per_s']:g} frames/s are held"
    lines.append(f"{held}, p95 {result['p95_ms']:.1f} ms of {result['limit_ms']:g} ms allowed")
    return "\n".join(lines)


def draw_frames(sku: Mapping[str, Any]) -> np.ndarray:
    """Return half-size frames (n, h, w): in ten six with the board, two cut by the border, two without."""
    camera, target = nominal_camera(sku), parse_target(sku["target"])
    live, rng = LiveRenderer(production_scene(camera, target, SEED)), np.random.default_rng(SEED)
    sampled = sample_poses(SPACE, camera, target, FRAMES, SEED)
    poses: list[Pose] = []
    for i in range(FRAMES):
        pose = sampled.pose(i)
        poses.append(pose if i % 5 < 3 else cut_off(pose, camera) if i % 5 == 3 else NOWHERE)
    return np.stack([live.frame(pose, rng) for pose in poses])


def summarise(heard: list[Heard], cpu_s: float) -> dict[str, Any]:
    """Return times, answered share and verdict over what all kiosks heard while the service used `cpu_s`."""
    latency = np.concatenate([np.array(one.latency_ms) for one in heard])
    answered = len(latency) / max(sum(one.sent for one in heard), 1)
    p50, p95 = np.percentile(latency, (50, 95)) if latency.size else (np.inf, np.inf)
    return {
        "p95_ms": float(p95),
        "p50_ms": float(p50),
        "max_ms": float(latency.max()) if latency.size else float("inf"),
        "answered": answered,
        "cpu_ms_per_frame": 1e3 * cpu_s / max(len(latency), 1),
        "problems": sorted({code for one in heard for code in one.problems}),
        "held": bool(p95 < LIMIT_MS and answered >= LEAST_ANSWERED),
    }


def prepare_stations(customer: Customer, sku: Mapping[str, Any]) -> list[str]:
    """Publish the SKU with a pose set and register stations whose kiosks have the camera."""
    camera, target = nominal_camera(sku), parse_target(sku["target"])
    sampled = sample_poses(PoseSpace(), camera, target, POSES, SEED)
    chosen = [sampled.pose(i) for i in range(POSES)]
    poses = [{"rvec": list(pose.rvec), "tvec": list(pose.tvec)} for pose in chosen]
    codes = [f"bench{number + 1}" for number in range(MOST)]
    with customer.http:
        customer.describe_sku(dict(sku))
        made = customer.ask("POST", f"/skus/{sku['code']}/revisions/1/pose-sets", json={"poses": poses})
        customer.ask("POST", f"/pose-sets/{made['pose_set']['id']}/publish")
        for code in codes:
            customer.ask("POST", "/stations", json={"code": code, "name": code, "source": "browser"})
    return codes


def _load(service: RunningService, orders: Orders) -> dict[str, Any]:
    before = _cpu_s(service.process.pid)
    done = subprocess.run(  # noqa: S603 - our own command
        CLIENTS, input=json.dumps(asdict(orders)), capture_output=True, text=True, check=True
    )
    return summarise([Heard(**one) for one in json.loads(done.stdout)], _cpu_s(service.process.pid) - before)


def _cpu_s(pid: int) -> float:
    """Return the CPU time that a process used so far, s; not a number where the system does not tell it."""
    file = Path(f"/proc/{pid}/stat")
    if not file.exists():
        return float("nan")
    fields = file.read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
