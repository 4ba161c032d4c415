"""Calibrate from the images of a folder, without a server: decoding, detection and gates are the service's.

Not here: how the outcome is printed (folder_report.py, cli).
"""

import re
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

from service.core.errors import FolderUnusable, ServiceError
from service.core.quality.evidence import Expectation, NamedDetection, Refusal
from service.core.quality.verdict import Judged, calibrate_and_judge
from service.core.vision.calibration import check_request
from service.core.vision.detection import detect_target
from service.core.vision.residuals import view_rms
from service.core.vision.target import Target
from service.usecases.fixture_document import FixtureDocument
from service.usecases.folder_place import PlacePictures
from service.usecases.images import SUFFIXES, decode_image, image_sha256, read_image_file
from service.usecases.sku_document import Revision


@dataclass(frozen=True)
class ImageOutcome:
    """What became of one image: used, with its RMS error, or refused, with the reason's code and detail."""

    name: str
    reason: str | None = None
    detail: str | None = None
    rms_px: float | None = None

    @property
    def status(self) -> str:
        """`used` or `refused`."""
        return "used" if self.reason is None else "refused"


@dataclass(frozen=True)
class FolderCalibration:
    """The judged calibration of a folder, and what became of each of its images, in their order.

    fixture: of the pictures that say where the camera is in the vehicle, if there are such.
    """

    target: Target
    judged: Judged
    images: tuple[ImageOutcome, ...]
    fixture: FixtureDocument | None = None


def calibrate_folder(
    folder: Path,
    target: Target,
    lens: str,
    *,
    fixed: Collection[str] = (),
    revision: Revision | None = None,
    place: PlacePictures | None = None,
) -> FolderCalibration:
    """Calibrate from the images of a folder; without a revision only gates that need no SKU judge it.

    place: pictures that say where the camera is in the vehicle; those of the folder are not used otherwise.
    Raises FolderUnusable, TooFewViews, DegenerateViews, IntrinsicsInvalid, and what `PlacePictures.detect`
    raises. An image of the folder that cannot be used is refused by name, and the rest goes on.
    """
    nominal = revision.intrinsics if revision else None
    # Before the images, which take a while.
    check_request(nominal.image_size if nominal else (0, 0), lens, nominal, fixed)
    paths = [path for path in list_images(folder) if place is None or not place.names(path)]
    fixed_target = None if place is None else place.detect()
    outcomes = [_observe(path, target) for path in paths]
    judged = calibrate_and_judge(
        [outcome for outcome in outcomes if isinstance(outcome, NamedDetection)],
        target,
        lens,
        expectation_of(revision),
        fixed=fixed,
        refused=[outcome for outcome in outcomes if isinstance(outcome, Refusal)],
        fixed_target=fixed_target,
    )
    return FolderCalibration(
        target, judged, _outcomes(paths, judged), None if place is None else place.fixture
    )


def list_images(folder: Path) -> list[Path]:
    """Return the image files of a folder, in the order people count; raises FolderUnusable."""
    if not folder.is_dir():
        found = "is a file" if folder.exists() else "does not exist"
        raise FolderUnusable(
            f"'{folder}' {found}. Give the folder that holds the images.", folder=str(folder)
        )
    try:
        paths = [path for path in folder.iterdir() if path.suffix.lower() in SUFFIXES and path.is_file()]
    except OSError as error:
        raise FolderUnusable(f"'{folder}' cannot be read: {error.strerror}.", folder=str(folder)) from error
    if not paths:
        kinds = ", ".join(sorted(SUFFIXES))
        raise FolderUnusable(f"'{folder}' holds no images; looked for {kinds}.", folder=str(folder))
    return sorted(paths, key=_counting_order)


def expectation_of(revision: Revision | None) -> Expectation | None:
    """Return what a SKU revision says about a camera; no poses are prescribed for a folder."""
    if revision is None:
        return None
    return Expectation(
        nominal=revision.intrinsics,
        limits=revision.limits,
        working_zone=revision.working_zone,
        valid_region=revision.valid_region,
        mounting=revision.mounting,
    )


def _observe(path: Path, target: Target) -> NamedDetection | Refusal:
    try:
        data = read_image_file(path)
        detection = detect_target(decode_image(data, path.name), target)
    except ServiceError as error:
        return Refusal(path.name, error.code, error.detail)
    return NamedDetection(path.name, detection, image_sha256(data))


def _outcomes(paths: list[Path], judged: Judged) -> tuple[ImageOutcome, ...]:
    used = dict(zip((view.name for view in judged.views), view_rms(judged.result.residuals), strict=True))
    refused = {refusal.name: refusal for refusal in judged.refused}
    outcomes = []
    for path in paths:
        if path.name in used:
            outcomes.append(ImageOutcome(path.name, rms_px=float(used[path.name])))
        else:
            refusal = refused[path.name]
            outcomes.append(ImageOutcome(path.name, refusal.code, refusal.detail))
    return tuple(outcomes)


def _counting_order(path: Path) -> list[tuple[int, str]]:
    """Sort `2.jpg` before `10.jpg`: runs of digits compare as numbers."""
    return [(int(part), "") if part.isdigit() else (-1, part) for part in re.split(r"([0-9]+)", path.name)]
