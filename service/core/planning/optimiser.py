"""The search for the best set of poses: greedy from a weak prior, then Fedorov's exchange, several starts.

Minimises tr(W (ΣΛ)⁻¹) over sets of N candidates that keep their distance from each other. Source: Fedorov
(1972), Theory of Optimal Experiments. Not here: what W means (`scoring`), in which order the poses are
taken (`ordering`).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from service.core.errors import PoseSetInfeasible
from service.core.planning.pose_space import Indices, Mask
from service.core.planning.scoring import Objective, objective_metric
from service.core.vision.transforms import Array

Progress = Callable[[float], None]

# In units of the candidates' mean information: enough to make the first pose's information invertible.
PRIOR = 1e-4
LARGEST_SWEEPS = 30
SMALLEST_GAIN = 1e-6
RESTART_SHARE = 0.25
# An exchange tries this many of the steepest candidates; with 100, 400 or all of them the sets came out the
# same.
SHORTLIST = 150


def select_poses(
    information: Array,
    image_points: Array,
    count: int,
    separation_px: float,
    *,
    H: Array | None = None,
    objective: Objective = "parameters",
    seed: int = 0,
    starts: int = 4,
    slots: Sequence[Mask] = (),
    progress: Progress | None = None,
) -> Indices:
    """Return the indices (count,) of the best set found among m candidates; the same seed gives the same set.

    information: (m, p, p). image_points: (m, n, 2) px; the mean corner distance of any two chosen poses is
    at least separation_px. H: (p, p) mapping metric, needed unless the objective is `parameters`. slots:
    for the first places of the result, which candidates (m,) may take them. progress: called with the
    share done; what it raises ends the search. Raises PoseSetInfeasible when no set keeps to all that.
    """
    metric = objective_metric(objective, information, H)
    problem = _Problem.of(information, image_points, separation_px, metric, slots)
    rng = np.random.default_rng(seed)
    best: tuple[float, list[int]] | None = None
    for start in range(starts):
        # The first start sees every candidate; the others see a part, which leads them elsewhere.
        seen = np.ones(len(information), bool) if start == 0 else rng.random(len(information)) < RESTART_SHARE
        chosen = _greedy(problem, count, seen)
        if chosen is None:
            continue
        value, chosen = _exchange(problem, chosen, _part_of(progress, start, starts))
        if best is None or value < best[0] * (1.0 - SMALLEST_GAIN):
            best = value, chosen
    if best is None:
        raise _too_crowded(count, separation_px)
    return np.array(best[1], dtype=np.int64)


def corner_distances(image_points: Array, i: int) -> Array:
    """Return the mean corner distance (m,), px, of every pose of image_points (m, n, 2) to the i-th."""
    difference = image_points - image_points[i]
    distances: Array = np.sqrt(difference[..., 0] ** 2 + difference[..., 1] ** 2).mean(axis=1)
    return distances


@dataclass(frozen=True)
class _Problem:
    """Candidates in scaled parameters, with W; `near` remembers who is too near to a chosen one."""

    information: Array
    metric: Array
    image_points: Array
    separation_px: float
    slots: Sequence[Mask]
    near: dict[int, Mask] = field(default_factory=dict)

    @classmethod
    def of(
        cls,
        information: Array,
        image_points: Array,
        separation_px: float,
        metric: Array,
        slots: Sequence[Mask],
    ) -> "_Problem":
        """Scale the parameters to unit mean information: k3 and fx differ by orders of magnitude."""
        scale = 1.0 / np.sqrt(np.diagonal(information.mean(axis=0)))
        scaling = scale * scale[:, None]
        return cls(information * scaling, metric * scaling, image_points, separation_px, slots)

    def allowed(self, others: list[int], slot: int) -> Mask:
        """Return which candidates (m,) may take a slot beside the others."""
        allowed = np.ones(len(self.information), bool)
        if slot < len(self.slots):
            allowed &= self.slots[slot]
        for i in others:
            if i not in self.near:
                self.near[i] = corner_distances(self.image_points, i) < self.separation_px
                self.near[i][i] = True
            allowed &= ~self.near[i]
        return allowed

    def values(self, total: Array, candidates: Indices) -> Array:
        """Return tr(W (total + Λ)⁻¹) for each candidate (c,)."""
        inverse = np.linalg.inv(total + self.information[candidates])
        values: Array = inverse.reshape(len(candidates), -1) @ self.metric.ravel()
        return values


def _greedy(problem: _Problem, count: int, seen: Mask) -> list[int] | None:
    """Return a set that adds the best candidate at each step, or None where no candidate is left to add."""
    total = PRIOR * np.eye(problem.information.shape[-1])
    chosen: list[int] = []
    for slot in range(count):
        candidates = np.flatnonzero(problem.allowed(chosen, slot) & seen)
        if candidates.size == 0:
            return None
        best = int(candidates[np.argmin(problem.values(total, candidates))])
        chosen.append(best)
        total = total + problem.information[best]
    return chosen


def _exchange(problem: _Problem, chosen: list[int], progress: Progress) -> tuple[float, list[int]]:
    """Return the value and the set after exchanging one pose at a time until no exchange helps."""
    chosen = list(chosen)
    total = PRIOR * 1e-6 * np.eye(problem.information.shape[-1]) + problem.information[chosen].sum(axis=0)
    value = float(np.sum(np.linalg.inv(total) * problem.metric))
    for sweep in range(LARGEST_SWEEPS):
        before = value
        for slot in range(len(chosen)):
            value, total = _improve_slot(problem, chosen, slot, value, total)
            progress((sweep + (slot + 1) / len(chosen)) / LARGEST_SWEEPS)
        if value > before * (1.0 - SMALLEST_GAIN):
            break
    progress(1.0)
    return value, chosen


def _improve_slot(
    problem: _Problem, chosen: list[int], slot: int, value: float, total: Array
) -> tuple[float, Array]:
    """Put the best candidate into a slot of `chosen`; return the new value and the new total information."""
    inverse = np.linalg.inv(total)
    # tr(W (T + Λj − Λi)⁻¹) is convex: it cannot fall below value − (gj − gi), so that only gj > gi can help.
    gradient = inverse @ problem.metric @ inverse
    slope = problem.information.reshape(len(problem.information), -1) @ gradient.ravel()
    others = chosen[:slot] + chosen[slot + 1 :]
    candidates = np.flatnonzero(problem.allowed(others, slot) & (slope > slope[chosen[slot]]))
    if candidates.size == 0:
        return value, total
    if candidates.size > SHORTLIST:
        candidates = candidates[np.argpartition(slope[candidates], -SHORTLIST)[-SHORTLIST:]]
    without = total - problem.information[chosen[slot]]
    values = problem.values(without, candidates)
    best = int(np.argmin(values))
    if values[best] >= value * (1.0 - SMALLEST_GAIN):
        return value, total
    chosen[slot] = int(candidates[best])
    return float(values[best]), without + problem.information[chosen[slot]]


def _part_of(progress: Progress | None, start: int, starts: int) -> Progress:
    """Return the progress of one start as a part of the whole."""

    def report(share: float) -> None:
        if progress is not None:
            progress((start + share) / starts)

    return report


def _too_crowded(count: int, separation_px: float) -> PoseSetInfeasible:
    return PoseSetInfeasible(
        f"No {count} poses lie {separation_px:g} px apart: ask for fewer poses, lower separation_px or widen "
        "the space.",
        count=count,
        separation_px=separation_px,
    )
