"""Which pose a session asks for: the next one, another one first, one beyond the set; and when it is done.

Parts of the reducer in `session`. Not here: which pose beyond the set is worth asking for (`planning`).
"""

from collections.abc import Iterable
from dataclasses import replace

from service.core.guidance.actions import (
    AddedFor,
    AddedPose,
    CapturesJudged,
    PoseNotReached,
    PoseWanted,
    RunComplete,
)
from service.core.guidance.session_state import GuidanceSettings, SessionState, Step
from service.core.vision.transforms import Pose


def start_session(
    expected: Iterable[Pose],
    captured: Iterable[int] = (),
    automatic: bool = True,
    postponed: Iterable[int] = (),
    added: Iterable[AddedPose] = (),
) -> SessionState:
    """Return the state of a run, new or resumed.

    expected: the set's poses; captured: pose indices in the order they were taken. A pose that was added and
    not captured is asked for first, as it was before.
    """
    more, order = tuple(added), tuple(dict.fromkeys(captured))
    poses = (*expected, *(one.pose for one in more))
    done = frozenset(order)
    later = tuple(i for i in postponed if i not in done)
    fresh = SessionState(poses, done, order, None, automatic, postponed=later, added=more)
    open_added = [i for i in fresh.open if i >= len(poses) - len(more)]
    return replace(fresh, current=open_added[-1] if open_added else next_pose(fresh, 0))


def postpone(state: SessionState, pose_index: int) -> SessionState:
    """Ask for another open pose; the current one comes after all others. Not while a capture is stored."""
    current = state.current
    if current is None or pose_index == current or pose_index not in state.open or state.pending is not None:
        return state
    later = tuple(i for i in state.postponed if i != current)
    return replace(
        afresh(state), current=pose_index, postponed=(*later, current), instead_of=current, refused=None
    )


def despair(state: SessionState, pose_index: int, settings: GuidanceSettings) -> Step:
    """Say that a pose is not reached, once in a patience: another one first, or one in its place.

    In its place where it was put off before, or where there is no other one to take first.
    """
    if state.tried_s <= settings.patience_s:
        return state, ()
    again, tried_s, has_others = replace(state, tried_s=0.0), state.tried_s, len(state.open) > 1
    may_replace = state.count_added(out_of_reach=True) < settings.most_added
    if may_replace and (pose_index in state.postponed or not has_others):
        return again, (PoseWanted(AddedFor.OUT_OF_REACH, pose_index, tried_s),)
    if has_others:
        return again, (PoseNotReached(pose_index, tried_s),)
    return _complete(state) if _may_give_up(state, pose_index) else (state, ())


def weigh(state: SessionState, judged: CapturesJudged, settings: GuidanceSettings) -> Step:
    """Complete the run where no pose is open or enough is proven; or want the pose that may mend a lack."""
    if state.pending is not None or (state.current is not None and not judged.is_enough):
        return state, ()
    may_add = state.count_added(out_of_reach=False) < settings.most_added
    if state.current is None and judged.lacks is not None and may_add:
        return state, (PoseWanted(judged.lacks, judged.weak),)
    return _complete(state)


def add_pose(state: SessionState, added: AddedPose) -> SessionState:
    """Ask for a pose beyond the set, instead of the one it replaces; not while a capture is stored."""
    if state.pending is not None:
        return state
    return replace(
        afresh(state),
        expected=(*state.expected, added.pose),
        added=(*state.added, added),
        captured=state.captured - {added.replaces},
        order=tuple(i for i in state.order if i != added.replaces),
        postponed=tuple(i for i in state.postponed if i != added.replaces),
        current=len(state.expected),
        instead_of=added.replaces,
        refused=None,
    )


def next_pose(state: SessionState, after: int) -> int | None:
    """Return the first open pose from `after` on, else the first of all, else a postponed one, else None."""
    waiting = [i for i in state.open if i not in state.postponed]
    return next((i for i in waiting if i >= after), next(iter(state.open), None))


def afresh(state: SessionState) -> SessionState:
    """Return the state without what was made of the latest frame, for another try."""
    return replace(state, difference=None, obstacles=(), moves=(), dwell=None, tried_s=0.0)


def _complete(state: SessionState) -> Step:
    return replace(afresh(state), current=None, instead_of=None), (RunComplete(),)


def _may_give_up(state: SessionState, pose_index: int) -> bool:
    return state.open == (pose_index,) and state.is_optional(pose_index)


def give_up(state: SessionState) -> Step:
    """Complete the run where only a pose is open that it can do without, or none; else change nothing."""
    if state.current is None or _may_give_up(state, state.current):
        return _complete(state)
    return state, ()
