"""Views as arrays: detections of unequal length padded to one shape, so that no solve loops over views.

Padding repeats the first corner of a view with weight zero. The weights are also where a robust loss belongs.
Not here: solving.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.errors import DegenerateViews, TooFewViews
from service.core.vision.transforms import Array

VIEWS_NEEDED = 3
CORNERS_NEEDED = 6
LARGEST_BEND = 0.05  # of the target's size; starts take it for flat


@dataclass(frozen=True)
class View:
    """One detection used by a solve: object_points (n, 3) m near z = 0, image_points (n, 2) px in order."""

    object_points: Array
    image_points: Array
    name: str = ""


@dataclass(frozen=True)
class ViewStack:
    """Padded views: object_points (v, n, 3) m, image_points (v, n, 2) px, weights (v, n), counts (v,).

    visible_points (v, m, 3) m: those by which to tell whether a camera shows them all, thinned or not.
    """

    object_points: Array
    image_points: Array
    weights: Array
    counts: tuple[int, ...]
    visible_points: Array

    @property
    def measurements(self) -> int:
        """Number of scalar measurements: two for each corner."""
        return 2 * sum(self.counts)

    @cached_property
    def is_weighted(self) -> bool:
        """Whether any corner counts for other than one."""
        return bool(np.any(self.weights != 1.0))

    @cached_property
    def normalised(self) -> tuple[Array, Array, Array]:
        """The boards' centres (v, 2) m, sizes (v,) m, and corners (v, n, 2) in those terms."""
        plane = self.object_points[..., :2]
        centre = plane.mean(axis=1)
        corners = plane - centre[:, None]
        size = np.sqrt(np.einsum("vni,vni->v", corners, corners) / corners.shape[1])
        return centre, size, corners / size[:, None, None]

    def thinned(self, corners: int) -> "ViewStack":
        """Return the same views with at most about `corners` corners each, spread over the detection."""
        longest = self.weights.shape[1]
        keep = np.linspace(0, longest - 1, min(corners, longest)).astype(np.int64)
        weights = self.weights[:, keep]
        counts = tuple(int(n) for n in np.count_nonzero(weights, axis=1))
        if min(counts) < CORNERS_NEEDED:
            return self
        return replace(
            self,
            object_points=self.object_points[:, keep],
            image_points=self.image_points[:, keep],
            weights=weights,
            counts=counts,
        )


def stack_views(views: Sequence[View]) -> ViewStack:
    """Return the padded arrays of views.

    Raises TooFewViews for fewer than three views, DegenerateViews for a view whose corners are too few, not
    finite, on one line, not on the plane z = 0, or without a counterpart.
    """
    if len(views) < VIEWS_NEEDED:
        raise TooFewViews(
            f"A calibration needs at least {VIEWS_NEEDED} usable views and {len(views)} were found; "
            "take more images in which the whole target is visible, from different sides.",
            views_found=len(views),
            views_needed=VIEWS_NEEDED,
        )
    for number, view in enumerate(views):
        _check_shapes(view, _name(view, number))
    counts = tuple(len(view.image_points) for view in views)
    weights = (np.arange(max(counts)) < np.array(counts)[:, None]).astype(np.float64)
    board = np.stack([_padded(view.object_points, max(counts)) for view in views])
    image = np.stack([_padded(view.image_points, max(counts)) for view in views])
    stack = ViewStack(board, image, weights, counts, visible_points=_outline(board))
    _check_values(stack, [_name(view, number) for number, view in enumerate(views)])
    return stack


def _outline(board: Array) -> Array:
    """Return the points (v, m, 3) of boards (v, n, 3) that may be the farthest from a camera's axis.

    Of a flat board before the camera one on its outline is; of bent ones and parts of boards all are taken.
    """
    if board[..., 2].any() or not (board == board[0]).all():
        return board
    outline = cv2.convexHull(board[0, :, :2].astype(np.float32), returnPoints=False)
    return board[:, outline[:, 0]]


def _name(view: View, number: int) -> str:
    return view.name or f"number {number}"


def _padded(points: Array, count: int) -> Array:
    """Return points (n, d) with the first repeated to `count` of them."""
    points = np.asarray(points, dtype=np.float64)
    missing = count - len(points)
    return np.concatenate([points, np.repeat(points[:1], missing, axis=0)]) if missing else points


def _check_shapes(view: View, name: str) -> None:
    """Raise DegenerateViews where a view's arrays do not belong together or are too short."""
    board, image = np.shape(view.object_points), np.shape(view.image_points)
    if board != (image[0], 3) or image != (board[0], 2):
        raise DegenerateViews(
            f"View {name} has {board} object points for {image} image points; give (n, 3) and (n, 2).",
            view=name,
        )
    if image[0] < CORNERS_NEEDED:
        raise DegenerateViews(
            f"View {name} has {image[0]} corners; a view needs at least {CORNERS_NEEDED}.", view=name
        )


def _check_values(stack: ViewStack, names: Sequence[str]) -> None:
    """Raise DegenerateViews naming the first view whose points are not finite, not flat or on one line."""
    board, image = stack.object_points, stack.image_points
    looks: dict[str, Callable[[], NDArray[np.bool_]]] = {
        "has a corner that is not a finite number; detect it again": lambda: (
            _not_finite(board) | _not_finite(image)
        ),
        "has object points off the plane z = 0; only nearly flat targets are calibrated": lambda: _bent(
            board
        ),
        "has all its corners on one line; show the target less edge-on": lambda: np.any(
            _on_a_line(np.stack([board[..., :2], image])), axis=0
        ),
    }
    for problem, look in looks.items():
        views = look()
        if np.any(views):
            name = names[int(np.argmax(views))]
            raise DegenerateViews(f"View {name} {problem}.", view=name)


def _not_finite(points: Array) -> NDArray[np.bool_]:
    """Whether a point (v, n, d) of each view is not finite."""
    # A sum over all of them is finite where they all are, and not much slower than one of them.
    if np.isfinite(points.sum()):
        return np.zeros(len(points), dtype=np.bool_)
    return np.asarray(~np.isfinite(points).all(axis=(1, 2)))


def _bent(board: Array) -> NDArray[np.bool_]:
    """Whether points (v, n, 3) of each view are far from the plane z = 0."""
    if not board[..., 2].any():
        return np.zeros(len(board), dtype=np.bool_)
    size = np.ptp(board[..., :2], axis=1).max(axis=1)
    return np.asarray(np.abs(board[..., 2]).max(axis=1) > LARGEST_BEND * size)


def _on_a_line(points: Array) -> NDArray[np.bool_]:
    """Whether points (..., n, 2) spread along one direction only: (...)."""
    x, y = np.array(points[..., 0]), np.array(points[..., 1])
    x -= x.mean(axis=-1, keepdims=True)
    y -= y.mean(axis=-1, keepdims=True)
    xx, yy, xy = (np.einsum("...n,...n->...", a, b) for a, b in ((x, x), (y, y), (x, y)))
    return np.asarray(xx * yy - xy * xy <= 1e-12 * (xx + yy) ** 2)
