"""The camera: intrinsics, projection with analytic Jacobians, and its inverse.

A lens model is one file (`lens_*.py`) and one line in `LENSES`. Not here: how intrinsics are estimated.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.errors import IntrinsicsInvalid
from service.core.vision import lens_kannala_brandt4, lens_pinhole5, lens_rational8
from service.core.vision.lens import Lens
from service.core.vision.transforms import Array, turn_points

LENSES: Mapping[str, Lens] = {
    module.LENS.name: module.LENS for module in (lens_pinhole5, lens_rational8, lens_kannala_brandt4)
}
LARGEST = float(np.finfo(np.float64).max)
PINHOLE = ("fx", "fy", "cx", "cy")


@dataclass(frozen=True)
class Intrinsics:
    """Lens, camera_matrix (3, 3) px, dist_coeffs (c,) in the lens's order, image_size (width, height) px."""

    lens: str
    camera_matrix: Array
    dist_coeffs: Array
    image_size: tuple[int, int]

    @property
    def vector(self) -> Array:
        """Parameters (4 + c,): fx fy cx cy, then the lens's coefficients in its order."""
        K = self.camera_matrix
        return np.concatenate([[K[0, 0], K[1, 1], K[0, 2], K[1, 2]], self.dist_coeffs])

    @property
    def parameters(self) -> dict[str, float]:
        """Parameters by name, in the order of `vector`."""
        return dict(zip(parameter_names(self.lens), map(float, self.vector), strict=True))

    @classmethod
    def from_vector(cls, lens: str, vector: Array, image_size: tuple[int, int]) -> "Intrinsics":
        """Return the intrinsics of a parameter vector (4 + c,)."""
        fx, fy, cx, cy = (float(v) for v in vector[:4])
        K = np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])
        return cls(lens, K, np.array(vector[4:], dtype=np.float64), image_size)

    @classmethod
    def from_parameters(
        cls, lens: str, parameters: Mapping[str, float], image_size: tuple[int, int]
    ) -> "Intrinsics":
        """Return checked intrinsics of named parameters; coefficients that are not named are zero.

        Raises IntrinsicsInvalid for an unknown lens or name, a missing or impossible value.
        """
        names = parameter_names(lens)
        unknown = sorted(set(parameters) - set(names))
        missing = [name for name in PINHOLE if name not in parameters]
        if unknown or missing:
            raise IntrinsicsInvalid(
                f"Give {', '.join(PINHOLE)} and any of {', '.join(names[4:])}; "
                f"unknown: {', '.join(unknown) or 'none'}, missing: {', '.join(missing) or 'none'}."
            )
        vector = np.array([float(parameters.get(name, 0.0)) for name in names])
        if not np.all(np.isfinite(vector)) or min(vector[0], vector[1]) <= 0 or min(image_size) < 16:
            raise IntrinsicsInvalid(
                "Values must be finite, fx and fy positive, the image at least 16 px wide and high."
            )
        return cls.from_vector(lens, vector, image_size)


def parameter_names(lens: str) -> tuple[str, ...]:
    """Return the names of a lens's parameters, fx fy cx cy first; IntrinsicsInvalid for an unknown lens."""
    if lens not in LENSES:
        raise IntrinsicsInvalid(f"Lens '{lens}' is not known; choose one of: {', '.join(LENSES)}.", lens=lens)
    return PINHOLE + LENSES[lens].coefficients


def focal_of_view(lens: str, size_px: int, view_deg: float) -> float:
    """Return the focal length, px, at which a lens without distortion has a field of view across an image.

    Raises IntrinsicsInvalid for an unknown lens and for an angle that such a lens cannot have.
    """
    nothing = np.zeros(len(parameter_names(lens)) - len(PINHOLE))
    model, half = LENSES[lens], np.radians(view_deg) / 2.0
    border = np.array([np.sin(half), 0.0, np.cos(half)])
    widest = 359.0 if np.isfinite(model.radius(np.array([0.0, 0.0, -1.0]))) else 179.0
    if not 0.0 < view_deg < widest:
        raise IntrinsicsInvalid(
            f"A field of view of {view_deg:g} degrees is impossible for lens '{lens}'; give one between 0 "
            f"and {widest:g}, or choose a fisheye lens.",
            view_deg=view_deg,
        )
    return float(0.5 * size_px / model.project(border, nothing)[0])


def project_camera_points(intrinsics: Intrinsics, points: Array) -> Array:
    """Return pixels (..., 2) of camera-frame points (..., 3), m; NaN where the lens has no image of them."""
    vector = intrinsics.vector
    pixels: Array = LENSES[intrinsics.lens].project(points, vector[4:]) * vector[:2] + vector[2:4]
    return pixels


def project(intrinsics: Intrinsics, rotation: Array, translation: Array, object_points: Array) -> Array:
    """Return image points (..., n, 2) px of board points (n, 3) or (..., n, 3) m.

    rotation: (..., 3, 3); translation: (..., 3) m. NaN for points of which the lens has no image.
    """
    points = turn_points(rotation, object_points) + translation[..., None, :]
    return project_camera_points(intrinsics, points)


def project_with_jacobians(
    lens: str, vector: Array, rotation: Array, translation: Array, object_points: Array
) -> tuple[Array, Array, Array]:
    """Return projections and their derivatives, vectorised over leading dimensions.

    lens: model name; vector: (p,) or (..., p) parameters; rotation: (..., 3, 3); translation: (..., 3) m;
    object_points: (n, 3) or (..., n, 3) m. Leading dimensions are broadcast.
    Returns image points (..., n, 2) px, derivatives by the parameters (..., n, 2, p), and by the pose
    (..., n, 2, 6): a left increment exp(ω) R in rad first, then the translation in m. In memory the
    components come first.
    """
    if vector.ndim > 1:
        missing = (1,) * (rotation.ndim - 1 - vector.ndim)
        vector = vector.reshape(*missing, *vector.shape[:-1], 1, vector.shape[-1])
    turned = turn_points(rotation, object_points)
    shape = turned.shape[:-1]
    first = np.empty((3, *shape))
    last = (*range(1, first.ndim), 0)
    points = np.add(turned, translation[..., None, :], out=first.transpose(last))
    image, by_point, by_k = LENSES[lens].project_with_jacobians(points, vector[..., 4:])
    fx, fy = vector[..., 0], vector[..., 1]
    by_parameters = np.zeros((2, vector.shape[-1], *shape))
    by_parameters[0, 0], by_parameters[1, 1] = image[..., 0], image[..., 1]
    by_parameters[0, 2] = by_parameters[1, 3] = 1.0
    by_pose = np.empty((2, 6, *shape))
    for i, focal in enumerate((fx, fy)):
        np.multiply(by_k[i], focal, out=by_parameters[i, 4:])
        np.multiply(by_point[i], focal, out=by_pose[i, 3:])
    _by_rotation(turned, by_pose)
    pixels = np.empty((2, *shape))
    pixels[0], pixels[1] = image[..., 0] * fx + vector[..., 2], image[..., 1] * fy + vector[..., 3]
    components_last = (*range(2, 2 + len(shape)), 0, 1)
    return (
        pixels.transpose(last),
        by_parameters.transpose(components_last),
        by_pose.transpose(components_last),
    )


def _by_rotation(turned: Array, by_pose: Array) -> None:
    """Write derivatives (2, 6, ...) by a rotation ω of turned points (..., 3) before those by a translation.

    With g the latter: g · (ω × t) = ω · (t × g).
    """
    t = [np.array(turned[..., i]) for i in range(3)]
    for of in by_pose:
        g = of[3:]
        for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
            np.multiply(t[j], g[k], out=of[i, ...])
            of[i] -= t[k] * g[j]


def unproject(intrinsics: Intrinsics, image_points: Array) -> Array:
    """Return directions (..., 3) in the camera frame of pixels (..., 2): the inverse of the projection.

    Their length is the lens model's choice: one, or such that z is one. NaN where the lens does not reach.
    """
    vector = intrinsics.vector
    image = (np.asarray(image_points, dtype=np.float64) - vector[2:4]) / vector[:2]
    return LENSES[intrinsics.lens].unproject(image, vector[4:])


def reach_share(intrinsics: Intrinsics, points: Array) -> Array:
    """Return how far out camera-frame points (..., 3) are, as a share (...) of the reach of the lens.

    From one on, and inf without image, two directions share a pixel: the model says nothing there.
    """
    lens = LENSES[intrinsics.lens]
    # A point without image must have an infinite share of an infinite reach, too.
    share: Array = lens.radius(points) / min(lens.reach(intrinsics.vector[4:]), LARGEST)
    return share


def are_reached(intrinsics: Intrinsics, points: Array) -> NDArray[np.bool_]:
    """Whether camera-frame points (..., 3) are before the reach of the lens: (...)."""
    lens, k = LENSES[intrinsics.lens], intrinsics.vector[4:]
    radius = lens.radius(points)
    farthest = float(radius.max(initial=0.0))
    # Mostly all are, which takes less to tell than where the reach is.
    if farthest < np.inf and lens.reaches(k, farthest):
        return np.ones(radius.shape, dtype=np.bool_)
    return np.asarray(radius < min(lens.reach(k), LARGEST))
