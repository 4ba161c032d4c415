"""The paper's Fig. 4: the mean reprojection error of ten novices' calibrations, freehand and guided.

From the trials of `paper table2` (`--reuse FILE`), or measured again. Mean reprojection error says how well
a camera explains its own pictures, not how near it is to the truth: the table has that.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from bench.paper.lenses import CODES
from bench.paper.novice_trials import ARMS, FREEHAND, QUICK, SEED, Effort, run_trials
from bench.pictures import BLACK, BLUE, ORANGE, make_figure, write_png

DRAWN = ((FREEHAND, "OpenCV, freehand", ORANGE), ("guided", "guided", BLUE))


def run(quick: bool) -> dict[str, Any]:
    """Return the errors by lens and arm, from trials of its own."""
    return measure(run_trials(QUICK if quick else Effort()), [SEED])


def reuse(result: Mapping[str, Any]) -> dict[str, Any]:
    """Return the errors of the trials of a table2; raises KeyError where it has none."""
    made_with = {name: result[name] for name in ("quick", "versions", "cores")}
    return {**measure(result["trials"], result["seeds"]), **made_with}


def measure(trials: list[dict[str, Any]], seeds: list[int]) -> dict[str, Any]:
    """Return the errors by lens and arm of trials."""
    return {
        **{lens: {arm: _spread(trials, lens, arm) for arm in ARMS} for lens in CODES},
        "seeds": seeds,
    }


def table(result: Mapping[str, Any]) -> str:
    """Return the errors as text."""
    columns = ("mean", "std", "min", "median", "max")
    lines = [f"{'mean reprojection error, px':<30}" + "".join(f"{name:>9}" for name in columns)]
    for lens in CODES:
        for arm in ARMS:
            spread = result[lens][arm]
            figures = "".join(
                f"{'none' if spread[name] is None else format(spread[name], '.4f'):>9}" for name in columns
            )
            lines.append(f"{lens + ' ' + arm:<30}{figures}")
    return "\n".join(lines)


def plot(result: Mapping[str, Any], path: Path) -> None:
    """Draw the boxes: from quartile to quartile, whiskers to the extremes, a line for the mean."""
    figure, axes = make_figure(1, len(CODES), (7.6, 3.4))
    for one, lens in zip(axes, CODES, strict=True):
        boxes = one.boxplot(
            [result[lens][arm]["each"] for arm, _, _ in DRAWN],
            whis=(0, 100),
            widths=0.5,
            patch_artist=True,
            showmeans=True,
            meanline=True,
            meanprops={"color": "red", "linestyle": "-", "linewidth": 1.6},
            medianprops={"color": BLACK, "linewidth": 0.8},
        )
        for box, (_, _, colour) in zip(boxes["boxes"], DRAWN, strict=True):
            box.set_facecolor(colour)
            box.set_alpha(0.55)
        one.set_xticks(range(1, len(DRAWN) + 1), [label for _, label, _ in DRAWN])
        one.set_ylim(bottom=0.0)
        one.set_title(lens)
    axes[0].set_ylabel("mean reprojection error, px")
    write_png(figure, path)


def _spread(trials: list[dict[str, Any]], lens: str, arm: str) -> dict[str, Any]:
    """Return the spread of the errors of one arm."""
    each = [
        row["mre_px"]
        for row in trials
        if row["lens"] == lens and row["arm"] == arm and row["mre_px"] is not None
    ]
    if not each:
        return {"mean": None, "std": None, "min": None, "median": None, "max": None, "each": []}
    return {
        "mean": float(np.mean(each)),
        "std": float(np.std(each, ddof=1)) if len(each) > 1 else None,
        "min": min(each),
        "median": float(np.median(each)),
        "max": max(each),
        "each": each,
    }
