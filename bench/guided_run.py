"""One vehicle guided without a server, in simulated time: all parts are the real ones but clock and storage.

A hand that reads only hints → live pictures → the live detector → pose → the session → for each capture the
exact picture of that very frame → the capture's detector → the verdict. What the service does over its
socket in `service.usecases.guide` is done here in a loop. Not here: which vehicles, and what is made of them.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from service.core.errors import DegenerateViews, ServiceError, TooFewViews
from service.core.guidance.actions import CaptureAccepted, CaptureFrame, CaptureRefused, Frame
from service.core.guidance.comparison import default_tolerances
from service.core.guidance.session import step
from service.core.guidance.session_poses import start_session
from service.core.guidance.session_state import GuidanceSettings, SessionState
from service.core.guidance.session_view import view
from service.core.quality.evidence import Expectation, NamedDetection
from service.core.quality.limits import default_limits
from service.core.quality.verdict import Judged, calibrate_and_judge
from service.core.vision.camera import Intrinsics
from service.core.vision.detection import detect_target
from service.core.vision.target import Target
from service.core.vision.transforms import Pose
from service.simulator.frame_source import VirtualSource
from service.simulator.live_renderer import LiveRenderer
from service.simulator.operator import Hand
from service.simulator.renderer import PreparedScene, prepare
from service.simulator.scene import Scene
from service.simulator.shutter import between, take_picture
from service.usecases.guide import TOLERANCE_OF_LIMIT
from service.usecases.guide_frames import Eye

LONGEST_POSE_S = 60.0  # on average; whoever needs longer has not completed the run


@dataclass(frozen=True)
class Guidance:
    """All that guidance knows: the nominal camera, the target, the poses it asks for, and its frame rate."""

    nominal: Intrinsics
    target: Target
    poses: tuple[Pose, ...]
    frames_per_s: float = 15.0

    @property
    def settings(self) -> GuidanceSettings:
        """What a session of a SKU with default limits is judged by."""
        size = self.nominal.image_size
        default = default_tolerances(size)
        limit_px = TOLERANCE_OF_LIMIT * default_limits(size).match_share * size[0]
        tolerances = replace(default, corner_px=min(default.corner_px, limit_px))
        return GuidanceSettings(self.nominal, self.target, tolerances)

    @property
    def frame_s(self) -> float:
        """Time between two frames, s."""
        return 1.0 / self.frames_per_s


@dataclass(frozen=True)
class Vehicle:
    """A true camera before which a board is held: its scene, ready for exact and for live pictures."""

    prepared: PreparedScene
    live: LiveRenderer
    exposure_s: float = 0.0

    @property
    def camera(self) -> Intrinsics:
        """The true intrinsics."""
        return self.prepared.scene.intrinsics


def make_vehicle(scene: Scene, exposure_s: float = 0.0) -> Vehicle:
    """Return the vehicle of a scene, whose exact pictures take so long; it takes a second to make."""
    return Vehicle(prepare(scene), LiveRenderer(scene), exposure_s)


@dataclass
class GuidedRun:
    """A run: poses captured, their pictures and detections, captures refused by reason, simulated time, s."""

    answered: list[int] = field(default_factory=list)
    images: list[NDArray[np.uint8]] = field(default_factory=list)
    detections: list[NamedDetection] = field(default_factory=list)
    refused: list[str] = field(default_factory=list)
    elapsed_s: float = 0.0
    complete: bool = False


def guide_vehicle(vehicle: Vehicle, guidance: Guidance, hand: Hand, rng: np.random.Generator) -> GuidedRun:
    """Return how a hand was guided before a vehicle, to the last pose or until it took too long."""
    settings = guidance.settings
    source_rng, capture_rng = rng.spawn(2)
    source = VirtualSource(vehicle.prepared, vehicle.live, hand, source_rng)
    eye, state, run = Eye(settings), start_session(guidance.poses), GuidedRun()
    longest_s = LONGEST_POSE_S * len(guidance.poses)
    while state.current is not None and run.elapsed_s < longest_s:
        frame = source.next_frame(view(state, settings).hints, guidance.frame_s)
        run.elapsed_s = frame.at_s
        state, effects = step(state, Frame(eye.observe(frame)), settings)
        for effect in effects:
            if isinstance(effect, CaptureFrame):
                image = photograph(vehicle, guidance, source, effect.sequence, capture_rng)
                state = _keep(run, eye, state, settings=settings, wanted=effect, image=image)
    run.complete = state.current is None
    return run


def photograph(
    vehicle: Vehicle, guidance: Guidance, source: VirtualSource, sequence: int, rng: np.random.Generator
) -> NDArray[np.uint8]:
    """Return the exact picture of a frame, exposed until the moment of that frame."""
    if vehicle.exposure_s == 0.0:
        return source.capture(sequence)
    before, now = source.pose_of(sequence - 1), source.pose_of(sequence)
    share = 1.0 - vehicle.exposure_s / guidance.frame_s
    return take_picture(vehicle.prepared, between(before, now, share, guidance.target), now, rng)


def judge_run(run: GuidedRun, guidance: Guidance) -> Judged | None:
    """Return the judged calibration of a run; None where its captures make none."""
    expectation = Expectation(guidance.nominal, poses=guidance.poses, pose_of_view=tuple(run.answered))
    try:
        return calibrate_and_judge(run.detections, guidance.target, guidance.nominal.lens, expectation)
    except (TooFewViews, DegenerateViews):
        return None


def missed_gates(judged: Judged) -> list[str]:
    """Return the names of the measurements that did not pass."""
    return [one.name for one in judged.measurements if one.verdict != "PASS"]


def errors_px(judged: Judged, truth: Intrinsics, names: Sequence[str]) -> dict[str, float]:
    """Return estimated minus true parameters by name."""
    found, true = judged.result.intrinsics.parameters, truth.parameters
    return {name: found[name] - true[name] for name in names}


def _keep(
    run: GuidedRun,
    eye: Eye,
    state: SessionState,
    *,
    settings: GuidanceSettings,
    wanted: CaptureFrame,
    image: NDArray[np.uint8],
) -> SessionState:
    """Take a full picture into the run, or refuse it, as the service does; return the session's state."""
    try:
        eye.check_same(wanted.sequence, image)
        detection = detect_target(image, settings.target)
    except ServiceError as error:
        run.refused.append(error.code)
        return step(state, CaptureRefused(wanted.pose_index, error.code), settings)[0]
    run.answered.append(wanted.pose_index)
    run.images.append(image)
    run.detections.append(NamedDetection(f"pose-{wanted.pose_index + 1:02d}", detection))
    return step(state, CaptureAccepted(wanted.pose_index), settings)[0]
