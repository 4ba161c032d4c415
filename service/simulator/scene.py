"""What the virtual camera looks at, and the physics of its picture. Not here: how the picture is drawn."""

from dataclasses import dataclass

import numpy as np

from service.core.errors import SceneInvalid
from service.core.vision.camera import Intrinsics, project_camera_points, reach_share
from service.core.vision.target import Target
from service.core.vision.transforms import Array, Pose


@dataclass(frozen=True)
class Scene:
    """A target before a camera whose true intrinsics are known.

    white_grey, dark_grey: levels of the squares at the exposure; the plate is as white as the light squares.
    border_squares: width of the plate's white border around the squares, in squares.
    clutter: contrast of the background, 0 (even grey) to 1; seed: which background.
    falloff: share of light lost at the image corner farthest from light_centre (x, y, shares of the image).
    shading: 0 for even light on the board, 1 for a small lamp beside the lens (light_m, m, camera frame),
    whose light falls with distance and slant; exposure follows the board's centre.
    blur_px: sigma of the Gaussian point spread, beside the pixel's own area, which is always there.
    noise_grey: sd of the noise at level 128, of which shot_share of the variance grows with the level.
    Raises SceneInvalid for values that no picture can have.
    """

    intrinsics: Intrinsics
    target: Target
    white_grey: float = 200.0
    dark_grey: float = 35.0
    border_squares: float = 0.6
    clutter: float = 1.0
    falloff: float = 0.0
    light_centre: tuple[float, float] = (0.5, 0.5)
    shading: float = 0.0
    light_m: tuple[float, float, float] = (0.03, 0.0, 0.0)
    blur_px: float = 0.0
    noise_grey: float = 0.0
    shot_share: float = 0.6
    exposure: float = 1.0
    seed: int = 0

    def __post_init__(self) -> None:
        bounds = {
            "white_grey": (0.0, 1e4),
            "dark_grey": (0.0, self.white_grey),
            "border_squares": (0.0, 10.0),
            "clutter": (0.0, 1.0),
            "falloff": (0.0, 0.95),
            "shading": (0.0, 1.0),
            "blur_px": (0.0, 20.0),
            "noise_grey": (0.0, 64.0),
            "shot_share": (0.0, 1.0),
            "exposure": (0.01, 100.0),
        }
        for name, (low, high) in bounds.items():
            value = getattr(self, name)
            if not low <= value <= high:  # also refuses NaN
                raise SceneInvalid(
                    f"{name} is {value:g}; choose a value from {low:g} to {high:g}.", name=name
                )
        if self.seed < 0:
            raise SceneInvalid("seed must not be negative.", name="seed")


def clean_scene(intrinsics: Intrinsics, target: Target, seed: int = 0) -> Scene:
    """Return a scene without noise, without blur beyond the pixel's area, under even light."""
    return Scene(intrinsics, target, seed=seed)


def production_scene(intrinsics: Intrinsics, target: Target, seed: int = 0) -> Scene:
    """Return a scene as a line sees it: near-infrared lamp, a lens's blur, a sensor's noise."""
    return Scene(
        intrinsics, target, falloff=0.35, shading=0.4, blur_px=0.7, noise_grey=2.0, exposure=1.05, seed=seed
    )


def true_corners(scene: Scene, pose: Pose) -> Array:
    """Return where the target's corners lie in the picture (n, 2), px; NaN where the lens shows none."""
    return project_points(scene, pose, scene.target.object_points)


def project_points(scene: Scene, pose: Pose, object_points: Array) -> Array:
    """Return where board points (n, 3), m, lie in the picture (n, 2), px; NaN where the lens shows none."""
    points = object_points @ pose.rotation.T + pose.tvec
    # Beyond its reach a lens model would fold a point back into the picture.
    seen = reach_share(scene.intrinsics, points)[:, None] < 1.0
    return np.where(seen, project_camera_points(scene.intrinsics, points), np.nan)
