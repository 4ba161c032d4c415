"""The guidance of one run: frames in, what to tell out; captures are stored before anything is said of them.

Calls come one at a time, each from any thread. Everything that must outlive the session is stored: whoever
takes the run again goes on at the same pose. Not here: sockets, and where frames come from.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from uuid import UUID

from service.core.errors import Fact, PoseTaken, RunAborted, RunAlreadyFinished, ServiceError
from service.core.guidance.actions import (
    Action,
    AddedPose,
    AddPose,
    CaptureAccepted,
    CaptureFrame,
    CaptureRefused,
    DiscardCapture,
    Effect,
    Frame,
    ManualCapture,
    NoPoseToAdd,
    PoseNotReached,
    PoseWanted,
    Retake,
    RunComplete,
    SetAutomatic,
    TakeAnother,
    Undo,
)
from service.core.guidance.comparison import default_tolerances
from service.core.guidance.hints import ShownHint
from service.core.guidance.problems import FrameMissing, RevisionRetired
from service.core.guidance.session import step
from service.core.guidance.session_poses import start_session
from service.core.guidance.session_state import GuidanceSettings
from service.core.guidance.session_view import view
from service.core.vision.transforms import Pose
from service.ports import BlobStore, Clock, LiveFrame
from service.storage.database import Database
from service.usecases.added_poses import NewPose, add_run_pose
from service.usecases.captures import add_capture, withdraw_capture
from service.usecases.finish import finish_run
from service.usecases.guide_camera import view_camera
from service.usecases.guide_estimate import Estimate, estimate_so_far
from service.usecases.guide_frames import Eye, Pixels, to_png
from service.usecases.guide_judgement import judge_captures
from service.usecases.guide_new_pose import choose_new_pose
from service.usecases.guide_next_pose import Postponed, choose_another, record_postponed
from service.usecases.guide_refusals import refusal_of
from service.usecases.guide_runs import GuidedRun, Wish, capture_of_pose, load_guided_run, take_run
from service.usecases.guide_views import (
    AcceptedView,
    ClosedView,
    GuidedRunView,
    RefusedView,
    StateView,
    Told,
    WantedFrame,
    view_run,
    view_state,
    view_verdict,
)
from service.usecases.observation import Picture
from service.usecases.results import read_result
from service.usecases.runs import abort_run
from service.usecases.signing import KeyRing

# Of the limit that the gate holds: a match at the very limit might be a FAIL on the exact corners.
TOLERANCE_OF_LIMIT = 0.9


@dataclass(frozen=True)
class Plant:
    """What sessions work on."""

    database: Database
    blobs: BlobStore
    clock: Clock
    signing_keys: KeyRing
    largest_pixels: int


class GuidedSession:
    """One run in guidance, by whom; `is_over` once it has a stored result or was aborted."""

    def __init__(self, plant: Plant, run: GuidedRun, who: str) -> None:
        self.run = run
        self.is_over = False
        self._plant, self._who = plant, who
        self._settings = _settings(run)
        self._state = start_session(run.poses, run.captured, postponed=run.postponed, added=run.added)
        self._hand: Pose | None = None
        self._eye = Eye(self._settings)
        self._wanted: CaptureFrame | None = None
        self._estimate = self._estimate_so_far()

    @property
    def hints(self) -> tuple[ShownHint, ...]:
        """What the operator reads now."""
        return view(self._state, self._settings).hints

    def begin(self) -> list[Told]:
        """Return what is told first; a run that has the captures it needs is finished at once."""
        told: list[Told] = [self.show_run()]
        if self.run.is_retired:
            told.append(
                RevisionRetired(
                    f"Revision {self.run.number} of SKU '{self.run.sku}' was replaced since this run was "
                    "opened. The run goes on with it; abort it and open a new one to use the newest one.",
                    sku=self.run.sku,
                    revision=self.run.number,
                )
            )
        return [*told, *self._judge()]

    def show_run(self) -> GuidedRunView:
        """Return the run as a whole."""
        return view_run(self.run, self._state, self._settings, self._estimate)

    def see(self, frame: LiveFrame) -> list[Told]:
        """Judge a live frame; raises WrongImageSize."""
        observation = self._eye.observe(frame)
        self._hand = observation.pose or self._hand
        told = self._apply(Frame(observation))
        return [replace(self._show_state(), camera=view_camera(frame)), *told]

    def capture(self, *, is_forced: bool = False) -> list[Told]:
        """Ask for the picture that is on the screen; is_forced: though it does not meet the checks.

        Who may force is for the caller to know.
        """
        at_s = 0.0 if self._state.last is None else self._state.last.at_s
        told = self._apply(ManualCapture(at_s, is_forced))
        if not told and self._state.refused and self._state.pending is None:
            return [RefusedView(self._state.current, refusal_of(self._state))]
        return told

    def keep(self, sequence: int, image: Pixels, **facts: Fact) -> list[Told]:
        """Store the full picture that was asked for; one that was not asked for is dropped.

        facts: about the frame, for the audit trail.
        """
        wanted = self._wanted
        if wanted is None or wanted.sequence != sequence or self.is_over:
            return []
        self._wanted = None
        try:
            self._eye.check_same(sequence, image)
            accepted = self._store(wanted.pose_index, image, {**facts, **_facts_of(wanted)})
        except (RunAborted, RunAlreadyFinished) as error:
            return self._ended_elsewhere(error)
        except PoseTaken as error:
            # Somebody uploaded this pose over another interface: it has its capture.
            self._accept(wanted.pose_index)
            return [RefusedView(wanted.pose_index, error), self.show_run(), *self._judge()]
        except ServiceError as error:
            return self._refuse(wanted.pose_index, error)
        self._accept(wanted.pose_index)
        shown = self.show_run()
        told = replace(accepted, captured=shown.captured, accuracy=shown.accuracy, estimate=shown.estimate)
        return [told, *self._judge()]

    def miss(self, sequence: int) -> list[Told]:
        """Give up on the full picture that was asked for."""
        wanted = self._wanted
        if wanted is None or wanted.sequence != sequence:
            return []
        self._wanted = None
        error = FrameMissing(
            "The full picture did not come in time. Hold the board still; the pose is taken again.",
            sequence=sequence,
        )
        return self._refuse(wanted.pose_index, error)

    def undo(self) -> list[Told]:
        """Take the newest capture back."""
        return self._take_back(Undo())

    def retake(self, pose_index: int) -> list[Told]:
        """Take the capture of one pose back."""
        return self._take_back(Retake(pose_index))

    def set_automatic(self, automatic: bool) -> list[Told]:
        """Let the session capture by itself, or only when it is told."""
        self._apply(SetAutomatic(automatic))
        return [self.show_run()]

    def abort(self) -> list[Told]:
        """End the run without a result; raises RunAlreadyFinished, RunAborted."""
        with self._plant.database.write() as session:
            abort_run(session, self.run.id, self._who, self._plant.clock.now())
        self.is_over = True
        return [ClosedView(self.run.id, "aborted")]

    def _apply(self, action: Action) -> list[Told]:
        self._state, effects = step(self._state, action, self._settings)
        return [told for effect in effects for told in self._do(effect)]

    def _do(self, effect: Effect) -> list[Told]:
        match effect:
            case CaptureFrame(_, sequence):
                self._wanted = effect
                return [WantedFrame(sequence)]
            case PoseNotReached(pose_index, tried_s):
                self._offer_another(pose_index, tried_s)
            case PoseWanted():
                return self._add_pose(effect)
            case RunComplete():
                return self._finish()
            case DiscardCapture(pose_index):
                self._withdraw(pose_index)
        return []

    def _offer_another(self, pose_index: int, tried_s: float) -> None:
        another = choose_another(self.run.revision, self._state, self._hand)
        if another is None:
            return
        with self._plant.database.write() as session:
            postponed = Postponed(pose_index, another, tried_s)
            record_postponed(session, self.run.id, postponed, self._who, self._plant.clock.now())
        self._apply(TakeAnother(another))

    def _accept(self, pose_index: int) -> None:
        self._apply(CaptureAccepted(pose_index))
        self._estimate = self._estimate_so_far()

    def _judge(self) -> list[Told]:
        """Go on by what the captures are worth: with a pose more, with the result, or as before."""
        return self._apply(judge_captures(self._plant.database, self.run, self._state, self._estimate))

    def _add_pose(self, wanted: PoseWanted) -> list[Told]:
        """Ask for a new pose; it is stored before anybody is told of it."""
        pose = choose_new_pose(self.run.revision, self._state, wanted, self._hand)
        if pose is None:
            return self._apply(NoPoseToAdd())
        added = AddedPose(pose, wanted.reason, wanted.replaces)
        new = NewPose(len(self._state.expected), added, wanted.tried_s)
        try:
            with self._plant.database.write() as session:
                stored = add_run_pose(session, self.run.id, new, self._who, self._plant.clock.now())
        except (RunAborted, RunAlreadyFinished) as error:
            return self._ended_elsewhere(error)
        self._apply(AddPose(stored))
        self._estimate = self._estimate_so_far()
        return [self.show_run()]

    def _store(self, pose_index: int, image: Pixels, facts: Mapping[str, Fact]) -> AcceptedView:
        plant = self._plant
        picture = Picture(to_png(image), f"pose-{pose_index + 1:02d}.png", plant.largest_pixels)
        stored = add_capture(
            plant.database,
            plant.blobs,
            self.run.id,
            picture,
            pose_index=pose_index,
            who=self._who,
            now=plant.clock.now(),
            facts=facts,
        ).view
        return AcceptedView(
            pose_index=pose_index,
            capture_id=stored.id,
            number=stored.number,
            captured=[],
            total=self._state.total,
            match_error_px=stored.match_error_px,
            edge_width_px=stored.edge_width_px,
            accuracy=None,
            estimate=None,
        )

    def _refuse(self, pose_index: int, error: ServiceError) -> list[Told]:
        self._apply(CaptureRefused(pose_index, error.code))
        return [RefusedView(pose_index, error)]

    def _take_back(self, action: Undo | Retake) -> list[Told]:
        before = self._state
        try:
            self._apply(action)
        except (RunAborted, RunAlreadyFinished) as error:
            return self._ended_elsewhere(error)
        except ServiceError:
            # It is still stored, so it still counts.
            self._state = before
            raise
        self._estimate = self._estimate_so_far()
        return [self.show_run()]

    def _withdraw(self, pose_index: int) -> None:
        with self._plant.database.write() as session:
            capture_id = capture_of_pose(session, self.run.id, pose_index)
            if capture_id is not None:
                now = self._plant.clock.now()
                withdraw_capture(session, self.run.id, capture_id, self._who, now)

    def _finish(self) -> list[Told]:
        try:
            plant = self._plant
            result = finish_run(plant.database, plant.signing_keys, self.run.id, self._who, plant.clock.now())
        except (RunAborted, RunAlreadyFinished) as error:
            return self._ended_elsewhere(error)
        except ServiceError as error:
            # The run stays open with all its captures: a pose can be taken again, or it is aborted.
            return [error]
        self.is_over = True
        return [view_verdict(self.run.serial, result)]

    def _ended_elsewhere(self, error: ServiceError) -> list[Told]:
        """Tell how the run ended over another interface."""
        self.is_over = True
        if isinstance(error, RunAborted):
            return [error, ClosedView(self.run.id, "aborted")]
        with self._plant.database.read() as session:
            return [view_verdict(self.run.serial, read_result(session, self.run.id))]

    def _estimate_so_far(self) -> Estimate | None:
        with self._plant.database.read() as session:
            return estimate_so_far(session, self.run.id, self.run.revision)

    def _show_state(self) -> StateView:
        return view_state(self.run.id, self._state, self._settings, self._estimate)


def open_session(plant: Plant, station: str, wish: Wish, who: str) -> GuidedSession:
    """Return the session of a serial's open run at a station; opened where there is none.

    Raises what `take_run` raises.
    """
    with plant.database.write() as session:
        run_id = take_run(session, station, wish, who, plant.clock.now())
    return resume_session(plant, run_id, who)


def resume_session(plant: Plant, run_id: UUID, who: str) -> GuidedSession:
    """Return the session of a run as it is stored; raises NotFound, PoseSetNotPublished."""
    with plant.database.read() as session:
        run = load_guided_run(session, run_id)
    return GuidedSession(plant, run, who)


def _facts_of(wanted: CaptureFrame) -> dict[str, Fact]:
    """Return how a capture came about, for the audit trail."""
    trigger = "manual" if wanted.is_manual else "automatic"
    return {"trigger": trigger} | ({"overridden": list(wanted.overridden)} if wanted.overridden else {})


def _settings(run: GuidedRun) -> GuidanceSettings:
    intrinsics = run.revision.intrinsics
    default = default_tolerances(intrinsics.image_size)
    limit_px = run.revision.limits.match_share * intrinsics.image_size[0]
    tolerances = replace(default, corner_px=min(default.corner_px, TOLERANCE_OF_LIMIT * limit_px))
    target, most_added = run.revision.target, run.revision.extra_poses
    return GuidanceSettings(intrinsics, target, tolerances, most_added=most_added)
