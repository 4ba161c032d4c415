"""A virtual station's camera: live frames of a board in a hand that follows the hints, and exact captures.

Pulled frame by frame in simulated time: no thread, no clock. Not here: how fast somebody pulls, and the hand.
"""

from collections import OrderedDict
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from service.core.guidance.hints import ShownHint
from service.core.guidance.problems import FrameForgotten
from service.core.vision.transforms import Pose
from service.simulator.live_renderer import LiveRenderer
from service.simulator.renderer import PreparedScene, prepare
from service.simulator.scene import Scene

KEPT_S = 2.0  # how long the pose of a frame can be asked for a capture


class Operator(Protocol):
    """What holds the board: the simulated hand, or a script of a test."""

    def step(self, hints: tuple[ShownHint, ...], dt_s: float, rng: np.random.Generator) -> Pose:
        """Return the pose of the board `dt_s` later, seeing nothing but the hints."""
        ...


@dataclass(frozen=True)
class LiveFrame:
    """A live frame: image (h, w), full-size pixels per pixel of it, its time since the source began, s."""

    sequence: int
    image: NDArray[np.uint8]
    scale: int
    at_s: float


class VirtualSource:
    """Frames of a prepared scene, whose board a hand moves; each frame's pose is kept for two seconds."""

    def __init__(
        self,
        prepared: PreparedScene,
        live: LiveRenderer,
        hand: Operator,
        rng: np.random.Generator,
    ) -> None:
        """Take what is ready to draw; `make_virtual_source` makes it ready, which takes a second."""
        self._prepared, self._live, self._hand = prepared, live, hand
        # Apart, so that a capture in between changes no frame.
        self._hand_rng, self._frame_rng, self._capture_rng = rng.spawn(3)
        self._sequence = 0
        self._at_s = 0.0
        self._kept: OrderedDict[int, tuple[float, Pose]] = OrderedDict()

    def next_frame(self, hints: tuple[ShownHint, ...], dt_s: float) -> LiveFrame:
        """Return the live frame that follows `dt_s` after the last one, the hand having seen the hints."""
        pose = self._hand.step(hints, dt_s, self._hand_rng)
        self._sequence += 1
        self._at_s += dt_s
        self._kept[self._sequence] = (self._at_s, pose)
        while next(iter(self._kept.values()))[0] < self._at_s - KEPT_S:
            self._kept.popitem(last=False)
        return LiveFrame(
            self._sequence, self._live.frame(pose, self._frame_rng), self._live.scale, self._at_s
        )

    def capture(self, sequence: int) -> NDArray[np.uint8]:
        """Return the exact picture (h, w), at full size, of the very pose that a frame showed.

        Raises FrameForgotten when the frame is more than two seconds old or never was.
        """
        return self._prepared.render(self.pose_of(sequence), self._capture_rng)

    def pose_of(self, sequence: int) -> Pose:
        """Return the true pose `T_cam_board` of a frame, for judging; raises FrameForgotten."""
        kept = self._kept.get(sequence)
        if kept is None:
            raise FrameForgotten(
                f"Frame {sequence} is no longer kept; ask for a frame of the last {KEPT_S:g} s.",
                sequence=sequence,
            )
        return kept[1]


def make_virtual_source(scene: Scene, hand: Operator, rng: np.random.Generator) -> VirtualSource:
    """Return the source of a scene; takes a second or two."""
    return VirtualSource(prepare(scene), LiveRenderer(scene), hand, rng)
