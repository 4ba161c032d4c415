"""The paper's Table 2: how ten novices' results scatter, freehand with OpenCV and guided, on both lenses.

Mean and standard deviation over the people of each parameter, as in the paper; then how far the mean is from
the truth, which the paper could not know. Its trials are those of `paper figure4` as well.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from bench.paper.lenses import CODES
from bench.paper.novice_trials import (
    ARMS,
    BLUR_PX,
    EXPOSURE_S,
    FREEHAND,
    GUIDED,
    NOISE_GREY,
    QUICK,
    SEED,
    Effort,
    nominal_camera,
    run_trials,
    true_camera,
)
from bench.pictures import BLUE, GREEN, GREY, ORANGE, make_figure, write_png

NAMES = ("fx", "fy", "cx", "cy", "k1", "k2")
SHOWN = (FREEHAND, *GUIDED)
REQUIRED_SD = {"fx": 0.15, "fy": 0.15, "cx": 0.20, "cy": 0.20, "k1": 0.0006}
PUBLISHED = {
    "lens1": {
        "freehand": {"fx": 23.3, "fy": 19.5, "cx": 14.2, "cy": 27.7, "k1": 0.0105, "k2": 0.2715},
        "guided": {"fx": 2.6, "fy": 2.8, "cx": 2.7, "cy": 4.9, "k1": 0.0047, "k2": 0.0472},
    },
    "lens2": {
        "freehand": {"fx": 13.8, "fy": 13.4, "cx": 9.5, "cy": 8.0, "k1": 0.0188, "k2": 0.0375},
        "guided": {"fx": 2.9, "fy": 2.9, "cx": 4.2, "cy": 1.0, "k1": 0.0059, "k2": 0.0092},
    },
}
MARKS = {FREEHAND: ("s", ORANGE), "guided": ("o", BLUE), "guided_10": ("^", GREEN), "guided_6": ("v", GREY)}


# The picture's scale is linear so far, where guided results are, and logarithmic where freehand ones are.
LINEAR_PX = 0.3
TICKS_PX = (-10.0, -1.0, -0.3, -0.1, 0.0, 0.1, 0.3, 1.0, 10.0)


def run(quick: bool) -> dict[str, Any]:
    """Return the table, its trials behind it."""
    effort = QUICK if quick else Effort()
    return measure(run_trials(effort), effort)


def reuse(result: Mapping[str, Any]) -> dict[str, Any]:
    """Return the table of another table2's trials; raises KeyError where it has none."""
    made_with = {name: result[name] for name in ("quick", "versions", "cores")}
    effort = Effort(views=result["views"], poses=tuple(result["poses"].values()))
    return {**measure(result["trials"], effort), **made_with}


def measure(trials: list[dict[str, Any]], effort: Effort) -> dict[str, Any]:
    """Return the table of the trials of an effort."""
    return {
        **{lens: _lens(lens, [row for row in trials if row["lens"] == lens]) for lens in CODES},
        "required_sd": REQUIRED_SD,
        "published_sd": PUBLISHED,
        "views": effort.views,
        "poses": dict(zip(GUIDED, effort.poses, strict=True)),
        "conditions": {"noise_grey": NOISE_GREY, "blur_px": BLUR_PX, "exposure_s": EXPOSURE_S},
        "trials": trials,
        "seeds": [SEED],
    }


def table(result: Mapping[str, Any]) -> str:
    """Return the table as text."""
    return "\n".join(line for lens in CODES for line in _lines(lens, result))


def plot(result: Mapping[str, Any], path: Path) -> None:
    """Draw how far each person's fx, fy, cx, cy are from the truth; every panel has the same scale."""
    figure, axes = make_figure(2, 4, (9.6, 5.0))
    panels = [(lens, name) for lens in CODES for name in NAMES[:4]]
    errors = {(*panel, arm): _errors(result, *panel, arm) for panel in panels for arm in SHOWN}
    largest = 1.5 * max(abs(error) for each in errors.values() for error in each)
    for one, (lens, name) in zip(axes, panels, strict=True):
        for place, arm in enumerate(SHOWN):
            each = errors[lens, name, arm]
            mark, colour = MARKS[arm]
            at = place + np.linspace(-0.25, 0.25, len(each))
            one.plot(at, each, mark, color=colour, markersize=4, alpha=0.8)
        one.axhline(0.0, color="black", linewidth=0.6)
        one.set_yscale("symlog", linthresh=LINEAR_PX, linscale=2.0)
        one.set_ylim(-largest, largest)
        one.set_yticks(TICKS_PX, [f"{tick:g}" for tick in TICKS_PX], fontsize=8)
        one.set_title(f"{lens}: {name}", fontsize=9)
        one.set_xticks(
            range(len(SHOWN)), [_label(arm, result).replace(" ", "\n") for arm in SHOWN], fontsize=7
        )
    for first in (axes[0], axes[4]):
        first.set_ylabel("estimated − true, px")
    write_png(figure, path)


def _errors(result: Mapping[str, Any], lens: str, name: str, arm: str) -> list[float]:
    """Return how far each person's value of a parameter is from the truth."""
    truth = result[lens]["truth"][name]
    rows = [row for row in result["trials"] if row["lens"] == lens and row["arm"] == arm]
    return [row["parameters"][name] - truth for row in rows if row["parameters"] is not None]


def _lens(lens: str, trials: list[dict[str, Any]]) -> dict[str, Any]:
    """Return the figures of one lens."""
    truth = true_camera(lens).parameters
    arms = {arm: _arm([row for row in trials if row["arm"] == arm], truth) for arm in ARMS}
    missed = [name for name, most in REQUIRED_SD.items() if not arms["guided"][name]["std"] <= most]
    return {
        **arms,
        "ratio": {name: _ratio(arms[FREEHAND][name], arms["guided"][name]) for name in NAMES},
        "requirements_missed": missed,
        "truth": truth,
        "nominal": nominal_camera(lens).parameters,
    }


def _ratio(freehand: Mapping[str, float | None], guided: Mapping[str, float | None]) -> float | None:
    return freehand["std"] / guided["std"] if freehand["std"] and guided["std"] else None


def _arm(rows: list[dict[str, Any]], truth: Mapping[str, float]) -> dict[str, Any]:
    """Return the spread of each parameter over the people, and of what else was seen."""
    solved = [row for row in rows if row["parameters"] is not None]
    figures: dict[str, Any] = {}
    for name in truth:
        values = [row["parameters"][name] for row in solved]
        mean = float(np.mean(values)) if values else None
        figures[name] = {
            "mean": mean,
            "std": float(np.std(values, ddof=1)) if len(values) > 1 else None,
            "bias": None if mean is None else mean - truth[name],
        }
    times = [row["elapsed_s"] for row in rows if "elapsed_s" in row]
    return {
        **figures,
        "mre_px": float(np.mean([row["mre_px"] for row in solved])) if solved else None,
        "solved": len(solved),
        "people": len(rows),
        "verdicts": [row["verdict"] for row in rows if "verdict" in row],
        "median_s": float(np.median(times)) if times else None,
    }


def _lines(lens: str, result: Mapping[str, Any]) -> list[str]:
    """Return the lines of one lens."""
    part, published = result[lens], result["published_sd"][lens]
    lines = [f"{lens:<24}" + "".join(f"{name:>18}" for name in NAMES)]
    lines.append(f"{'  truth':<24}" + "".join(f"{part['truth'][name]:>18.4f}" for name in NAMES))
    for arm in ARMS:
        cells = "".join(f"{_mean_and_sd(part[arm][name], name):>18}" for name in NAMES)
        solved = f"{part[arm]['solved']}/{part[arm]['people']}"
        lines.append(f"  {_label(arm, result):<16}{solved:>6}{cells}")
    for arm, label in ((FREEHAND, "paper, OpenCV: sd"), ("guided", "paper, guided: sd")):
        lines.append(f"  {label:<22}" + "".join(f"{published[arm][name]:>18.4g}" for name in NAMES))
    ratios = "".join(f"{_or_none(part['ratio'][name], '.1f'):>18}" for name in NAMES)
    lines.append(f"  {'sd freehand / guided':<22}" + ratios)
    missed = ", ".join(part["requirements_missed"]) or "none"
    return [
        *lines,
        f"  required sd of guided missed: {missed}",
        *map(_run_words, GUIDED, [part] * len(GUIDED)),
    ]


def _run_words(arm: str, part: Mapping[str, Any]) -> str:
    """Return how the runs of a guided arm went, in a line."""
    verdicts = part[arm]["verdicts"]
    counts = ", ".join(f"{verdict} {verdicts.count(verdict)}" for verdict in sorted(set(verdicts)))
    times = f"median {_or_none(part[arm]['median_s'], '.0f')} s, freehand {part[FREEHAND]['median_s']:.0f} s"
    return f"  {arm}: {counts or 'no verdict'}; {times}"


def _mean_and_sd(figures: Mapping[str, float | None], name: str) -> str:
    places = ".4f" if name.startswith("k") else ".2f"
    return f"{_or_none(figures['mean'], places)} ± {_or_none(figures['std'], '.2g')}"


def _or_none(value: float | None, form: str) -> str:
    return "none" if value is None else format(value, form)


def _label(arm: str, result: Mapping[str, Any]) -> str:
    """Return an arm's name with its number of views."""
    count = result["poses"].get(arm)
    if count is not None:
        return f"guided {count}"
    words = {"freehand": f"freehand {result['views']}", "freehand_ours": "freehand, ours"}
    return words.get(arm, "guided, OpenCV")
