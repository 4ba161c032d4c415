"""A novice alone before a camera: chooses views, takes the board there, and takes pictures until N show it.

The same vehicle, board and hand as in a guided run (`guided_run`); the tool is OpenCV's, which draws the
corners it finds and says nothing else. Not here: who the novice is (`service.simulator.novice`).
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from bench.guided_run import Vehicle
from bench.opencv_flow import find_with_opencv
from service.core.vision.target import Target
from service.core.vision.transforms import Array
from service.simulator.novice import Choice, FreeHand, Novice, pose_of_choice, think_of_view
from service.simulator.shutter import between, take_picture

MOST_SHOTS = 4  # per wanted view, before the novice gives up
LONGEST_WAY_S = 20.0


@dataclass
class FreehandRun:
    """Pictures (h, w) in which OpenCV found the board, with its corners; shots in vain; time taken, s."""

    images: list[NDArray[np.uint8]] = field(default_factory=list)
    corners: list[Array] = field(default_factory=list)
    missed: int = 0
    elapsed_s: float = 0.0


def take_freehand(
    vehicle: Vehicle,
    target: Target,
    novice: Novice,
    count: int,
    *,
    rng: np.random.Generator,
    frame_s: float = 1.0 / 15.0,
) -> FreehandRun:
    """Return what a novice photographs of a board until `count` pictures show it."""
    mind_rng, hand_rng, camera_rng = rng.spawn(3)
    hand, run, last = FreeHand(target, None, novice.habits), FreehandRun(), None
    for _ in range(MOST_SHOTS * count):
        last = think_of_view(novice.style, last, vehicle.camera, target, mind_rng)
        pause_s = novice.habits.reaction_s + mind_rng.uniform(0.0, novice.style.longest_pause_s)
        image = _shoot(
            vehicle,
            target,
            hand,
            last,
            pause_s=pause_s,
            frame_s=frame_s,
            rngs=(hand_rng, camera_rng),
            run=run,
        )
        corners = find_with_opencv(image, target)
        if corners is None:
            run.missed += 1
            continue
        run.images.append(image)
        run.corners.append(corners)
        if len(run.images) == count:
            break
    return run


def _shoot(
    vehicle: Vehicle,
    target: Target,
    hand: FreeHand,
    choice: Choice,
    *,
    pause_s: float,
    frame_s: float,
    rngs: tuple[np.random.Generator, np.random.Generator],
    run: FreehandRun,
) -> NDArray[np.uint8]:
    """Take the board to where it was thought of, wait, and return the picture, exposed until that moment."""
    hand.aim_at(pose_of_choice(choice, vehicle.camera, target))
    arrived_s, began_s = None, run.elapsed_s
    before = now = hand.pose
    while arrived_s is None or run.elapsed_s < arrived_s + pause_s:
        before, now = now, hand.step((), frame_s, rngs[0])
        run.elapsed_s += frame_s
        if arrived_s is None and (hand.has_arrived or run.elapsed_s > began_s + LONGEST_WAY_S):
            arrived_s = run.elapsed_s
    opened = between(before, now, 1.0 - vehicle.exposure_s / frame_s, target)
    return take_picture(vehicle.prepared, opened, now, rngs[1])
