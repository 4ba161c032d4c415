"""Where large residuals come from: a bent board, a lens that the model does not describe, or noise.

It chooses the words of an advice and decides nothing: a bent board and a wrong lens model both leave
residuals that repeat, the one with the corner of the board, the other with the place in the image.
"""

from dataclasses import dataclass

import numpy as np

from service.core.quality.evidence import Evidence
from service.core.vision.camera import project_with_jacobians
from service.core.vision.transforms import Array, stack_poses


@dataclass(frozen=True)
class Causes:
    """Shares of the squared residuals, chance removed, that a bent board and the place in the image explain.

    bend_m: out-of-plane shape of the board that explains most, peak to peak, m.
    """

    board_share: float
    bend_m: float
    lens_share: float


def explain_residuals(evidence: Evidence) -> Causes:
    """Return what explains the residuals of a solve."""
    total = sum(float((residual**2).sum()) for residual in evidence.result.residuals)
    count = sum(residual.size for residual in evidence.result.residuals)
    if total == 0.0:
        return Causes(0.0, 0.0, 0.0)
    shape, by_board = _bend(evidence)
    board_share = by_board / total - np.count_nonzero(shape) / count
    lens_share = _explained_by_place(evidence) / total - 20.0 / count
    return Causes(max(float(board_share), 0.0), float(np.ptp(shape)), max(float(lens_share), 0.0))


def _bend(evidence: Evidence) -> tuple[Array, float]:
    """Return heights (n,), m, of the board's corners that fit best, and the squares they explain, px².

    Linear least squares with each view's pose free, since a pose takes over what looks like a tilt of the
    board.
    """
    result, board = evidence.result, evidence.target.object_points
    rotations, translations = stack_poses(result.poses)
    n = len(board)
    normal, right = np.zeros((n, n)), np.zeros(n)
    for i, view in enumerate(evidence.views):
        ids = view.detection.corner_ids
        _, _, by_pose = project_with_jacobians(
            result.intrinsics.lens,
            result.intrinsics.vector,
            rotations[i : i + 1],
            translations[i : i + 1],
            board[ids],
        )
        by_height = by_pose[0, :, :, 3:] @ rotations[i, :, 2]
        D = np.zeros((len(ids), 2, n))
        D[np.arange(len(ids)), :, ids] = by_height
        basis, _ = np.linalg.qr(by_pose[0].reshape(-1, 6))
        free = D.reshape(-1, n)
        free = free - basis @ (basis.T @ free)
        normal += free.T @ free
        right += free.T @ result.residuals[i].ravel()
    heights = np.asarray(np.linalg.lstsq(normal, right, rcond=1e-9)[0], dtype=np.float64)
    return heights, float(heights @ right)


def _explained_by_place(evidence: Evidence) -> float:
    """Return the squares, px², that a cubic polynomial of the place in the image explains."""
    points = np.concatenate([view.detection.image_points for view in evidence.views])
    residuals = np.concatenate(evidence.result.residuals)
    u, v = ((points - points.mean(axis=0)) / points.std(axis=0)).T
    terms = np.stack([u**i * v**j for i in range(4) for j in range(4 - i)], axis=1)
    basis, _ = np.linalg.qr(terms)
    return float(((basis.T @ residuals) ** 2).sum())
