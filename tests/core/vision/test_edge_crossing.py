import numpy as np
import pytest
from scipy.special import erf

from service.core.vision.camera import Intrinsics, project
from service.core.vision.edge_crossing import Edges, edges_on_board, refine_crossings
from service.core.vision.saddle import refine_saddles
from service.core.vision.sampling import FloatImage, smooth
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Array
from service.simulator.renderer import prepare
from service.simulator.scene import clean_scene, true_corners
from tests.core.vision.drawn_board import draw_board
from tests.simulator.cameras import centred_pose

POINT = np.array([[30.37, 24.81]])
RADIUS = np.array([11.0])
ANGLES = np.array([[0.15, 1.45]])
MIDDLE = np.array([319.5, 239.5])  # of what `draw_board` draws
SQUARES = draw_board().target.object_points[:, :2] / draw_board().target.square_m
BOARD = Chessboard(9, 6, 0.03)
FLAT = BOARD.object_points[:, :2]
WIDE_LENS = Intrinsics.from_parameters(
    "pinhole5", {"fx": 600.0, "fy": 600.0, "cx": 650.0, "cy": 390.0, "k1": -0.3, "k2": 0.1}, (1280, 800)
)
WIDE_MIDDLE = np.array([639.5, 399.5])
TILTED = centred_pose(BOARD, (25.0, -20.0, 30.0), (0.08, 0.03, 0.28))
STRAIGHT = np.zeros((1, 2))
AWAY = np.array([[0.24, -0.2]])


def crossing(
    sigmas: tuple[float, float] = (0.9, 0.9),
    bends: tuple[float, float] = (0.0, 0.0),
    spread_px: float = 0.0,
    noise: float = 0.0,
) -> FloatImage:
    """Two soft edges, dark where the distances from both have one sign, by `spread_px` too far."""
    y, x = np.mgrid[:48, :60].astype(np.float64)
    ux, uy = x - POINT[0, 0], y - POINT[0, 1]
    distances = []
    for angle, bend in zip(ANGLES[0], bends, strict=True):
        along = np.cos(angle) * ux + np.sin(angle) * uy
        distances.append(np.cos(angle) * uy - np.sin(angle) * ux - 0.5 * bend * along**2)
    one, two = distances
    grown = [one + spread_px * np.sign(two), two + spread_px * np.sign(one)]
    first, second = (erf(d / (np.sqrt(2.0) * s)) for d, s in zip(grown, sigmas, strict=True))
    rng = np.random.default_rng(3)
    return np.asarray(0.5 - 0.4 * first * second + rng.normal(0, 1, x.shape) * noise, dtype=np.float32)


def found(image: FloatImage, edges: Edges | None = None, radii: Array = RADIUS, sigma: float = 1.0) -> Array:
    edges = Edges(ANGLES + 0.05, STRAIGHT) if edges is None else edges
    points, proven = refine_crossings(image, POINT + AWAY, edges, radii, sigma)
    assert proven.all()
    return points


@pytest.mark.parametrize("sigma", [0.6, 0.9, 2.0, 3.5])
def test_a_crossing_is_found_whatever_the_blur(sigma: float) -> None:
    assert found(crossing((sigma, sigma))) == pytest.approx(POINT, abs=5e-4)


def test_blur_in_one_direction_does_not_move_it() -> None:
    assert found(crossing((0.8, 2.5))) == pytest.approx(POINT, abs=2e-3)


def test_ink_that_has_spread_does_not_move_it() -> None:
    assert found(crossing(spread_px=0.4)) == pytest.approx(POINT, abs=4e-3)


def test_bent_edges_are_followed_where_their_bend_is_known() -> None:
    bends = (0.006, -0.004)
    image = crossing(bends=bends)
    assert found(image, Edges(ANGLES, np.array([bends]))) == pytest.approx(POINT, abs=1e-3)
    assert np.linalg.norm(found(image, Edges(ANGLES, STRAIGHT)) - POINT) > 0.05


def test_it_is_twice_as_near_as_a_saddle_fit_in_noise() -> None:
    board = draw_board()
    errors: dict[str, list[Array]] = {"edges": [], "saddles": []}
    for seed in range(6):
        image = smooth(board.image(noise_grey=3.0, seed=seed), 0.7)
        saddles, _ = refine_saddles(image, board.corners + 0.2, np.full(54, 4))
        edges = edges_on_board(SQUARES, saddles, 1.0, MIDDLE)
        points, proven = refine_crossings(image, saddles, edges, np.full(54, 12.0), 1.1)
        assert proven.all()
        errors["edges"].append(points - board.corners)
        errors["saddles"].append(saddles - board.corners)
    ours, theirs = (float(np.sqrt(np.mean(np.square(some)))) for some in errors.values())
    assert ours < 0.5 * theirs
    assert ours < 0.01


def test_a_crossing_at_the_border_of_the_image_is_fitted_to_what_is_there() -> None:
    image = np.ascontiguousarray(crossing()[:, 26:])
    away = np.array([26.0, 0.0])
    points, proven = refine_crossings(image, POINT + AWAY - away, Edges(ANGLES, STRAIGHT), RADIUS, 1.0)
    assert proven.all()
    assert points + away == pytest.approx(POINT, abs=1e-3)


def test_where_nothing_crosses_the_start_comes_back() -> None:
    rng = np.random.default_rng(5)
    noise = np.asarray(0.5 + 0.01 * rng.normal(0, 1, (48, 60)), dtype=np.float32)
    points, proven = refine_crossings(noise, POINT, Edges(ANGLES, STRAIGHT), RADIUS, 1.0)
    assert not proven.any()
    assert points.tolist() == POINT.tolist()


def test_a_crossing_far_from_its_start_is_not_claimed() -> None:
    start = POINT + np.array([[2.5, 0.0]])
    points, proven = refine_crossings(crossing(), start, Edges(ANGLES, STRAIGHT), RADIUS, 1.0)
    assert not proven.any()
    assert points.tolist() == start.tolist()


def test_a_tiny_disc_leaves_the_start_as_it_is() -> None:
    start = POINT + AWAY
    points, proven = refine_crossings(crossing(), start, Edges(ANGLES, STRAIGHT), np.array([2.5]), 1.0)
    assert not proven.any()
    assert points.tolist() == start.tolist()


def test_no_corners_give_no_crossings() -> None:
    nothing = np.zeros((0, 2))
    points, proven = refine_crossings(crossing(), nothing, Edges(nothing, nothing), np.zeros(0), 1.0)
    assert points.shape == (0, 2)
    assert proven.shape == (0,)


def test_edges_bend_as_the_lens_bends_them() -> None:
    corners = project(WIDE_LENS, TILTED.rotation, TILTED.tvec, BOARD.object_points)
    edges = edges_on_board(FLAT, corners, BOARD.square_m, WIDE_MIDDLE)
    for axis in (0, 1):
        way = np.eye(3)[axis] * 0.4 * BOARD.square_m
        before, after = (
            project(WIDE_LENS, TILTED.rotation, TILTED.tvec, BOARD.object_points + sign * way)
            for sign in (-1.0, 1.0)
        )
        chord = after - before
        length = np.linalg.norm(chord, axis=1)
        middle = 0.5 * (before + after) - corners
        sagitta = (chord[:, 1] * middle[:, 0] - chord[:, 0] * middle[:, 1]) / length
        # A circle's bend by its sagitta; the chord hardly turns it.
        assert edges.bends[:, axis] == pytest.approx(-8.0 * sagitta / length**2, abs=3e-5)
        assert np.abs(edges.bends[:, axis]).max() > 3e-4
        assert np.cos(edges.angles[:, axis] - np.arctan2(chord[:, 1], chord[:, 0])) == pytest.approx(
            1, abs=1e-4
        )


def test_corners_are_not_drawn_to_or_from_the_middle_of_a_bending_lens() -> None:
    scene = clean_scene(WIDE_LENS, BOARD)
    image = smooth(np.asarray(prepare(scene).light(TILTED), dtype=np.float32) / np.float32(200.0), 0.7)
    truth = true_corners(scene, TILTED)
    rough = truth + np.random.default_rng(1).normal(0.0, 0.02, truth.shape)
    outwards = (truth - WIDE_MIDDLE) / np.linalg.norm(truth - WIDE_MIDDLE, axis=1, keepdims=True)

    def drawn_px(edges: Edges) -> float:
        points, proven = refine_crossings(image, rough, edges, np.full(54, 12.0), 1.1)
        assert proven.all()
        return float(np.abs(np.sum((points - truth) * outwards, axis=1)).mean())

    bending = edges_on_board(FLAT, rough, BOARD.square_m, WIDE_MIDDLE)
    assert drawn_px(bending) < 0.002
    assert drawn_px(Edges(bending.angles, np.zeros((54, 2)))) > 0.005


def test_corners_together_do_not_follow_light_that_falls_off_across_the_board() -> None:
    board = draw_board()
    y, x = np.mgrid[:480, :640]
    fall = 1.1 * np.exp(-((x - 500.0) ** 2 + (y - 100.0) ** 2) / 3e5)
    image = smooth(np.asarray(board.light() * fall / 200.0, dtype=np.float32), 0.7)
    edges = edges_on_board(SQUARES, board.corners, 1.0, MIDDLE)
    start, radii = board.corners + 0.1, np.full(54, 12.0)
    together, proven = refine_crossings(image, start, edges, radii, 1.1)
    assert proven.all()
    assert np.sqrt(np.mean((together - board.corners) ** 2)) < 0.001
    alone = [
        refine_crossings(image, start[[i]], Edges(edges.angles[[i]], edges.bends[[i]]), radii[[i]], 1.1)[0][0]
        for i in range(54)
    ]
    assert np.sqrt(np.mean((np.array(alone) - board.corners) ** 2)) > 0.02


def test_a_grid_in_perspective_has_straight_edges() -> None:
    edges = edges_on_board(SQUARES, draw_board().corners, 1.0, MIDDLE)
    assert edges.bends == pytest.approx(0.0, abs=1e-9)


def test_edges_are_straight_where_no_map_fits() -> None:
    torn = draw_board().corners + np.random.default_rng(4).normal(0.0, 3.0, (54, 2))
    assert edges_on_board(SQUARES, torn, 1.0, MIDDLE).bends.tolist() == np.zeros((54, 2)).tolist()
