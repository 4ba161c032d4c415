"""What a lens model is to the rest of the house: directions in, places in the image of focal length one out.

A direction is a point of the camera frame, of any length: so a model may look sideways and behind, where the
plane z = 1 ends. Here: the interface and nothing else. Models are `lens_*.py`, their registry is in `camera`.
"""

from typing import Protocol

from service.core.vision.transforms import Array


class Lens(Protocol):
    """A lens model; k are its coefficients, (c,) or broadcastable (..., c) where an Array of points is given.

    Image coordinates are those of focal length one about the principal point: (u − cx)/fx, (v − cy)/fy.
    """

    @property
    def name(self) -> str:
        """What users call the model."""
        ...

    @property
    def coefficients(self) -> tuple[str, ...]:
        """Names of the coefficients in OpenCV's order; all zero is a lens without distortion of its own."""
        ...

    @property
    def weak(self) -> tuple[str, ...]:
        """Coefficients that only many corners determine: the way from a start leaves them as they are."""
        ...

    @property
    def sweep_hfov_deg(self) -> tuple[float, ...]:
        """Horizontal fields of view, narrow to wide, from which to look for a camera nobody knows."""
        ...

    def project(self, points: Array, k: Array) -> Array:
        """Return image coordinates (..., 2) of points (..., 3); NaN where the model has none."""
        ...

    def project_with_jacobians(self, points: Array, k: Array) -> tuple[Array, Array, Array]:
        """Return image coordinates (..., 2) and their derivatives, components first.

        By the points (2, 3, ...) and by the coefficients (2, c, ...). The points must have an image.
        """
        ...

    def unproject(self, image: Array, k: Array) -> Array:
        """Return directions (..., 3) of image coordinates (..., 2), k (c,); NaN beyond the reach."""
        ...

    def radius(self, points: Array) -> Array:
        """Return how far from the axis points (..., 3) are, in the model's own measure; inf without image."""
        ...

    def reach(self, k: Array) -> float:
        """Return the radius up to which the image radius grows; beyond it two directions share a pixel."""
        ...

    def reaches(self, k: Array, radius: float) -> bool:
        """Whether a finite radius is below the reach, which is told sooner than the reach itself."""
        ...

    def like_division(self, coefficient: float) -> Array:
        """Return coefficients (c,) of a lens roughly like the division model, zero where none is like it.

        There a distorted radius m belongs to the ideal radius m/(1 + coefficient m²) (Fitzgibbon 2001).
        """
        ...
