"""Where large residuals come from: a bent board, a lens that the model does not describe, or noise.

It chooses the words of an advice and decides nothing: a bent board and a wrong lens model both leave
residuals that repeat, the one with the board's corners, the other with the distance from the principal point.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from service.core.quality.evidence import Evidence
from service.core.vision.camera import project_with_jacobians
from service.core.vision.transforms import Array, stack_poses

RINGS = 12

Design = Callable[[int, Array], Array]
"""From a view's index and its derivatives by the camera-frame points (n, 2, 3) to columns (n, 2, k)."""


@dataclass(frozen=True)
class Causes:
    """Shares of the squared residuals, chance removed, that a bent board and another lens explain.

    bend_m: out-of-plane shape of the board that explains most, peak to peak, m.
    """

    board_share: float
    bend_m: float
    lens_share: float


def explain_residuals(evidence: Evidence) -> Causes:
    """Return what explains the residuals of a solve."""
    residuals = evidence.result.residuals
    total = sum(float((residual**2).sum()) for residual in residuals)
    count = sum(residual.size for residual in residuals)
    if total == 0.0:
        return Causes(0.0, 0.0, 0.0)
    heights, by_board = _fit(evidence, len(evidence.board), _by_height(evidence))
    _, by_lens = _fit(evidence, RINGS, _by_ring(evidence))
    return Causes(
        board_share=max(by_board / total - len(heights) / count, 0.0),
        bend_m=float(np.ptp(heights)),
        lens_share=max(by_lens / total - RINGS / count, 0.0),
    )


def _fit(evidence: Evidence, size: int, design: Design) -> tuple[Array, float]:
    """Return the coefficients (size,) that fit the residuals best, and the squares, px², that they explain.

    Linear least squares with each view's pose free: a pose takes over what looks like a tilt of the board.
    """
    result = evidence.result
    rotations, translations = stack_poses(result.poses)
    normal, right = np.zeros((size, size)), np.zeros(size)
    for i, view in enumerate(evidence.views):
        board = evidence.board[view.detection.corner_ids]
        _, _, by_pose = project_with_jacobians(
            result.intrinsics.lens,
            result.intrinsics.vector,
            rotations[i : i + 1],
            translations[i : i + 1],
            board,
        )
        basis, _ = np.linalg.qr(by_pose[0].reshape(-1, 6))
        columns = design(i, by_pose[0, :, :, 3:]).reshape(-1, size)
        free = columns - basis @ (basis.T @ columns)
        normal += free.T @ free
        right += free.T @ result.residuals[i].ravel()
    found = np.asarray(np.linalg.lstsq(normal, right, rcond=1e-9)[0], dtype=np.float64)
    return found, float(found @ right)


def _by_height(evidence: Evidence) -> Design:
    """Return the design of a bent board: one height per corner, m."""
    rotations, _ = stack_poses(evidence.result.poses)

    def design(i: int, by_point: Array) -> Array:
        ids = evidence.views[i].detection.corner_ids
        columns = np.zeros((len(ids), 2, len(evidence.board)))
        columns[np.arange(len(ids)), :, ids] = by_point @ rotations[i, :, 2]
        return columns

    return design


def _by_ring(evidence: Evidence) -> Design:
    """Return the design of another lens: a radial shift, px, piecewise linear in the radius."""
    centre = evidence.result.intrinsics.camera_matrix[:2, 2]
    offsets = [view.detection.image_points - centre for view in evidence.views]
    radii = [np.linalg.norm(offset, axis=1, keepdims=True) for offset in offsets]
    spacing = max(float(radius.max()) for radius in radii) / (RINGS - 1)

    def design(i: int, by_point: Array) -> Array:
        shares = np.maximum(1.0 - np.abs(radii[i] / spacing - np.arange(RINGS)), 0.0)
        direction = offsets[i] / np.maximum(radii[i], 1e-9)
        columns: Array = direction[:, :, None] * shares[:, None, :]
        return columns.reshape(len(by_point), 2, RINGS)

    return design
