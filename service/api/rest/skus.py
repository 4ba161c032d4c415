"""SKUs and their revisions: draft, published (never edited again), retired."""

from datetime import datetime
from typing import Annotated
from uuid import UUID

from fastapi import APIRouter, Query
from pydantic import Field

from service.api.auth import Engineer, Viewer
from service.api.dependencies import Db, Now, PageOf, ReadDb
from service.api.shapes import Answer, Page, RevisionNumber, SkuCode
from service.storage.words import Publication
from service.usecases import population, skus
from service.usecases.sku_document import SkuDocument

router = APIRouter(prefix="/skus", tags=["SKUs"])


class SkuRevision(Answer):
    """One revision of a SKU; only a draft can still change, by being replaced with a new revision."""

    id: UUID
    sku_id: UUID
    number: int
    state: Publication
    document: SkuDocument
    created_at: datetime
    published_at: datetime | None


class PublishedPoseSet(Answer):
    """The pose set that new runs of a SKU follow."""

    id: UUID
    poses: int = Field(description="How many.")


class Limit(Answer):
    """A limit of a gate as it is in force."""

    name: str = Field(description="Name of the limit, as in a SKU's document.")
    value: float
    marginal_share: float = Field(description="Share of the limit from which on a value is MARGINAL.")
    is_default: bool = Field(description="Whether the revision leaves it as it is for the image size.")


class RevisionLimits(Answer):
    """All limits by which runs of a revision are judged."""

    limits: list[Limit]


class PopulationParameter(Answer):
    """A parameter of the lens over the cameras of a SKU revision."""

    name: str
    mean: float
    sd_between: float = Field(description="Standard deviation between cameras, without calibration noise.")
    sd_own: float = Field(description="Typical standard deviation of one calibration.")
    nominal: float


class Population(Answer):
    """What the cameras of a SKU revision have in common."""

    sku: str
    revision: int
    units: int = Field(description="Cameras that count.")
    needed: int = Field(description="From how many on cameras are compared with the population.")
    judged_by: int | None = Field(
        description="Units of the state by which results are judged now; renewed at every tenth more."
    )
    judged_since: datetime | None
    start_limits_used: float | None = Field(
        description="Share of the start limits (focal length, centre) that mean and three sd take; above 1 "
        "good cameras fail at them."
    )
    parameters: list[PopulationParameter] = Field(description="Empty before two units are known.")
    covariance: list[list[float]] | None = Field(description="Between cameras, in the order of `parameters`.")


class Sku(Answer):
    """A camera variant, with the numbers of its revisions that count."""

    id: UUID
    code: str
    name: str
    latest_revision: int
    published_revision: int | None
    published_pose_set: PublishedPoseSet | None
    created_at: datetime


class SkuDetail(Sku):
    """A camera variant with its revisions, newest first."""

    revisions: list[SkuRevision]


@router.post("", status_code=201, summary="Create a SKU")
def create_sku(body: SkuDocument, caller: Engineer, db: Db, now: Now) -> SkuDetail:
    """Create a camera variant with its first revision, a draft. Publish the revision before runs use it."""
    return SkuDetail.model_validate(skus.create_sku(db, body, caller.name, now))


@router.get("", summary="List the SKUs")
def list_skus(caller: Viewer, db: ReadDb, page: PageOf) -> Page[Sku]:
    """List the camera variants, newest first."""
    return Page[Sku].model_validate(skus.list_skus(db, page))


@router.get("/{code}", summary="Read a SKU")
def read_sku(code: SkuCode, caller: Viewer, db: ReadDb) -> SkuDetail:
    """Read a camera variant and its revisions."""
    return SkuDetail.model_validate(skus.read_sku(db, code))


@router.post("/{code}/revisions", status_code=201, summary="Add a revision")
def create_revision(code: SkuCode, body: SkuDocument, caller: Engineer, db: Db, now: Now) -> SkuRevision:
    """Add a draft. Published revisions are never edited: every change of a SKU is a new revision."""
    return SkuRevision.model_validate(skus.add_revision(db, code, body, caller.name, now))


@router.get("/{code}/revisions", summary="List the revisions")
def list_revisions(code: SkuCode, caller: Viewer, db: ReadDb, page: PageOf) -> Page[SkuRevision]:
    """List the revisions of a camera variant, newest first."""
    return Page[SkuRevision].model_validate(skus.list_revisions(db, code, page))


@router.get("/{code}/revisions/{number}", summary="Read a revision")
def read_revision(code: SkuCode, number: RevisionNumber, caller: Viewer, db: ReadDb) -> SkuRevision:
    """Read one revision with its whole document."""
    return SkuRevision.model_validate(skus.get_revision(db, code, number))


@router.get("/{code}/revisions/{number}/limits", summary="Read the limits of a revision")
def read_limits(code: SkuCode, number: RevisionNumber, caller: Viewer, db: ReadDb) -> RevisionLimits:
    """Read the limits by which runs of a revision are judged: its own ones, and the defaults for the rest."""
    return RevisionLimits.model_validate({"limits": skus.read_limits(db, code, number)})


@router.get("/{code}/population", summary="Read the population of a SKU")
def read_population(
    code: SkuCode,
    caller: Viewer,
    db: ReadDb,
    revision: Annotated[
        int | None, Query(ge=1, le=1_000_000, description="By default the published one, else the newest.")
    ] = None,
) -> Population:
    """Read what the cameras of a revision have in common.

    A camera counts by its latest production or retest run with the verdict PASS. From `needed` units on the
    identity gate compares every camera with them; until then the start limits hold alone.
    """
    return Population.model_validate(population.read_population(db, code, revision))


@router.post("/{code}/revisions/{number}/publish", summary="Publish a revision")
def publish_revision(
    code: SkuCode, number: RevisionNumber, caller: Engineer, db: Db, now: Now
) -> SkuRevision:
    """Publish a draft: new runs use it from now on, and the revision that was published before is retired."""
    return SkuRevision.model_validate(skus.publish_revision(db, code, number, caller.name, now))
