"""The paper's two cameras and its board, for the tests of planning."""

from service.core.vision.camera import Intrinsics
from service.core.vision.target_chessboard import Chessboard

LENS1 = Intrinsics.from_parameters(
    "pinhole5",
    {"fx": 1350.1, "fy": 1352.1, "cx": 657.6, "cy": 383.8, "k1": -0.3774, "k2": 0.2425},
    (1280, 800),
)
LENS2 = Intrinsics.from_parameters(
    "pinhole5",
    {"fx": 972.5, "fy": 974.4, "cx": 954.9, "cy": 644.4, "k1": -0.3454, "k2": 0.1398},
    (1920, 1208),
)
BOARD = Chessboard(9, 6, 0.025)
