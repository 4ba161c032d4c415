"""A mixed set of live frames, six in ten with a board, before our detector and all of OpenCV's finders.

Whole boards, boards cut by the border, boards with a part hidden, and nothing; the same frames for everybody,
in turn on one thread. A finder may use half-size frames, its best choice of flags and no
refinement: only the order, the place and the time count.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import cv2
import numpy as np

from bench.detection import cut_off
from bench.frame_to_state import Image, Look
from bench.guidance_rates import empty_frame, random_boards
from bench.hard_frames import hide_a_part, shot_of
from bench.timing import Timed, spread
from service.core.vision.live_detection import LiveWorkspace, detect_live, halve
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Array
from service.simulator.renderer import PreparedScene
from service.simulator.scene import true_corners

WRONG_PX = 2.0
PLAIN = cv2.CALIB_CB_ADAPTIVE_THRESH | cv2.CALIB_CB_NORMALIZE_IMAGE | cv2.CALIB_CB_FAST_CHECK

Finder = Callable[[Image], Array | None]


def finders(target: Chessboard) -> Mapping[str, Finder]:
    """Return OpenCV's finders by name: corners (n, 2) px of a frame in full size, or None."""
    size = (target.columns, target.rows)

    def plain(image: Image) -> Array | None:
        found, corners = cv2.findChessboardCorners(image, size, flags=PLAIN)
        return np.asarray(corners, dtype=np.float64).reshape(-1, 2) if found else None

    def sectors(image: Image) -> Array | None:
        found, corners = cv2.findChessboardCornersSB(image, size, flags=cv2.CALIB_CB_NORMALIZE_IMAGE)
        return np.asarray(corners, dtype=np.float64).reshape(-1, 2) if found else None

    return {
        "fast_check": plain,
        "fast_check_half": lambda image: _from_half(plain, image),
        "sb": sectors,
        "sb_half": lambda image: _from_half(sectors, image),
    }


def compare(frames: list[tuple[Image, Array | None]], look: Look, target: Chessboard) -> dict[str, Any]:
    """Return everybody's times and rates on frames with their true corners (None: not the whole board).

    `ours` is the detector by itself, as OpenCV's are, and what the speed-ups are of; `to_state` is `look`, to
    the state.
    """
    workspace = LiveWorkspace()
    own: dict[str, Finder] = {
        "ours": lambda image: detect_live(image, target, workspace).image_points,
        "to_state": lambda image: look(image).image_points,
    }
    judged = [_Judged(name, find) for name, find in {**own, **finders(target)}.items()]
    # Everybody in turn on each frame: a machine that slows down for a while slows down all of them.
    for image, truth in frames:
        for one in judged:
            one.see(image, truth)
    whole = sum(truth is not None for _, truth in frames)
    rows = {one.name: one.row(whole) for one in judged}
    rivals = {name: row for name, row in rows.items() if name not in own}
    best = min(rivals, key=lambda name: rivals[name]["cpu_p95_ms"])
    return {
        "frames": len(frames),
        "with_board": whole,
        "best_of_opencv": best,
        "speedup_p95": rivals[best]["p95_ms"] / rows["ours"]["p95_ms"],
        "speedup_cpu_p95": rivals[best]["cpu_p95_ms"] / rows["ours"]["cpu_p95_ms"],
        "speedup_to_state_cpu_p95": rivals[best]["cpu_p95_ms"] / rows["to_state"]["cpu_p95_ms"],
        "best_rate_of_opencv": max(row["rate"] for row in rivals.values()),
        **rows,
    }


def mix(prepared: PreparedScene, count: int, seed: int) -> list[tuple[Image, Array | None]]:
    """Return about `count` frames with their true corners: six in ten with the whole board.

    Of the others half are empty; a quarter are boards over the border, a quarter boards partly hidden.
    """
    rng = np.random.default_rng(seed)
    wholes = list(random_boards(prepared, 6 * count // 10, seed))
    frames: list[tuple[Image, Array | None]] = [
        (image, true_corners(prepared.scene, pose)) for pose, _, image in wholes
    ]
    for number in range(count - len(frames)):
        pose = wholes[number % len(wholes)][0]
        if number % 2:
            frames.append((empty_frame(prepared, number // 2, seed, rng), None))
        elif number % 4:
            frames.append((prepared.render(cut_off(pose, prepared.scene.intrinsics), rng), None))
        else:
            frames.append((hide_a_part(shot_of(prepared, pose, rng)), None))
    return frames


@dataclass
class _Judged:
    """A finder, its times, and how often it was right and wrong."""

    name: str
    find: Finder
    timed: Timed = field(default_factory=Timed)
    right: int = 0
    false: int = 0

    def see(self, image: Image, truth: Array | None) -> None:
        """Look at a frame with these true corners (None: not the whole board)."""
        points = self.timed.act(self.find, image)
        if points is None:
            return
        if truth is not None and _is_right(points, truth):
            self.right += 1
        else:
            self.false += 1

    def row(self, whole: int) -> dict[str, float]:
        """Return the figures, of so many frames with the whole board."""
        return {"rate": self.right / whole, "false": float(self.false), **spread(self.timed)}


def _is_right(points: Array, truth: Array) -> bool:
    """Whether corners are at their places, in this order or turned by 180 degrees: OpenCV chooses."""
    errors = [np.sqrt(np.mean(np.sum((one - truth) ** 2, axis=1))) for one in (points, points[::-1])]
    return bool(min(errors) <= WRONG_PX)


def _from_half(find: Finder, image: Image) -> Array | None:
    points = find(halve(image))
    return None if points is None else points * 2.0 + 0.5
