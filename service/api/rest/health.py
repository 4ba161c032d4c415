"""Health: does the process live, and can it do its work."""

from typing import Literal

from fastapi import APIRouter

from service.api.auth import PUBLIC
from service.api.dependencies import Of
from service.api.shapes import Answer

router = APIRouter(tags=["Health"], dependencies=[PUBLIC])


class Alive(Answer):
    """The process answers."""

    status: Literal["alive"]


class Ready(Answer):
    """Everything the service needs is there."""

    status: Literal["ready"]
    checks: list[str]


@router.get("/livez", summary="Is the process alive?")
def read_livez() -> Alive:
    """Answer as long as the process lives; restart it when this fails."""
    return Alive(status="alive")


@router.get("/readyz", summary="Can the service work?")
def read_readyz(of: Of) -> Ready:
    """Check database, schema, image store and jobs.

    503 names what is missing. Send no work until this is 200.
    """
    for check in of.checks.values():
        check()
    return Ready(status="ready", checks=list(of.checks))
