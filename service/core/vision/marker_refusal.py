"""What is said of an image in which the declared board's markers are not found, or are not as declared.

Not here: finding them (`marker_detection`).
"""

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.errors import ServiceError, TargetNotVisible, WrongTarget
from service.core.vision.coded import CodedTarget
from service.core.vision.marker_detection import Layout, Markers, compare_layout, find_markers

SURE_MARKERS = 3  # by chance, an image shows fewer of another dictionary
FAMILIES = ("4x4_1000", "5x5_1000", "6x6_1000", "7x7_1000", "tag16h5", "tag25h9", "tag36h11")
BORDERS = (1, 2)


def check_ids(found: Markers, target: CodedTarget) -> Markers:
    """Return the markers that the board has; raises WrongTarget where others of their size are many."""
    known = found.ids < len(target.marker_features)
    sides = found.sides_px
    largest = float(sides.max(initial=0.0))
    foreign = found.ids[~known & (sides > 0.5 * largest)]
    if len(foreign) >= SURE_MARKERS:
        shown = ", ".join(str(marker) for marker in sorted(set(foreign.tolist()))[:6])
        raise WrongTarget(
            f"The image shows markers that a {target.name} does not have ({shown}); show the declared board "
            "alone, or declare the one that is shown.",
            found_markers=sorted(set(foreign.tolist())),
            declared=target.spec,
        )
    return found.part(known)


def check_layout(layout: Layout, found: Markers, target: CodedTarget) -> Markers:
    """Return the markers that lie as on the board; raises WrongTarget where most do not."""
    if len(found) >= SURE_MARKERS and layout.pairs_apart > max(1, layout.pairs - layout.pairs_apart):
        raise WrongTarget(
            f"The markers in the image do not lie as on a {target.name}; check its columns and rows "
            f"({_counted(target)}), and show one board only.",
            declared=target.spec,
        )
    return layout.fitting


def refuse_markers(image: NDArray[np.uint8], target: CodedTarget) -> ServiceError:
    """Return the error for an image without the board's markers: mirrored, another board, or none."""
    mirrored = cv2.flip(image, 1)
    found = find_markers(np.asarray(mirrored, dtype=np.uint8), target.dictionary, target.marker_border)
    found = found.part(found.ids < len(target.marker_features))
    if len(compare_layout(found, target).fitting) >= SURE_MARKERS:
        return WrongTarget(
            f"The image is mirrored: its markers are those of a {target.name} seen in a mirror. Switch the "
            "mirroring of the camera or of its reader off.",
            mirrored=True,
            declared=target.spec,
        )
    other = _other_markers(image, target)
    if other is not None:
        declared = _named(target.dictionary, target.marker_border)
        return WrongTarget(
            f"The markers in the image are of {other}, not of {declared}; declare the board that is shown or "
            "show the declared one.",
            found_dictionary=other,
            declared=target.spec,
        )
    return TargetNotVisible(
        f"No markers of a {target.name} were found; bring the board into the picture, lit evenly, sharp and "
        "near enough.",
        corners_seen=0,
    )


def refuse_few(corners_seen: int, corners_needed: int, target: CodedTarget) -> TargetNotVisible:
    """Return the error for an image with too small a part of the board."""
    return TargetNotVisible(
        f"Only {corners_seen} corners of the {target.name} were found; bring more of the board into the "
        f"picture, at least {corners_needed} corners in three rows and three columns, sharp and uncovered.",
        corners_seen=corners_seen,
        corners_needed=corners_needed,
    )


def _other_markers(image: NDArray[np.uint8], target: CodedTarget) -> str | None:
    """Return which dictionary the image's markers are of, if most are not of the declared one."""
    counts = {
        (family, border): len(set(find_markers(image, family, border).ids.tolist()))
        for family in FAMILIES
        for border in BORDERS
    }
    most = max(counts, key=lambda kind: counts[kind])
    if counts[most] <= SURE_MARKERS or most == (target.dictionary, target.marker_border):
        return None
    return _named(*most)


def _named(dictionary: str, border: int) -> str:
    return f"{dictionary} with a border of {border} cell{'s' if border > 1 else ''}"


def _counted(target: CodedTarget) -> str:
    return "inner corners, one fewer than squares each way" if target.kind == "charuco" else "tags"
