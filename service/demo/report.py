"""What the demo prints, and when it counts as passed: within 0.5 px and 3.5 predicted sd of the truth."""

import math
import sys
from collections.abc import Mapping
from typing import Any

from service.core.vision.camera import PINHOLE, Intrinsics

Json = Mapping[str, Any]
LARGEST_ERROR_PX = 0.5
LARGEST_ERROR_SD = 3.5


def show_progress(share: float) -> None:
    """Draw the progress of a job in one line."""
    done = round(30 * share)
    end = "\n" if share >= 1 else ""
    if sys.stdout.isatty() or end:
        print(f"\r  planning  [{'#' * done}{'.' * (30 - done)}] {share:4.0%}", end=end, flush=True)


def show_pose_set(pose_set: Json) -> None:
    """Print the poses and the accuracy that they promise."""
    print("   #   distance    turned     x        y        z (m)")
    for number, pose in enumerate(pose_set["poses"], 1):
        x, y, z = pose["tvec"]
        turned = math.degrees(math.hypot(*pose["rvec"]))
        print(
            f"  {number:2d}   {math.hypot(x, y, z):6.3f} m   {turned:5.1f}°   {x:+.3f}   {y:+.3f}   {z:+.3f}"
        )
    prediction = pose_set["prediction"]
    print(
        f"  promised: ‖Ĉ−C‖ {prediction['norm_px']:.3f} px, sd of fx {prediction['sd']['fx']:.3f} px,"
        f" mapping error {prediction['mapping']['mean_px']:.3f} px"
    )


def show_result(result: Json, truth: Intrinsics, address: str) -> None:
    """Print intrinsics against the truth, every gate and the verdict."""
    print("  parameter   estimated       truth      error         sd   error/sd")
    for name, value in result["intrinsics"].items():
        true, sd = truth.parameters[name], result["sd"][name]
        ratio = f"{(value - true) / sd:8.2f}" if sd else "   fixed"
        print(f"  {name:9s} {value:11.4f} {true:11.4f} {value - true:+10.4f} {sd:10.4f}   {ratio}")
    print("  gate         measurement                       value       limit   verdict")
    for gate in result["gates"]:
        limit = "" if gate["limit"] is None else f"{gate['comparison']} {gate['limit']:g}"
        value = "" if gate["value"] is None else f"{gate['value']:.4g} {gate['unit']}"
        print(f"  {gate['gate']:12s} {gate['name']:28s} {value:>12s} {limit:>11s}   {gate['verdict']}")
        if gate["verdict"] != "PASS":
            print(f"               {gate['advice']}")
    print(f"  verdict: {result['verdict']}   {address}")


def is_proven(result: Json, truth: Intrinsics) -> bool:
    """Return whether the verdict is PASS and fx, fy, cx, cy are as near the truth as the demo promises."""
    errors = {name: abs(result["intrinsics"][name] - truth.parameters[name]) for name in PINHOLE}
    near = all(
        error <= LARGEST_ERROR_PX and error <= LARGEST_ERROR_SD * result["sd"][name]
        for name, error in errors.items()
    )
    return result["verdict"] == "PASS" and near
