"""The Idempotency-Key header: reads it, and answers a request once however often it comes."""

from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from typing import Annotated

from fastapi import Depends, Header
from fastapi.responses import JSONResponse
from pydantic import BaseModel

from service.api.dependencies import Db, Now
from service.usecases import replay
from service.usecases.access import Caller

IdempotencyKey = Annotated[
    str | None,
    Header(
        alias="Idempotency-Key",
        pattern=r"^[\x21-\x7e]{1,200}$",
        description="Unique text of this request, for example a UUID.",
    ),
]


@dataclass(frozen=True)
class Repeatable:
    """A request that may come again under the same key, with the transaction that its answer is stored in."""

    db: Db
    now: datetime
    key: str | None

    def answer(self, caller: Caller, body: BaseModel, act: Callable[[], BaseModel]) -> JSONResponse:
        """Return the answer (201) of `act`, or the stored one if this very request was answered before."""
        if self.key is None:
            return JSONResponse(act().model_dump(mode="json"), status_code=201)
        principal, request = str(caller.id), replay.fingerprint(type(body).__name__, body.model_dump_json())
        stored = replay.recall(self.db, self.key, principal, request)
        if stored is not None:
            return JSONResponse(stored[1], status_code=stored[0], headers={"Idempotency-Replayed": "true"})
        answer = act().model_dump(mode="json")
        replay.remember(self.db, self.key, principal, request=request, status=201, body=answer, now=self.now)
        return JSONResponse(answer, status_code=201)


def repeatable(db: Db, now: Now, key: IdempotencyKey = None) -> Repeatable:
    """Return what the request needs to be answered once."""
    return Repeatable(db, now, key)


Once = Annotated[Repeatable, Depends(repeatable, scope="function")]
