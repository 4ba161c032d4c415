"""A person without calibration experience: how their hand moves, and which poses they think of by themselves.

A novice has one hand (`Habits`): the same pace, reaction and tremor whether a screen guides it (`Hand`) or
not (`FreeHand`). Only what the hand aims at differs. Here: how novices differ from each other, the poses that
a novice chooses alone, and the hand that takes them there. Not here: which software looks at the pictures.

What novices do wrong, and where it is known from:

- *They do not know how far to turn and how near to come.* Ren and Hu's participants asked just that, after
  they had read printed instructions and seen the sample pictures of OpenCV's tutorial. In those pictures
  (13 `left*.jpg`, solved with this project's detector) the board is turned away by 26° on average, spans
  42–54 % of the image's width, and its centre scatters by 16 % and 9 % of the image's half width and half
  height; all corners together reach over 46 % of the image. Two more sets taken by hand (Udacity's, BoofCV's
  sony) give 37° and 25°, 24 % and 39 %, scatters of 41 % and 20 %, hulls of 70 % and 36 %. A novice here
  reaches at best the turn of OpenCV's samples, and scatters over the ranges that those sets span.
- *Boards flat before the lens, in the middle, far away:* opencv issue 21132 ("same viewpoints",
  "fronto parallel"), innate-os pull request 825 ("all too much alike", "held flat in the middle", "at a bad
  distance"), answers.opencv.org 7588 ("taking up as much of the camera view as possible" as what people are
  told after they failed).
- *The same view again:* PhotonVision issue 1515 ("a small number of similar images"), image_pipeline issue
  325 (a user covers the board with a hand to keep the tool from taking it again).
- *A board in motion:* OpenCV's live tool takes a view whenever its delay is over (`-d`, "a minimum delay in
  ms between subsequent attempts") and a board is found; nothing asks whether it is still. So the time
  between arriving at a pose and the picture is random here, down to none.
- *Tremor:* a braced instrument trembles by 0.17–0.25 mm rms across and 0.015 mm along (PMC3032442, figure 4);
  a board held free in two hands trembles more.

The distributions below are guesses within these sources, made before their first use; no figure of the
experiments was looked at to choose them.
"""

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from service.core.vision.camera import Intrinsics, unproject
from service.core.vision.feature_grid import extent
from service.core.vision.target import Target
from service.core.vision.transforms import Array, Pose, rotation_matrix, rotation_vector
from service.simulator.operator import Habits, Hand
from service.simulator.scene import clean_scene, project_points

NEAREST_M: Final = 0.15
FARTHEST_M: Final = 1.2  # beyond, nobody holds a board and reaches the keys
MOST_TILT_RAD: Final = float(np.deg2rad(60.0))
RETRIES: Final = 200
ARRIVED_M: Final = 0.01
ARRIVED_RAD: Final = float(np.deg2rad(4.0))
HOMING_S: Final = 0.2  # as `Hand` goes home


@dataclass(frozen=True)
class Style:
    """Which poses a novice thinks of.

    tilt_rad: sd of the turns about the image's x and y axes; roll_rad: of the roll. width_share: the board's
    width when it faces the camera, in image widths; width_spread: its relative sd from view to view.
    offset: where the board is on average, x and y in half image sizes; spread: the sd about that.
    repeats: share of views that are nearly the last one again; repeat_change: how much of a fresh choice such
    a view takes. longest_pause_s: the picture is taken between none and so long after the board arrived.
    """

    tilt_rad: float
    roll_rad: float
    width_share: float
    width_spread: float
    offset: tuple[float, float]
    spread: tuple[float, float]
    repeats: float
    repeat_change: float = 0.2
    longest_pause_s: float = 1.0


@dataclass(frozen=True)
class Novice:
    """A person: a hand, and a style where nobody guides it."""

    habits: Habits
    style: Style


@dataclass(frozen=True)
class Choice:
    """A view as thought of: place (2,) in half image sizes, width share, turns about x, y, z (3,) rad."""

    place: Array
    width_share: float
    turns: Array


def draw_novice(rng: np.random.Generator) -> Novice:
    """Return a person: habits around the default hand's, with more tremor, and a style."""
    pace, tremor = rng.uniform(0.6, 1.1), rng.uniform(0.8, 2.0)
    default = Habits()
    habits = replace(
        default,
        speed_m_s=pace * default.speed_m_s,
        turn_rad_s=pace * default.turn_rad_s,
        reaction_s=rng.uniform(0.2, 0.4),
        tremor_m=tremor * default.tremor_m,
        tremor_rad=tremor * default.tremor_rad,
    )
    x, y = rng.normal(0.0, 0.08, 2)
    style = Style(
        tilt_rad=float(np.deg2rad(rng.uniform(6.0, 20.0))),
        roll_rad=float(np.deg2rad(rng.uniform(3.0, 15.0))),
        width_share=rng.uniform(0.2, 0.45),
        width_spread=rng.uniform(0.1, 0.25),
        offset=(float(x), float(y)),
        spread=(rng.uniform(0.12, 0.35), rng.uniform(0.08, 0.2)),
        repeats=rng.uniform(0.1, 0.4),
    )
    return Novice(habits, style)


def choose_view(style: Style, last: Choice | None, rng: np.random.Generator) -> Choice:
    """Return the view that a novice thinks of next, now and then nearly the last one again."""
    fresh = Choice(
        place=np.array(style.offset) + np.array(style.spread) * rng.standard_normal(2),
        width_share=style.width_share * float(np.exp(style.width_spread * rng.standard_normal())),
        turns=np.array([style.tilt_rad, style.tilt_rad, style.roll_rad]) * rng.standard_normal(3),
    )
    if last is None or rng.random() >= style.repeats:
        return fresh
    share = style.repeat_change
    return Choice(
        place=(1.0 - share) * last.place + share * fresh.place,
        width_share=(1.0 - share) * last.width_share + share * fresh.width_share,
        turns=(1.0 - share) * last.turns + share * fresh.turns,
    )


def pose_of_choice(choice: Choice, camera: Intrinsics, target: Target) -> Pose:
    """Return the pose `T_cam_board` at which a camera shows a board as it was thought of."""
    half = 0.5 * np.array(camera.image_size)
    direction = unproject(camera, half + choice.place * half)
    low, high = extent(target.object_points)
    width_m = float(high[0] - low[0])
    distance = camera.vector[0] * width_m / (choice.width_share * camera.image_size[0])
    ray = direction / np.linalg.norm(direction)
    centre = ray * np.clip(distance, NEAREST_M, FARTHEST_M)
    turns = np.clip(choice.turns, -MOST_TILT_RAD, MOST_TILT_RAD)
    pitch, yaw, roll = (rotation_matrix(turn) for turn in np.diag(turns))
    R = yaw @ pitch @ roll
    return Pose(rotation_vector(R), centre - R @ target.centre)


def is_shown_whole(camera: Intrinsics, target: Target, pose: Pose) -> bool:
    """Whether a camera shows the board with its outermost squares, as a person sees on a screen."""
    (left, top, _), (right, bottom, _) = target.outline[0], target.outline[2]
    x, y = np.meshgrid(np.linspace(left, right, 9), np.linspace(top, bottom, 7))
    pattern = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
    points = project_points(clean_scene(camera, target), pose, pattern)
    inside = (points >= 0.0) & (points <= np.array(camera.image_size) - 1.0)
    return bool(np.all(inside))


def think_of_view(
    style: Style, last: Choice | None, camera: Intrinsics, target: Target, rng: np.random.Generator
) -> Choice:
    """Return the next view that the screen shows whole; the last one again where none comes to mind."""
    for _ in range(RETRIES):
        choice = choose_view(style, last, rng)
        if is_shown_whole(camera, target, pose_of_choice(choice, camera, target)):
            return choice
    if last is not None:
        return last
    return Choice(np.zeros(2), 0.2, np.zeros(3))


class FreeHand(Hand):
    """The hand of `Hand`, with its pace, inertia and tremor, that goes where its owner wants it to."""

    def __init__(self, target: Target, start: Pose | None = None, habits: Habits | None = None) -> None:
        """Take the board, the pose to begin with and the habits, as `Hand`."""
        super().__init__(target, start, habits)
        self._wish = self.pose

    def aim_at(self, pose: Pose) -> None:
        """Take the board to another pose `T_cam_board` from now on."""
        self._wish = pose

    @property
    def has_arrived(self) -> bool:
        """Whether the board is where its owner wanted it, nearly."""
        way, turn = self._way_left()
        return float(np.linalg.norm(way)) < ARRIVED_M and float(np.linalg.norm(turn)) < ARRIVED_RAD

    def _way_left(self) -> tuple[Array, Array]:
        """Return what is left to go: (3,) m, and to turn: (3,) rad, in camera axes."""
        R = self._wish.rotation
        centre = R @ self._target.centre + self._wish.tvec
        return centre - self._grip.centre, rotation_vector(R @ self._grip.rotation.T)

    def _decide(self, dt_s: float, rng: np.random.Generator) -> Array:
        """Return the velocity (6,), m/s and rad/s, that leads to the wish; slower over the last part."""
        way, turn = self._way_left()
        sight = self._grip.centre / np.linalg.norm(self._grip.centre)
        arm = self._grip.rotation @ self._grip.hold
        velocity = _limited(way / HOMING_S, self._habits.speed_m_s)
        spin = _limited(turn / HOMING_S, self._habits.turn_rad_s)
        # Turns are about the place where the hand holds the board and take its centre along.
        velocity = velocity + np.cross(spin, arm)
        closer = -velocity[2] / sight[2]
        shift = velocity + closer * sight
        return np.concatenate([[shift[0], shift[1], closer], spin])


def _limited(vector: Array, longest: float) -> Array:
    """Return a vector (3,), shortened to a length."""
    length = float(np.linalg.norm(vector))
    return np.asarray(vector * min(1.0, longest / max(length, 1e-12)), dtype=np.float64)
