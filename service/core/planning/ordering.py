"""In which order the poses of a set are taken: first the easiest, then the shortest way for the hands.

The way is an open path whose cost is the time that hands need between two poses: solved exactly for small
sets, for larger ones by 2-opt and moves of short pieces from each likely second pose. Not here: which
poses.
"""

from typing import Final

import numpy as np

from service.core.planning.pose_space import Indices, Poses
from service.core.vision.target import Target
from service.core.vision.transforms import Array, angle_between

# A person who follows a ghost board, roughly: only the ratio of the two matters for the order.
HAND_SPEED_M_S: Final = 0.25
HAND_TURN_RAD_S: Final = np.deg2rad(60.0)

LARGEST_EXACT: Final = 12
PIECES: Final = (1, 2, 3)
SECONDS: Final = 10  # poses that are tried as the second one, the nearest
TINY_GAIN: Final = 1e-9


def order_poses(poses: Poses, target: Target) -> Indices:
    """Return the order (m,) in which to take m poses: the least turned one first, then the shortest path."""
    if len(poses) < 2:
        return np.arange(len(poses), dtype=np.int64)
    costs = hand_times(poses, target)
    first = int(np.argmin(poses.turns()))
    path = _exact_path(costs, first) if len(poses) <= LARGEST_EXACT else _good_path(costs, first)
    return np.array(path, dtype=np.int64)


def hand_times(poses: Poses, target: Target) -> Array:
    """Return the times (m, m), s, from pose to pose at a hand's speeds: the centre's way plus the turn."""
    centres = poses.centres(target)
    ways = np.linalg.norm(centres[:, None] - centres[None, :], axis=-1)
    turns = angle_between(poses.rotations[:, None], poses.rotations[None, :])
    times: Array = ways / HAND_SPEED_M_S + turns / HAND_TURN_RAD_S
    return times


def path_length(costs: Array, path: "list[int] | Indices") -> float:
    """Return the summed cost of an open path over costs (m, m)."""
    return float(costs[path[:-1], path[1:]].sum())


def _exact_path(costs: Array, first: int) -> list[int]:
    """Return the shortest open path from `first` (Held and Karp, 1962)."""
    rest = [i for i in range(len(costs)) if i != first]
    between = costs[np.ix_(rest, rest)]
    m = len(rest)
    # best[s, j]: the shortest way from the first pose through the set s of others, ending at its member j.
    best = np.full((1 << m, m), np.inf)
    previous = np.full((1 << m, m), -1)
    for j in range(m):
        best[1 << j, j] = costs[first, rest[j]]
    for visited in range(1, 1 << m):
        for j in range(m):
            if visited & (1 << j) and visited != 1 << j:
                ways = best[visited ^ (1 << j)] + between[:, j]
                previous[visited, j] = np.argmin(ways)
                best[visited, j] = ways[previous[visited, j]]
    return [first, *(rest[j] for j in _trace_back(best, previous))]


def _trace_back(best: Array, previous: Indices) -> list[int]:
    """Return the members in the order of the shortest way through all of them."""
    visited = len(best) - 1
    j = int(np.argmin(best[visited]))
    path = []
    while j >= 0:
        path.append(j)
        visited, j = visited ^ (1 << j), int(previous[visited, j])
    return path[::-1]


def _good_path(costs: Array, first: int) -> list[int]:
    """Return the best locally shortest path among those that begin with each possible second pose."""
    nearest = [int(i) for i in np.argsort(costs[first]) if i != first][:SECONDS]
    starts = (_nearest_path(costs, first, second) for second in nearest)
    # A last stop that costs nothing makes the open path look like any other.
    padded = np.pad(costs, (0, 1))
    paths = (_improve_path(padded, [*path, len(costs)])[:-1] for path in starts)
    return min(paths, key=lambda path: path_length(costs, path))


def _nearest_path(costs: Array, first: int, second: int) -> list[int]:
    """Return the path that goes on to the nearest pose not yet taken."""
    path = [first, second]
    left = sorted(set(range(len(costs))) - set(path))
    while left:
        path.append(min(left, key=lambda i: float(costs[path[-1], i])))
        left.remove(path[-1])
    return path


def _improve_path(costs: Array, path: list[int]) -> list[int]:
    """Return the path after the best reversal or move of a piece, again and again; both ends stay."""
    while True:
        along = costs[np.ix_(path, path)]
        changes = [_best_reversal(along), *(_best_move(along, length) for length in PIECES)]
        gain, order = max(changes, key=lambda change: change[0])
        if gain < TINY_GAIN:
            return path
        path = [path[i] for i in order]


def _best_reversal(along: Array) -> tuple[float, list[int]]:
    """Return the gain and the new order of the best piece to reverse (2-opt); along: costs in path order."""
    steps = np.diagonal(along, 1)
    gains = steps[:-1, None] + steps[None, 1:] - along[:-2, 1:-1] - along[1:-1, 2:]
    gains = np.where(np.triu(np.ones(gains.shape, bool), 1), gains, -np.inf)
    start, end = (int(k) + 1 for k in np.unravel_index(np.argmax(gains), gains.shape))
    order = list(range(len(along)))
    return float(gains[start - 1, end - 1]), order[:start] + order[start : end + 1][::-1] + order[end + 1 :]


def _best_move(along: Array, length: int) -> tuple[float, list[int]]:
    """Return the gain and the new order of the best piece of a length to put elsewhere (or-opt)."""
    order = list(range(len(along)))
    starts = np.arange(1, len(along) - length)
    if starts.size == 0:
        return -np.inf, order
    steps, after = np.diagonal(along, 1), np.arange(len(along) - 1)
    left = steps[starts - 1] + steps[starts + length - 1] - along[starts - 1, starts + length]
    paid = along[after[None, :], starts[:, None]] + along[starts[:, None] + length - 1, after[None, :] + 1]
    gains = left[:, None] - (paid - steps[None, :])
    own = (after >= starts[:, None] - 1) & (after < starts[:, None] + length)
    gains[own] = -np.inf
    row, behind = (int(k) for k in np.unravel_index(np.argmax(gains), gains.shape))
    start = int(starts[row])
    piece, rest = order[start : start + length], order[:start] + order[start + length :]
    place = rest.index(behind) + 1
    return float(gains[row, behind]), rest[:place] + piece + rest[place:]
