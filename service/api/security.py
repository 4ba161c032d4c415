"""What guards every request: no NUL in an address, a trace id in the log, guarding headers in the answer."""

from http import HTTPStatus

from starlette.datastructures import MutableHeaders
from starlette.requests import Request
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from service.api.headers import add_guard_headers
from service.api.problems import MEDIA_TYPE, answer_problem, trace_id_of
from service.core.errors import BadRequest, ServiceError, TooLarge
from service.log import logged_with

TOO_LARGE = (
    "The body is larger than this address accepts. Send one image as the camera delivers it; "
    "whoever runs the service can raise DMSCAL_MAX_UPLOAD_MB."
)


class Guard:
    """Middleware, plain ASGI so that it neither buffers bodies nor changes how errors travel."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer one request."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        request = Request(scope)
        guarded = GuardedSend(request, receive, send)
        with logged_with(trace=trace_id_of(request)):
            # PostgreSQL stores no NUL; no name of anything in this service holds one.
            if "\0" in scope["path"] or b"%00" in scope.get("query_string", b""):
                await guarded.answer(BadRequest("The address holds a NUL character. Send it without."))
            else:
                await self.app(scope, receive, guarded)


class GuardedSend:
    """Sends an answer with the headers that guard it; the body limit's answer becomes a problem document."""

    def __init__(self, request: Request, receive: Receive, send: Send) -> None:
        self.request = request
        self._receive = receive
        self._send = send
        self._is_dropping = False

    async def __call__(self, message: Message) -> None:
        """Send one message of the answer."""
        if message["type"] == "http.response.start":
            headers = MutableHeaders(scope=message)
            is_plain = not headers.get("content-type", "").startswith(MEDIA_TYPE)
            if message["status"] == HTTPStatus.REQUEST_ENTITY_TOO_LARGE and is_plain:
                await self.answer(TooLarge(TOO_LARGE))
                self._is_dropping = True
                return
            add_guard_headers(headers, self.request.url.path, trace_id_of(self.request))
        if not self._is_dropping:
            await self._send(message)

    async def answer(self, error: ServiceError) -> None:
        """Answer with the problem document of an error."""
        await answer_problem(self.request, error)(self.request.scope, self._receive, self)
