"""The search for the best set of poses: greedy from a weak prior, then Fedorov's exchange, several starts.

Minimises tr(W (ΣΛ)⁻¹), averaged over draws, over sets of N candidates that keep their distance from each
other. Source: Fedorov (1972), Theory of Optimal Experiments. Not here: what W means (`criterion`), in which
order the poses are taken (`ordering`).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from service.core.errors import PoseSetInfeasible
from service.core.planning.criterion import Criterion
from service.core.planning.pose_space import Indices, Mask
from service.core.vision.transforms import Array

Progress = Callable[[float], None]
Floats = NDArray[np.float32]

# In units of the candidates' mean information: enough to make the first pose's information invertible.
PRIOR = 1e-4
LARGEST_SWEEPS = 30
SMALLEST_GAIN = 1e-6
RESTART_SHARE = 0.25
# An exchange tries this many of the steepest candidates; with 100, 400 or all of them the sets came out the
# same.
SHORTLIST = 150
# With four starts the expected norm was better by a tenth of a per cent, with one worse by three.
STARTS = 2
# With fewer poses the camera is hardly determined, and slopes say little.
SURE_FROM = 4
# Rounds in which the weight moves to the pixels that the best set serves worst.
WORST_ROUNDS = 4


def select_poses(
    information: Array,
    image_points: Array,
    count: int,
    separation_px: float,
    criterion: Criterion,
    *,
    seed: int = 0,
    starts: int = STARTS,
    slots: Sequence[Mask] = (),
    begin: Sequence[int] = (),
    progress: Progress | None = None,
) -> Indices:
    """Return the indices (count,) of the best set found among m candidates; the same seed gives the same set.

    information: (m, p, p), or (d, m, p, p) of d draws over which a set is averaged. image_points: (m, n, 2)
    px; the mean corner distance of any two chosen poses is at least separation_px. slots: for the first
    places of the result, which candidates (m,) may take them. begin: candidates that the first places start
    with. progress: called with the share done; what it raises ends the search. Raises PoseSetInfeasible when
    no set keeps to all that.
    """
    problem = _Problem.of(information, image_points, separation_px, criterion, slots)
    rng = np.random.default_rng(seed)
    rounds = starts + (WORST_ROUNDS if criterion.has_worst else 0)
    best: tuple[float, list[int]] | None = None
    for start in range(starts):
        # The first start sees every candidate; the others see a part, which leads them elsewhere.
        seen = np.ones(problem.size, bool) if start == 0 else rng.random(problem.size) < RESTART_SHARE
        chosen = _greedy(problem, count, seen, begin)
        if chosen is None:
            continue
        chosen = _exchange(problem, chosen, _part_of(progress, start, rounds))
        best = _better(best, problem, chosen)
    if best is None:
        raise _too_crowded(count, separation_px)
    for step in range(starts, rounds):
        problem = problem.towards_the_worst(best[1])
        best = _better(best, problem, _exchange(problem, best[1], _part_of(progress, step, rounds)))
    return np.array(best[1], dtype=np.int64)


def corner_distances(image_points: Array, i: int) -> Array:
    """Return the mean corner distance (m,), px, of every pose of image_points (m, n, 2) to the i-th."""
    difference = image_points - image_points[i]
    distances: Array = np.sqrt(difference[..., 0] ** 2 + difference[..., 1] ** 2).mean(axis=1)
    return distances


@dataclass(frozen=True)
class _Problem:
    """Candidates (d, m, p, p) in scaled parameters, with W; `near`: who is too near to a chosen one."""

    information: Array
    flat: Floats
    metric: Array
    scaling: Array
    criterion: Criterion
    image_points: Array
    middles: Array
    separation_px: float
    slots: Sequence[Mask]
    near: dict[int, Mask] = field(default_factory=dict)

    @classmethod
    def of(
        cls,
        information: Array,
        image_points: Array,
        separation_px: float,
        criterion: Criterion,
        slots: Sequence[Mask],
    ) -> "_Problem":
        """Scale the parameters to unit mean information: k3 and fx differ by orders of magnitude."""
        draws = information if information.ndim == 4 else information[None]
        scale = 1.0 / np.sqrt(np.diagonal(draws.mean(axis=(0, 1))))
        scaling = scale * scale[:, None]
        scaled = np.ascontiguousarray(draws * scaling)
        # Single precision: slopes only choose who is looked at more closely.
        flat = scaled.reshape(*scaled.shape[:2], -1).astype(np.float32)
        metric = criterion.metric * scaling
        middles = image_points.mean(axis=1)
        return cls(scaled, flat, metric, scaling, criterion, image_points, middles, separation_px, slots)

    @property
    def size(self) -> int:
        return int(self.information.shape[1])

    def value(self, chosen: list[int]) -> float:
        """Return what a set is worth, with the true worst."""
        return self.criterion.value(self._covariances(chosen))

    def towards_the_worst(self, chosen: list[int]) -> "_Problem":
        """Return the problem with more weight on the pixels that a set serves worst."""
        criterion = self.criterion.towards_the_worst(self._covariances(chosen))
        return replace(self, criterion=criterion, metric=criterion.metric * self.scaling)

    def _covariances(self, chosen: list[int]) -> Array:
        covariances: Array = np.linalg.inv(self.total(chosen)) * self.scaling
        return (covariances + np.swapaxes(covariances, 1, 2)) / 2.0

    def total(self, chosen: list[int]) -> Array:
        """Return the information (d, p, p) of a set."""
        total: Array = PRIOR * 1e-6 * np.eye(self.metric.shape[0]) + self.information[:, chosen].sum(axis=1)
        return total

    def allowed(self, others: list[int], slot: int) -> Mask:
        """Return which candidates (m,) may take a slot beside the others."""
        taken = np.zeros(self.size, bool)
        for i in others:
            if i not in self.near:
                self.near[i] = self._too_near(i)
            taken |= self.near[i]
        return ~taken & self.slots[slot] if slot < len(self.slots) else ~taken

    def _too_near(self, i: int) -> Mask:
        """Return which candidates (m,) are too near to the i-th, itself included."""
        # The mean distance is at least that of the means, which costs less and settles most.
        difference = self.middles - self.middles[i]
        close = np.flatnonzero(np.hypot(difference[:, 0], difference[:, 1]) < self.separation_px)
        near = np.zeros(self.size, bool)
        picked = np.append(close, i)
        near[picked] = corner_distances(self.image_points[picked], len(close)) < self.separation_px
        near[i] = True
        return near

    def values(self, total: Array, candidates: Indices) -> Array:
        """Return tr(W (total + Λ)⁻¹), mean over draws, for each candidate (c,); total: (d', p, p), d' ≤ d."""
        inverse = np.linalg.inv(total[:, None] + self.information[: len(total), candidates])
        values: Array = (inverse.reshape(len(total), len(candidates), -1) @ self.metric.ravel()).mean(axis=0)
        return values

    def slopes(self, total: Array) -> Floats:
        """Return by how much a little of each candidate (m,) would lower the value of a total (d, p, p)."""
        inverse = np.linalg.inv(total)
        gradients = (inverse @ self.metric @ inverse).reshape(len(total), -1, 1).astype(np.float32)
        slopes: Floats = (self.flat[: len(total)] @ gradients)[..., 0].mean(axis=0)
        return slopes


def _greedy(problem: _Problem, count: int, seen: Mask, begin: Sequence[int]) -> list[int] | None:
    """Return a set that adds the best candidate at each step, or None where no candidate is left to add.

    By the first draw alone: the exchange that follows judges by all of them.
    """
    chosen = list(begin)[:count]
    total = PRIOR * np.eye(problem.metric.shape[0]) + problem.information[:1, chosen].sum(axis=1)
    for slot in range(len(chosen), count):
        candidates = np.flatnonzero(problem.allowed(chosen, slot) & seen)
        if candidates.size == 0:
            return None
        if slot >= SURE_FROM:
            candidates = _steepest(candidates, problem.slopes(total))
        best = int(candidates[np.argmin(problem.values(total, candidates))])
        chosen.append(best)
        total = total + problem.information[:1, best]
    return chosen


def _exchange(problem: _Problem, chosen: list[int], progress: Progress) -> list[int]:
    """Return the set after exchanging one pose at a time until no exchange helps."""
    chosen = list(chosen)
    total = problem.total(chosen)
    value = float(np.mean(np.sum(np.linalg.inv(total) * problem.metric, axis=(1, 2))))
    for sweep in range(LARGEST_SWEEPS):
        before = value
        for slot in range(len(chosen)):
            value, total = _improve_slot(problem, chosen, slot, value, total)
            progress((sweep + (slot + 1) / len(chosen)) / LARGEST_SWEEPS)
        if value > before * (1.0 - SMALLEST_GAIN):
            break
    progress(1.0)
    return chosen


def _improve_slot(
    problem: _Problem, chosen: list[int], slot: int, value: float, total: Array
) -> tuple[float, Array]:
    """Put the best candidate into a slot of `chosen`; return the new value and the new total information."""
    # tr(W (T + Λj − Λi)⁻¹) is convex: it cannot fall below value − (gj − gi), so that only gj > gi can help.
    slope = problem.slopes(total)
    others = chosen[:slot] + chosen[slot + 1 :]
    candidates = np.flatnonzero(problem.allowed(others, slot) & (slope > slope[chosen[slot]]))
    if candidates.size == 0:
        return value, total
    candidates = _steepest(candidates, slope)
    without = total - problem.information[:, chosen[slot]]
    values = problem.values(without, candidates)
    best = int(np.argmin(values))
    if values[best] >= value * (1.0 - SMALLEST_GAIN):
        return value, total
    chosen[slot] = int(candidates[best])
    return float(values[best]), without + problem.information[:, chosen[slot]]


def _steepest(candidates: Indices, slope: Floats) -> Indices:
    """Return the candidates whose slope (m,) is largest, at most SHORTLIST of them."""
    if candidates.size <= SHORTLIST:
        return candidates
    return candidates[np.argpartition(slope[candidates], -SHORTLIST)[-SHORTLIST:]]


def _better(
    best: tuple[float, list[int]] | None, problem: _Problem, chosen: list[int]
) -> tuple[float, list[int]]:
    """Return the better one of a set found before and a new one."""
    value = problem.value(chosen)
    return (value, chosen) if best is None or value < best[0] * (1.0 - SMALLEST_GAIN) else best


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
