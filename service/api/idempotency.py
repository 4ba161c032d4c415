"""The Idempotency-Key header: reads it, and answers a request once however often it comes."""

from collections.abc import Callable
from datetime import datetime
from typing import Annotated

from fastapi import Header
from fastapi.responses import JSONResponse
from pydantic import BaseModel

from service.api.dependencies import Db
from service.usecases import replay
from service.usecases.access import Caller

IdempotencyKey = Annotated[
    str | None,
    Header(pattern=r"^[\x21-\x7e]{1,200}$", description="Unique text of this request, for example a UUID."),
]


def answer_once(
    db: Db, key: str | None, caller: Caller, now: datetime, body: BaseModel, act: Callable[[], BaseModel]
) -> JSONResponse:
    """Return the answer (201) of `act`, or, under a key that was used for this very request, the stored one."""
    request = replay.fingerprint(type(body).__name__, body.model_dump_json())
    if key is not None:
        stored = replay.recall(db, key, str(caller.id), request)
        if stored is not None:
            return JSONResponse(stored[1], status_code=stored[0], headers={"Idempotency-Replayed": "true"})
    answer = act().model_dump(mode="json")
    if key is not None:
        replay.remember(db, key, str(caller.id), request, 201, answer, now)
    return JSONResponse(answer, status_code=201)
