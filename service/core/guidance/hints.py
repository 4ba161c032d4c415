"""What the operator is told, as codes: which way to move the board, and what else is missing.

Directions are those of the raw image. A display that mirrors the picture mirrors the codes with it
(`mirror_hint`). "Back" is away from the camera and "forward" towards it. Words, languages and arrows live in
the user interface; when to capture lives in `auto_capture`.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from itertools import chain, combinations
from types import MappingProxyType
from typing import Final

import numpy as np

from service.core.guidance.comparison import PoseDifference, Tolerances, is_match


class Hint(StrEnum):
    """One instruction. The board's top, left and right are those it has in the raw image at the moment."""

    MOVE_LEFT = "move-left"
    MOVE_RIGHT = "move-right"
    MOVE_UP = "move-up"
    MOVE_DOWN = "move-down"
    MOVE_CLOSER = "move-closer"
    MOVE_AWAY = "move-away"
    TILT_TOP_BACK = "tilt-top-back"
    TILT_TOP_FORWARD = "tilt-top-forward"
    TURN_LEFT_BACK = "turn-left-back"
    TURN_RIGHT_BACK = "turn-right-back"
    ROTATE_CLOCKWISE = "rotate-clockwise"
    ROTATE_COUNTERCLOCKWISE = "rotate-counterclockwise"
    TURN_UPSIDE_DOWN = "turn-upside-down"
    HOLD_STILL = "hold-still"
    HOLD = "hold"
    SHOW_BOARD = "show-board"
    SHOW_WHOLE_BOARD = "show-whole-board"
    MORE_LIGHT = "more-light"
    LESS_LIGHT = "less-light"
    WRONG_BOARD = "wrong-board"


@dataclass(frozen=True)
class ShownHint:
    """A hint and how far there is to go: one of AMOUNTS, 1 for much; 1 where it says nothing."""

    code: Hint
    amount: float = 1.0


# Hints of a positive and of a negative error, in the order of PoseDifference's fields.
DIRECTIONS: Final = (
    (Hint.MOVE_RIGHT, Hint.MOVE_LEFT),
    (Hint.MOVE_DOWN, Hint.MOVE_UP),
    (Hint.MOVE_CLOSER, Hint.MOVE_AWAY),
    (Hint.TILT_TOP_FORWARD, Hint.TILT_TOP_BACK),
    (Hint.TURN_LEFT_BACK, Hint.TURN_RIGHT_BACK),
    (Hint.ROTATE_CLOCKWISE, Hint.ROTATE_COUNTERCLOCKWISE),
)
SHIFTS: Final = (0, 1, 2)  # of DIRECTIONS
SIDEWAYS: Final = frozenset({0, 1})  # of DIRECTIONS: one arrow shows both
MOST_INSTRUCTIONS: Final = 2
# Each error alone may move the outer corners by this share of their tolerance.
EFFECT_SHARE: Final = 0.6
# A hint that is being followed is kept until its error is within this share of its tolerance.
KEPT_UNTIL: Final = 0.7
# Of its tolerance: what an error must exceed to be mended for the room that it takes at the picture's border.
SPARE: Final = 0.3
# What is far for a hand, and how much of that may be left: each step is about 1.6 times the one before.
# Not in tolerances: they say how exactly a board must be held, and not how long it takes to get there.
FAR_M: Final = 0.25
FAR_RAD: Final = float(np.deg2rad(95.0))
AMOUNTS: Final = (0.02, 0.04, 0.06, 0.1, 0.15, 0.25, 0.4, 0.6, 1.0)

_MIRRORED_PAIRS: Final = (
    (Hint.MOVE_LEFT, Hint.MOVE_RIGHT),
    (Hint.TURN_LEFT_BACK, Hint.TURN_RIGHT_BACK),
    (Hint.ROTATE_CLOCKWISE, Hint.ROTATE_COUNTERCLOCKWISE),
)
MIRRORED: Final[Mapping[Hint, Hint]] = MappingProxyType(
    {a: b for pair in _MIRRORED_PAIRS for a, b in (pair, pair[::-1])}
)


def choose_hints(
    difference: PoseDifference, tolerances: Tolerances, previous: tuple[Hint, ...]
) -> tuple[Hint, ...]:
    """Return at most two instructions: those of the previous that are not done yet, then the longest ways.

    The longest way decides when the pose is reached; shorter ones are gone meanwhile. A shift to the side and
    one up or down are one instruction, a slanting arrow, so that there may be three hints. What would take
    the board out of the picture as it is held now waits until the other errors are mended, and movements are
    only named together if the board stays in the picture when all of them are made. None where the pose
    matches; only TURN_UPSIDE_DOWN where the board is. An error matters from its tolerance on; where none does
    and the corners are off, the largest in units of its tolerance is named.
    """
    if difference.is_upside_down:
        return (Hint.TURN_UPSIDE_DOWN,)
    if is_match(difference, tolerances):
        return ()
    errors = errors_in_tolerances(difference, tolerances)
    hints = list(errors)
    limits = [KEPT_UNTIL if hint in previous else 1.0 for hint in hints]
    sizes = list(errors.values())
    wanted = [i for i in range(len(hints)) if sizes[i] > limits[i]] or [max(range(6), key=sizes.__getitem__)]
    ordered = sorted(wanted, key=lambda i: (_place(hints[i], previous), -_way_share(i, difference)))
    spare = sorted({i for i in range(6) if sizes[i] > SPARE} - set(wanted), key=lambda i: -sizes[i])
    return tuple(hints[i] for i in _choose_safe(ordered, spare, difference))


def _choose_safe(ordered: list[int], spare: list[int], difference: PoseDifference) -> list[int]:
    """Return which of the wanted movements, by their axes, keep the board in the picture.

    First what is safe alone, with others that are safe beside it. Else two that are only safe together: one
    makes room for the other. That one may be spare, of an error that matters only for the room it takes; else
    a spare one alone. Else what is safe for half of its way, and at last whatever is wanted.
    """
    alone = ([i] for i in ordered if not difference.leads_out[i])
    pairs = (list(pair) for pair in combinations(ordered, 2) if not _lead_out(list(pair), difference))
    safe = next(chain(alone, pairs), None)
    if safe is not None:
        return _add_safe(safe, ordered, difference)
    for_room = ([i, j] for i in spare for j in ordered if not _lead_out([i, j], difference))
    spare_alone = ([i] for i in spare if not difference.leads_out[i])
    room = next(chain(for_room, spare_alone), None)
    if room is not None:
        return room
    half = [i for i in ordered if not difference.half_leads_out[i]]
    return (half or ordered)[:1]


def _add_safe(chosen: list[int], ordered: list[int], difference: PoseDifference) -> list[int]:
    """Return the chosen movements and what may be named beside them, both shifts one after the other."""
    for i in ordered:
        more = [*chosen, i]
        if i not in chosen and _instructions(more) <= MOST_INSTRUCTIONS and not _lead_out(more, difference):
            chosen = more
    return _with_shifts_side_by_side(chosen)


def _with_shifts_side_by_side(axes: list[int]) -> list[int]:
    first = min((axes.index(i) for i in SIDEWAYS.intersection(axes)), default=0)
    return sorted(axes, key=lambda i: first if i in SIDEWAYS else axes.index(i))


def _instructions(axes: list[int]) -> int:
    """Return how many instructions movements are."""
    return len(axes) - (set(axes) >= SIDEWAYS)


def _lead_out(axes: list[int], difference: PoseDifference) -> bool:
    return tuple(sorted(axes)) in difference.together_lead_out


def errors_in_tolerances(difference: PoseDifference, tolerances: Tolerances) -> dict[Hint, float]:
    """Return how far there is to go in units of tolerance, by the six hints that lead there.

    An error counts by its own tolerance or by what it does to the outer corners, whichever is more: near the
    camera 5° of roll move a corner by more than corners may be off.
    """
    t = tolerances
    limits = (t.offset_px, t.offset_px, t.distance_share, t.tilt_rad, t.turn_rad, t.roll_rad)
    values = (
        difference.right_px,
        difference.down_px,
        difference.closer_share,
        difference.tilt_rad,
        difference.turn_rad,
        difference.roll_rad,
    )
    return {
        pair[int(value < 0)]: max(abs(value) / limit, effect / (EFFECT_SHARE * t.corner_px))
        for pair, value, limit, effect in zip(DIRECTIONS, values, limits, difference.effects_px, strict=True)
    }


def show_hints(moves: tuple[Hint, ...], difference: PoseDifference) -> tuple[ShownHint, ...]:
    """Return movements with their amounts.

    One that is alone and would lead out of the picture has half its way before it: a hand goes on for a
    moment and must not get there. Of several that lead out alone, each makes room for the others.
    """
    return tuple(ShownHint(move, coarse_amount(move, difference, is_lone=len(moves) == 1)) for move in moves)


def coarse_amount(hint: Hint, difference: PoseDifference, *, is_lone: bool = False) -> float:
    """Return which of AMOUNTS is nearest to the way left for a movement; 1 for hints that are no movement."""
    axis = next((i for i, pair in enumerate(DIRECTIONS) if hint in pair), None)
    if axis is None:
        return 1.0
    share = _way_share(axis, difference)
    share *= 0.5 if is_lone and difference.leads_out[axis] else 1.0
    return min(AMOUNTS, key=lambda amount: abs(np.log(amount / max(share, AMOUNTS[0]))))


def _way_share(axis: int, difference: PoseDifference) -> float:
    """Return the way left for a movement as a share of what is far for a hand."""
    return difference.ways[axis] / (FAR_M if axis in SHIFTS else FAR_RAD)


def mirror_hint(hint: Hint) -> Hint:
    """Return the hint that says the same in a mirrored picture: left and right change places."""
    return MIRRORED.get(hint, hint)


def _place(hint: Hint, previous: tuple[Hint, ...]) -> int:
    return previous.index(hint) if hint in previous else len(previous)
