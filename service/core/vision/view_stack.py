"""Views as arrays: detections of unequal length padded to one shape, so that no solve loops over views.

Padding repeats the first corner of a view with weight zero. The weights are also where a robust loss belongs.
Not here: solving.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from service.core.errors import DegenerateViews, TooFewViews
from service.core.vision.transforms import Array

VIEWS_NEEDED = 3
CORNERS_NEEDED = 6


@dataclass(frozen=True)
class View:
    """One detection used by a solve: object_points (n, 3) m at z = 0, image_points (n, 2) px, same order."""

    object_points: Array
    image_points: Array
    name: str = ""


@dataclass(frozen=True)
class ViewStack:
    """Padded views: object_points (v, n, 3) m, image_points (v, n, 2) px, weights (v, n), counts (v,)."""

    object_points: Array
    image_points: Array
    weights: Array
    counts: tuple[int, ...]

    @property
    def measurements(self) -> int:
        """Number of scalar measurements: two for each corner."""
        return 2 * sum(self.counts)

    @property
    def is_weighted(self) -> bool:
        """Whether any corner counts for other than one."""
        return bool(np.any(self.weights != 1.0))

    def thinned(self, corners: int) -> "ViewStack":
        """Return the same views with at most about `corners` corners each, spread over the detection."""
        keep = np.unique(np.linspace(0, self.weights.shape[1] - 1, corners).astype(np.int64))
        weights = self.weights[:, keep]
        counts = tuple(int(n) for n in np.count_nonzero(weights, axis=1))
        if min(counts) < CORNERS_NEEDED:
            return self
        return ViewStack(self.object_points[:, keep], self.image_points[:, keep], weights, counts)


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
        check_view(view, view.name or f"number {number}")
    counts = tuple(len(view.image_points) for view in views)
    index = np.array([[i if i < n else 0 for i in range(max(counts))] for n in counts])
    return ViewStack(
        np.stack([np.asarray(view.object_points, float)[i] for view, i in zip(views, index, strict=True)]),
        np.stack([np.asarray(view.image_points, float)[i] for view, i in zip(views, index, strict=True)]),
        (np.arange(max(counts)) < np.array(counts)[:, None]).astype(np.float64),
        counts,
    )


def check_view(view: View, name: str) -> View:
    """Return the view, or raise DegenerateViews saying what makes it unusable."""
    board, image = np.asarray(view.object_points), np.asarray(view.image_points)
    if board.shape != (len(image), 3) or image.shape != (len(board), 2):
        problem = f"has {board.shape} object points for {image.shape} image points; give (n, 3) and (n, 2)"
    elif len(board) < CORNERS_NEEDED:
        problem = f"has {len(board)} corners; give at least {CORNERS_NEEDED}"
    elif not (np.all(np.isfinite(board)) and np.all(np.isfinite(image))):
        problem = "has a corner that is not a finite number; detect it again"
    elif np.any(board[:, 2] != 0.0):
        problem = "has object points off the plane z = 0; only flat targets are calibrated"
    elif _is_on_a_line(board[:, :2]) or _is_on_a_line(image):
        problem = "has all its corners on one line; show the target less edge-on"
    else:
        return view
    raise DegenerateViews(f"View {name} {problem}.", view=name)


def _is_on_a_line(points: Array) -> bool:
    """Whether points (n, 2) spread along one direction only."""
    spread = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    return bool(spread[1] <= 1e-6 * spread[0])
