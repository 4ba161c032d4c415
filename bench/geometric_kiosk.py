"""A kiosk without pictures: the hand's pose is projected, its corners get noise, and guidance judges them.

Runs in simulated time. Not here: which poses, starts and hands (`guidance_hand`), and rendered frames.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from service.core.errors import PoseUndetermined
from service.core.guidance.actions import CaptureAccepted, CaptureFrame, Frame
from service.core.guidance.hints import Hint, ShownHint
from service.core.guidance.observation import Observation
from service.core.guidance.session import GuidanceSettings, SessionState, start_session, step
from service.core.guidance.session_view import view
from service.core.vision.camera import project
from service.core.vision.pose import estimate_pose
from service.core.vision.transforms import Array, Pose
from service.simulator.operator import Hand

NOISE_PX = 0.2
LEAST_PARTIAL = 20
SHARP_PX = 1.5
SEEN_FROM_THE_FRONT = 0.2  # cosine of the flattest view in which corners are found

Display = Callable[[Hint], Hint]


@dataclass(frozen=True)
class GuidedRun:
    """How a run went: when each capture was made, s, the poses captured, and whether every pose was."""

    captured_at_s: tuple[float, ...]
    captures: tuple[Pose, ...]
    complete: bool
    told: frozenset[Hint] = field(default_factory=frozenset)


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
) -> GuidedRun:
    """Return what a hand reaches of the expected poses within a time, seeing hints through a display."""
    state = start_session(expected)
    captures: list[Pose] = []
    times: list[float] = []
    told: set[Hint] = set()
    seen: tuple[ShownHint, ...] = ()
    for sequence in range(1, int(longest_s * frames_per_s) + 1):
        pose, now_s = hand.step(seen, 1.0 / frames_per_s, rng), sequence / frames_per_s
        frame = observe(pose, now_s, sequence, settings, rng)
        state, captured = _take(state, frame, settings)
        seen = tuple(ShownHint(display(hint.code), hint.amount) for hint in view(state, settings).hints)
        told |= {hint.code for hint in seen}
        if captured:
            captures.append(pose)
            times.append(now_s)
        if state.current is None:
            break
    return GuidedRun(tuple(times), tuple(captures), state.current is None, frozenset(told))


def observe(
    pose: Pose, at_s: float, sequence: int, settings: GuidanceSettings, rng: np.random.Generator
) -> Observation:
    """Return what a camera would see of a board at a pose: corners with noise and the pose they give."""
    target, camera = settings.target, settings.intrinsics
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
        seen = estimate_pose(camera, target.object_points, points).pose
    except PoseUndetermined:
        return Observation(at_s, "partial", len(points), sequence=sequence)
    return Observation(at_s, "present", len(points), seen, points, SHARP_PX, 180.0, sequence)


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
