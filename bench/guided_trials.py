"""What a blind hand is put to: stations with planned poses, starts, and trials that run side by side.

Pure geometry (`geometric_kiosk`). Every trial has its own seed, so that the figures do not depend on how many
processes share the work. Not here: which trials make the proof, and its figures (`guidance_hand`).
"""

import multiprocessing
from collections.abc import Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from bench.geometric_kiosk import OPPOSITE, GuidedRun, as_told, guide_hand
from service.core.guidance.comparison import default_tolerances
from service.core.guidance.hints import Hint, mirror_hint
from service.core.guidance.session_state import GuidanceSettings
from service.core.planning.plan import plan_pose_set
from service.core.planning.pose_space import PoseSpace, sample_poses
from service.core.vision.camera import Intrinsics
from service.core.vision.target import Target, parse_target
from service.core.vision.transforms import Pose, rotation_matrix, rotation_vector
from service.simulator.operator import Habits, Hand

SEED: Final = 0
LONGEST_POSE_S: Final = 60.0
LONGEST_RUN_S: Final = 240.0
LONGEST_FLIPPED_S: Final = 15.0  # for each pose
FRAMES_PER_S: Final = 15.0
UPSIDE_DOWN_EVERY: Final = 10
TRIALS_AT_ONCE: Final = 4  # handed to a process


@dataclass(frozen=True)
class Station:
    """A lens with its planned poses. camera: the true one; guidance goes by the nominal of the settings."""

    code: str
    settings: GuidanceSettings
    poses: tuple[Pose, ...]
    camera: Intrinsics


@dataclass(frozen=True)
class Trial:
    """Poses that a hand is guided to: from a start or from home, by habits, perhaps with one hint flipped."""

    station: Station
    poses: tuple[Pose, ...]
    start: Pose | None
    seed: int
    longest_s: float
    habits: Habits
    flipped: Hint | None = None


def plan_station(sku: Mapping[str, Any], candidates: int, count: int) -> Station:
    """Return a SKU document's lens with its planned set."""
    width, height = sku["image_size"]
    camera = Intrinsics.from_parameters(sku["lens"], sku["nominal"], (width, height))
    target = parse_target(sku["target"])
    planned = plan_pose_set(camera, target, PoseSpace(), count, SEED, candidates=candidates)
    settings = GuidanceSettings(camera, target, default_tolerances(camera.image_size))
    return Station(sku["code"], settings, planned.poses, camera)


def with_nominal_off(station: Station, share: float) -> Station:
    """Return the station with a camera whose nominal focal length is wrong by a share of the true one."""
    nominal = station.settings.intrinsics
    vector = nominal.vector
    vector[:2] /= 1.0 + share
    return replace(station, camera=Intrinsics.from_vector(nominal.lens, vector, nominal.image_size))


def random_starts(station: Station, count: int, seed: int) -> list[Pose]:
    """Return poses to begin with: feasible ones, one in ten turned upside down."""
    target = station.settings.target
    poses = sample_poses(PoseSpace(), station.camera, target, count, seed)
    starts = [poses.pose(i) for i in range(count)]
    return [
        upside_down(start, target) if i % UPSIDE_DOWN_EVERY == UPSIDE_DOWN_EVERY - 1 else start
        for i, start in enumerate(starts)
    ]


def upside_down(pose: Pose, target: Target) -> Pose:
    """Return the pose of the board turned by 180° in its own plane about its centre."""
    R = pose.rotation @ rotation_matrix(np.array([0.0, 0.0, np.pi]))
    return Pose(rotation_vector(R), pose.rotation @ target.centre + pose.tvec - R @ target.centre)


def reaching(station: Station, pose: Pose, start: Pose, seed: int, *, mirrored: bool = False) -> Trial:
    """Return the trial of one pose from a start."""
    habits = Habits(lapses_per_s=0.0, mirrored=mirrored)
    return Trial(station, (pose,), start, seed, LONGEST_POSE_S, habits)


def whole_run(station: Station, seed: int, *, mirrored: bool = False) -> Trial:
    """Return the trial of a whole set, from home and with lapses."""
    return Trial(station, station.poses, None, seed, LONGEST_RUN_S, Habits(mirrored=mirrored))


def flipped_run(station: Station, flipped: Hint | None) -> Trial:
    """Return the trial of a whole set in which one hint points the wrong way; without lapses."""
    habits = Habits(lapses_per_s=0.0)
    longest_s = LONGEST_FLIPPED_S * len(station.poses)
    return Trial(station, station.poses, None, SEED, longest_s, habits, flipped)


def attempt(trial: Trial) -> GuidedRun:
    """Return how a trial went."""

    def flip(hint: Hint) -> Hint:
        return OPPOSITE[hint] if hint == trial.flipped else hint

    display = mirror_hint if trial.habits.mirrored else flip if trial.flipped else as_told
    hand = Hand(trial.station.settings.target, trial.start, trial.habits)
    return guide_hand(
        trial.poses,
        hand,
        trial.station.settings,
        np.random.default_rng(trial.seed),
        longest_s=trial.longest_s,
        frames_per_s=FRAMES_PER_S,
        display=display,
        camera=trial.station.camera,
    )


def attempt_all(trials: Sequence[Trial], processes: int) -> list[GuidedRun]:
    """Return how each trial went; the work is shared among processes, the outcome is the same."""
    if processes <= 1:
        return [attempt(trial) for trial in trials]
    with ProcessPoolExecutor(processes, multiprocessing.get_context("spawn")) as pool:
        return list(pool.map(attempt, trials, chunksize=TRIALS_AT_ONCE))


def duration(done: GuidedRun, trial: Trial) -> float:
    """Return when the last pose was captured, s, or how long it was tried in vain."""
    return done.captured_at_s[-1] if done.complete else trial.longest_s
