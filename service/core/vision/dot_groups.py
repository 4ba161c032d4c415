"""Groups of dots that are each other's next ones, all at once: where a grid may be, before any is grown.

Says in a fraction of a millisecond that a perforated plate is one, however many holes it has.
Not here: places on a lattice (`dot_lattice`).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import connected_components

from service.core.vision.dot_lattice import OFF_SHARE, Dots


@dataclass(frozen=True)
class Group:
    """How many dots hang together, and one inside: it has a next one both ways and back."""

    size: int
    seed: int


def group_dots(dots: Dots) -> list[Group]:
    """Return the groups that have a dot inside, the largest first."""
    if dots.nearest.shape[1] == 0:
        return []
    length = np.linalg.norm(dots.ways, axis=-1)[..., None]
    ahead = np.linalg.norm(dots.to[:, None] - dots.ways[:, :, None], axis=-1) <= OFF_SHARE * length
    back = np.linalg.norm(dots.to[:, None] + dots.ways[:, :, None], axis=-1) <= OFF_SHARE * length
    names = _name_groups(dots, (ahead | back).any(axis=1))
    inside = np.flatnonzero(back.any(axis=-1).all(axis=-1))
    sizes = np.bincount(names)
    groups = []
    for name in np.unique(names[inside]):
        own = inside[names[inside] == name]
        groups.append(Group(int(sizes[name]), int(own[len(own) // 2])))
    return sorted(groups, key=lambda group: group.size, reverse=True)


def _name_groups(dots: Dots, linked: NDArray[np.bool_]) -> NDArray[np.int32]:
    """Return the number of each dot's group (n,), by which of its nearest (n, k) are its next ones.

    Two belong together where each is the other's next: a stray dot beside a grid finds one of its dots, but
    is not found by it.
    """
    count = len(dots.points)
    one, slot = np.nonzero(linked)
    other = dots.nearest[one, slot]
    is_next = np.zeros((count, count), dtype=bool)
    is_next[one, other] = True
    mutual = is_next[other, one]
    links = csr_matrix((mutual[mutual], (one[mutual], other[mutual])), shape=(count, count))
    return np.asarray(connected_components(links, directed=False)[1])
