"""Pictures of a fixed target for the command: the fixture's file, and what is detected in the pictures.

An image of the folder may be left out; a picture that was named must be usable. Not here: the rest of a
folder's calibration (`folder_calibration`).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from service.core.errors import ServiceError
from service.core.quality.evidence import FixedTargetViews, NamedDetection
from service.core.vision.detection import detect_target
from service.core.vision.fixture_problems import FixtureFileUnreadable
from service.core.vision.target import parse_target
from service.usecases.document_file import read_document
from service.usecases.fixture_document import FixtureDocument
from service.usecases.images import decode_image, image_sha256, read_image_file


@dataclass(frozen=True)
class PlacePictures:
    """A fixture, and the files of the pictures that show its target."""

    fixture: FixtureDocument
    paths: tuple[Path, ...]

    def names(self, path: Path) -> bool:
        """Whether a file is one of the pictures."""
        return any(path.resolve() == own.resolve() for own in self.paths)

    def detect(self) -> FixedTargetViews:
        """Return what the pictures show; raises what decoding and detection raise, naming the picture."""
        target = parse_target(self.fixture.target)
        views = []
        for path in self.paths:
            data = read_image_file(path)
            image = decode_image(data, path.name)
            try:
                detection = detect_target(image, target)
            except ServiceError as error:
                # Detection does not know how the picture is called.
                raise type(error)(f"{path.name}: {error.detail}", **error.facts) from error
            views.append(NamedDetection(path.name, detection, image_sha256(data)))
        return FixedTargetViews(target, self.fixture.to_fixed_target(), tuple(views))


def read_place_pictures(fixture: Path, paths: Sequence[Path]) -> PlacePictures:
    """Return the pictures with the fixture of a JSON file; raises FixtureFileUnreadable."""
    document = read_document(fixture, FixtureDocument, "fixture", FixtureFileUnreadable)
    return PlacePictures(document, tuple(paths))
