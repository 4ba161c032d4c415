"""Errors as problem documents (RFC 9457): the one place that knows HTTP numbers.

Every answer that is not a success is a problem: errors of the domain, invalid fields, unknown addresses,
bodies that are too large, and faults of the service, which tell a trace id and nothing of the inside.
"""

import logging
from collections.abc import Mapping, Sequence
from http import HTTPStatus
from typing import Any
from uuid import uuid4

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from pydantic import BaseModel, ConfigDict, Field
from starlette.exceptions import HTTPException

from service.api.headers import add_guard_headers
from service.core.errors import (
    BadRequest,
    Conflict,
    InternalError,
    MediaTypeUnsupported,
    MethodNotAllowed,
    NotAllowed,
    NotAuthenticated,
    NotFound,
    ServiceError,
    TooLarge,
    Unavailable,
    Unprocessable,
    ValidationFailed,
)

log = logging.getLogger(__name__)

MEDIA_TYPE = "application/problem+json"
STATUS: Mapping[type[ServiceError], HTTPStatus] = {
    BadRequest: HTTPStatus.BAD_REQUEST,
    NotAuthenticated: HTTPStatus.UNAUTHORIZED,
    NotAllowed: HTTPStatus.FORBIDDEN,
    NotFound: HTTPStatus.NOT_FOUND,
    MethodNotAllowed: HTTPStatus.METHOD_NOT_ALLOWED,
    Conflict: HTTPStatus.CONFLICT,
    TooLarge: HTTPStatus.REQUEST_ENTITY_TOO_LARGE,
    MediaTypeUnsupported: HTTPStatus.UNSUPPORTED_MEDIA_TYPE,
    Unprocessable: HTTPStatus.UNPROCESSABLE_ENTITY,
    InternalError: HTTPStatus.INTERNAL_SERVER_ERROR,
    Unavailable: HTTPStatus.SERVICE_UNAVAILABLE,
}
# What the router and the body limit raise by number.
BY_NUMBER: Mapping[int, tuple[type[ServiceError], str]] = {
    400: (BadRequest, "The body cannot be read. Send the JSON or the form that the documentation shows."),
    404: (NotFound, "There is nothing at this address. The documentation at /api/docs lists the addresses."),
    405: (
        MethodNotAllowed,
        "This address does not take this method. The header Allow names the ones it takes.",
    ),
    413: (TooLarge, "The body is larger than this address accepts."),
}


class FieldError(BaseModel):
    """One invalid field."""

    pointer: str = Field(
        description="Where: a JSON pointer into the body, or the parameter's place and name."
    )
    detail: str


class Problem(BaseModel):
    """A problem document (RFC 9457)."""

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {
                    "type": "/problems/too-few-views",
                    "title": "Too few usable views",
                    "status": 422,
                    "detail": "2 usable views and 3 are needed. Take more images in different poses.",
                    "instance": "/api/v1/runs/019a2b3c-11aa-7bb2-9cc3-44dd55ee66ff/finish",
                    "code": "too-few-views",
                    "facts": {"views_found": 2, "views_needed": 3},
                    "trace_id": "377b51ad50474c82979819fdeb85d92a",
                }
            ]
        }
    )

    type: str = Field(description="Address of the page that explains the code.")
    title: str
    status: int
    detail: str = Field(description="What is wrong and what to do.")
    instance: str = Field(description="The address that was asked.")
    code: str = Field(description="Stable name of the kind of problem.")
    facts: dict[str, Any] = Field(description="Values that a program can use.")
    trace_id: str = Field(description="Find the request in the log by this.")
    errors: list[FieldError] | None = Field(
        default=None, description="Invalid fields, if that is the problem."
    )


def status_of(kind: type[ServiceError]) -> HTTPStatus:
    """Return the status of a kind of error: its own or that of the nearest parent that has one."""
    return next(STATUS[parent] for parent in kind.__mro__ if parent in STATUS)


def problem_body(error: ServiceError) -> dict[str, Any]:
    """Return what a problem document says about an error anywhere, without a request."""
    return {"code": error.code, "title": error.title, "detail": error.detail, "facts": dict(error.facts)}


def answer_problem(
    request: Request, error: ServiceError, errors: Sequence[FieldError] | None = None
) -> JSONResponse:
    """Return the problem document of an error."""
    status = status_of(type(error))
    document = Problem(
        type=f"/problems/{error.code}",
        title=error.title,
        status=status,
        detail=error.detail,
        instance=request.url.path,
        code=error.code,
        facts=dict(error.facts),
        trace_id=trace_id_of(request),
        errors=None if errors is None else list(errors),
    )
    answer = JSONResponse(
        document.model_dump(mode="json", exclude={"errors"} if errors is None else None),
        status_code=status,
        headers={"WWW-Authenticate": "Bearer"} if status is HTTPStatus.UNAUTHORIZED else None,
        media_type=MEDIA_TYPE,
    )
    # Faults are answered outside of all middleware, which would add these otherwise.
    add_guard_headers(answer.headers, request.url.path, trace_id_of(request))
    return answer


def trace_id_of(request: Request) -> str:
    """Return the id under which a request is logged."""
    if not hasattr(request.state, "trace_id"):
        request.state.trace_id = uuid4().hex
    found: str = request.state.trace_id
    return found


def install_problem_handlers(app: FastAPI) -> None:
    """Let the application answer every error with a problem document."""
    app.add_exception_handler(ServiceError, _on_service_error)
    app.add_exception_handler(RequestValidationError, _on_invalid_fields)
    app.add_exception_handler(HTTPException, _on_http_exception)
    app.add_exception_handler(Exception, _on_fault)


def _on_service_error(request: Request, error: Exception) -> JSONResponse:
    known = error if isinstance(error, ServiceError) else InternalError("The service went wrong.")
    return answer_problem(request, known)


def _on_invalid_fields(request: Request, error: Exception) -> JSONResponse:
    found = error.errors() if isinstance(error, RequestValidationError) else []
    errors = [FieldError(pointer=_pointer(one), detail=_message(one)) for one in found]
    where = "; ".join(f"{one.pointer or 'body'}: {one.detail}" for one in errors[:5])
    return answer_problem(request, ValidationFailed(f"Correct these fields and send again. {where}."), errors)


def _on_http_exception(request: Request, error: Exception) -> JSONResponse:
    number = error.status_code if isinstance(error, HTTPException) else 500
    kind, detail = BY_NUMBER.get(number, (InternalError, "The service could not answer this request."))
    answer = answer_problem(request, kind(detail))
    if isinstance(error, HTTPException) and error.headers:
        answer.headers.update(error.headers)
    return answer


def _on_fault(request: Request, error: Exception) -> JSONResponse:
    trace_id = trace_id_of(request)
    log.error("%s %s failed, trace %s", request.method, request.url.path, trace_id, exc_info=error)
    detail = f"This is a fault of the service; it is logged under {trace_id}. Try again, then report it."
    return answer_problem(request, InternalError(detail))


def _pointer(one: Mapping[str, Any]) -> str:
    source, *rest = one["loc"] or ("body",)
    if one["type"] == "json_invalid":
        # The place is a position in the text; there is no document yet to point into.
        return ""
    steps = [str(step).replace("~", "~0").replace("/", "~1") for step in rest]
    return "".join(f"/{step}" for step in steps) if source == "body" else "/".join([str(source), *steps])


def _message(one: Mapping[str, Any]) -> str:
    if one["type"] == "json_invalid":
        return f"is no JSON: {one.get('ctx', {}).get('error', 'syntax error')} at character {one['loc'][-1]}"
    return str(one["msg"]).removeprefix("Value error, ")
