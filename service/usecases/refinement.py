"""A SKU whose camera is better known after a run: a new revision with that estimate, and a plan that follows.

So a camera of which only the data sheet is known is bootstrapped: plan, guide a run, refine, and again until
the plan that follows says that it is settled. Not here: planning itself (`planning`).
"""

from dataclasses import dataclass, replace
from datetime import datetime
from uuid import UUID

from sqlalchemy.orm import Session

from service.core.errors import StateForbids, ValidationFailed
from service.core.quality.gates import Verdict
from service.ports import JobQueue
from service.storage.models import SkuRevisionRow
from service.usecases.planning import PlanRequest
from service.usecases.pose_sets import Requested, request_pose_set
from service.usecases.results import ResultView, read_result
from service.usecases.runs import RunView, read_run
from service.usecases.sku_document import SkuDocument
from service.usecases.skus import add_revision, get_revision

# What a run must not fail to be believed; the rest is what a first plan from a data sheet cannot meet.
TRUSTED_GATES = frozenset({"frame", "fit"})


@dataclass(frozen=True)
class Refined:
    """The new revision, a draft, and the set that is planned for it."""

    revision: SkuRevisionRow
    requested: Requested


def refine_sku(
    session: Session, queue: JobQueue, code: str, run_id: UUID, plan: PlanRequest, *, who: str, now: datetime
) -> Refined:
    """Add a revision whose nominal is what a run has found, and plan for it.

    Raises NotFound, ValidationFailed for a run of another SKU, and StateForbids for a result that cannot be
    believed.
    """
    run = read_run(session, run_id)
    if run.sku.code != code:
        raise ValidationFailed(
            f"This run calibrated a camera of SKU '{run.sku.code}', not of '{code}'. Name a run of this SKU.",
            pointer="/run_id",
        )
    document = _document(session, run, _believed(read_result(session, run_id)))
    revision = add_revision(session, code, document, who, now)
    follows = None if run.pose_set_id is None else str(run.pose_set_id)
    asked = replace(plan, follows=follows)
    return Refined(revision, request_pose_set(session, queue, code, revision.number, asked, who=who, now=now))


def _document(session: Session, run: RunView, result: ResultView) -> SkuDocument:
    """Return the document of the run's revision with the estimate as its nominal."""
    before = SkuDocument.model_validate(get_revision(session, run.sku.code, run.sku.revision).document)
    return SkuDocument.model_validate(
        {**before.model_dump(mode="json"), "nominal": dict(result.intrinsics), "data_sheet": None}
    )


def _believed(result: ResultView) -> ResultView:
    failed = sorted({gate.gate for gate in result.gates if gate.verdict is Verdict.FAIL} & TRUSTED_GATES)
    if failed:
        raise StateForbids(
            f"The run failed in {', '.join(failed)}, so its estimate is no nominal for others. Take the run "
            "again with what its gates say.",
            gates=failed,
        )
    return result
