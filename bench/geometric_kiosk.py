"""A kiosk without pictures: the hand's pose is projected, its corners get noise, and guidance judges them.

Runs in simulated time. Not here: which poses, starts and hands (`guidance_hand`), and rendered frames.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from service.core.errors import PoseUndetermined
from service.core.guidance.actions import CaptureAccepted, CaptureFrame, Frame
from service.core.guidance.hints import DIRECTIONS, Hint, ShownHint
from service.core.guidance.observation import Observation
from service.core.guidance.session import step
from service.core.guidance.session_poses import start_session
from service.core.guidance.session_state import GuidanceSettings, SessionState
from service.core.guidance.session_view import view
from service.core.vision.camera import Intrinsics, project
from service.core.vision.pose import estimate_pose
from service.core.vision.transforms import Array, Pose
from service.simulator.operator import Hand

NOISE_PX = 0.2
LEAST_PARTIAL = 20
SHARP_PX = 1.5
SEEN_FROM_THE_FRONT = 0.2  # cosine of the flattest view in which corners are found

Display = Callable[[Hint], Hint]
OPPOSITE = {a: b for pair in DIRECTIONS for a, b in (pair, pair[::-1])}


@dataclass(frozen=True)
class GuidedRun:
    """How a run went: when each capture was made, s, the poses captured, and whether every pose was.

    told: the hints that were shown. turnarounds: per pose that was begun, how often the first hint asked for
    the opposite of what it had last asked for on its axis, since the board was last out of sight.
    """

    captured_at_s: tuple[float, ...]
    captures: tuple[Pose, ...]
    complete: bool
    told: frozenset[Hint]
    turnarounds: tuple[int, ...]


@dataclass
class _Watch:
    """What is seen of the screen while a hand is guided."""

    told: set[Hint] = field(default_factory=set)
    turnarounds: list[int] = field(default_factory=lambda: [0])
    latest: set[Hint] = field(default_factory=set)

    def see(self, hints: tuple[ShownHint, ...]) -> None:
        """Take note of the hints of one frame."""
        self.told |= {hint.code for hint in hints}
        if Hint.SHOW_BOARD in {hint.code for hint in hints}:
            self.latest = set()  # wherever the board comes back, it is another way from there
        first = hints[0].code if hints else None
        if first in OPPOSITE:
            self.turnarounds[-1] += OPPOSITE[first] in self.latest
            self.latest = self.latest - {OPPOSITE[first]} | {first}

    def begin_pose(self) -> None:
        """Count anew."""
        self.turnarounds.append(0)
        self.latest = set()


def as_told(hint: Hint) -> Hint:
    """Show a hint as it is."""
    return hint


def guide_hand(
    expected: tuple[Pose, ...],
    hand: Hand,
    settings: GuidanceSettings,
    rng: np.random.Generator,
    *,
    longest_s: float,
    frames_per_s: float = 20.0,
    display: Display = as_told,
    camera: Intrinsics | None = None,
) -> GuidedRun:
    """Return what a hand reaches of the expected poses within a time, seeing hints through a display.

    camera: the true one, where it is not the nominal one that guidance goes by.
    """
    state = start_session(expected)
    captures: list[Pose] = []
    times: list[float] = []
    watch = _Watch()
    seen: tuple[ShownHint, ...] = ()
    for sequence in range(1, int(longest_s * frames_per_s) + 1):
        pose, now_s = hand.step(seen, 1.0 / frames_per_s, rng), sequence / frames_per_s
        frame = observe(pose, now_s, sequence, settings, rng, true_camera=camera)
        state, captured = _take(state, frame, settings)
        seen = tuple(ShownHint(display(hint.code), hint.amount) for hint in view(state, settings).hints)
        watch.see(seen)
        if captured:
            watch.begin_pose()
            captures.append(pose)
            times.append(now_s)
        if state.current is None:
            break
    turnarounds = tuple(watch.turnarounds[: len(expected)])
    return GuidedRun(tuple(times), tuple(captures), state.current is None, frozenset(watch.told), turnarounds)


def observe(
    pose: Pose,
    at_s: float,
    sequence: int,
    settings: GuidanceSettings,
    rng: np.random.Generator,
    *,
    true_camera: Intrinsics | None = None,
) -> Observation:
    """Return what a camera sees of a board at a pose: corners with noise and the pose the nominal gives."""
    target, camera = settings.target, true_camera or settings.intrinsics
    centre = pose.rotation @ target.centre + pose.tvec
    facing = pose.rotation[:, 2] @ centre / np.linalg.norm(centre) > SEEN_FROM_THE_FRONT
    corners = project(camera, pose.rotation, pose.tvec, target.object_points)
    inside = _inside(corners, camera.image_size)
    if not facing or inside.sum() < LEAST_PARTIAL:
        return Observation(at_s, "absent", sequence=sequence)
    if not inside.all():
        return Observation(at_s, "partial", int(inside.sum()), sequence=sequence)
    points = corners + rng.normal(0.0, NOISE_PX, corners.shape)
    try:
        found = estimate_pose(settings.intrinsics, target.object_points, points)
    except PoseUndetermined:
        return Observation(at_s, "partial", len(points), sequence=sequence)
    seen, by = found.freed or (found.pose, None)
    n = len(points)
    return Observation(at_s, "present", n, seen, points, SHARP_PX, 180.0, sequence, camera=by)


def _inside(corners: Array, image_size: tuple[int, int]) -> Array:
    """Return which corners (n, 2) px lie so far inside the image that they can be found: (n,)."""
    last = np.array(image_size) - 5.0
    inside: Array = np.all((corners >= 4.0) & (corners <= last), axis=-1)
    return inside


def _take(state: SessionState, frame: Observation, settings: GuidanceSettings) -> tuple[SessionState, bool]:
    """Judge a frame; whatever is asked for is stored at once."""
    state, effects = step(state, Frame(frame), settings)
    asked = [effect for effect in effects if isinstance(effect, CaptureFrame)]
    for effect in asked:
        state, _ = step(state, CaptureAccepted(effect.pose_index), settings)
    return state, bool(asked)
