"""What the pictures of benches have in common: size, colours that everyone can tell apart, small files.

Not here: what is drawn. matplotlib without its state machine, so that nothing is left open.
"""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

# Okabe and Ito's colours; marks and hatches differ as well.
BLUE, ORANGE, GREEN, GREY, BLACK = "#0072B2", "#E69F00", "#009E73", "#999999", "#000000"
DOTS_PER_INCH = 110


def make_figure(rows: int, columns: int, size: tuple[float, float]) -> tuple[Figure, list[Axes]]:
    """Return a figure of a size in inches and its axes, row by row."""
    figure = Figure(figsize=size, layout="constrained")
    axes = np.atleast_1d(np.asarray(figure.subplots(rows, columns))).ravel()
    for one in axes:
        one.grid(visible=True, axis="y", color="#dddddd", linewidth=0.6)
        one.set_axisbelow(True)
        one.spines[["top", "right"]].set_visible(False)
    return figure, list(axes)


def write_png(figure: Figure, path: Path) -> None:
    """Write a figure so that the same figures give the same bytes."""
    figure.savefig(path, dpi=DOTS_PER_INCH, format="png", metadata={"Software": None})
