"""The endpoint of the guidance socket: hello, then messages one by one until the client leaves.

Problems are told and the socket goes on; what no client of this protocol sends ends it with a close code.
Not here: what a message leads to (`desk`), and the messages themselves (`protocol`).
"""

import asyncio
import logging
from collections.abc import Callable, Coroutine
from dataclasses import dataclass
from functools import partial
from typing import Any

from anyio import create_task_group, to_thread
from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from service.api.auth import ROLES_FROM, Guides, SocketRoles, check_role
from service.api.ws import protocol
from service.api.ws.board_moves import MoveBoard
from service.api.ws.desk import Desk, Desks
from service.api.ws.drivers import (
    Intake,
    Pace,
    drive_browser,
    drive_camera,
    drive_held,
    drive_virtual,
    watch,
)
from service.api.ws.incoming import FarewellError, read_frame, read_message, receive, to_text
from service.api.ws.link import Link, TooSlowError
from service.api.ws.messages import message_of
from service.core.errors import (
    BadRequest,
    NotAllowed,
    NotAuthenticated,
    ServiceError,
    StateForbids,
    Unavailable,
)
from service.log import logged_with
from service.ports import FrameSourceMaker, HeldSourceMaker
from service.storage.words import FrameOrigin, Role
from service.usecases.access import identify
from service.usecases.guide import Plant
from service.usecases.guide_camera import CameraOpener
from service.usecases.guide_moves import BoardMoves
from service.usecases.guide_runs import StationView, Wish, read_station

HELLO_S = 5.0
MOST_BEFORE_HELLO = 4096
HEAD_BYTES = 65_536  # of a binary message, beside its pixels

router = APIRouter()
log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Guidance:
    """What the composition root hands to the socket."""

    plant: Plant
    desks: Desks
    make_source: FrameSourceMaker
    make_held_source: HeldSourceMaker
    open_camera: CameraOpener
    pace: Pace

    @property
    def most_bytes(self) -> int:
        """Size of the largest binary message."""
        return self.plant.largest_pixels + HEAD_BYTES


@dataclass(frozen=True)
class Visit:
    """A client that was let in: where to, and what its frames and its board's moves wait in."""

    guidance: Guidance
    socket: WebSocket
    station: StationView
    desk: Desk
    link: Link
    intake: Intake
    moves: BoardMoves

    @property
    def is_kiosk(self) -> bool:
        """Whether it may do more than watch."""
        return self.link.role == "kiosk"


@router.websocket("/ws/v1/stations/{code}/guidance")
async def guide(socket: WebSocket, code: str, roles: Guides) -> None:
    """Serve a kiosk or a monitor of a station."""
    guidance: Guidance = socket.app.state.guidance
    await socket.accept()
    with logged_with(station=code):
        try:
            visit = await _welcome(socket, guidance, code, roles)
            async with visit.desk.seat(visit.link, visit.station.origin):
                await _serve(visit)
        except FarewellError as farewell:
            await _say_farewell(socket, farewell)
        except ServiceError as error:
            await _say_farewell(socket, FarewellError(error))
        except TooSlowError:
            log.warning("a client read too slowly and was let go")
            too_slow = Unavailable("This client reads too slowly. Check its network and connect again.")
            await _say_farewell(socket, FarewellError(too_slow))
        except WebSocketDisconnect:
            log.info("a client left")


async def _welcome(socket: WebSocket, guidance: Guidance, code: str, roles: SocketRoles) -> Visit:
    """Return who said hello; raises FarewellError and what says why a client is not let in."""
    plant = guidance.plant
    try:
        async with asyncio.timeout(HELLO_S):
            message = read_message(to_text(await receive(socket, MOST_BEFORE_HELLO)))
    except TimeoutError as error:
        raise FarewellError(
            NotAuthenticated(f"Send `hello` with an API key within {HELLO_S:g} s.")
        ) from error
    if not isinstance(message, protocol.Hello):
        raise FarewellError(NotAuthenticated("The first message is `hello` with an API key."))
    if message.protocol != protocol.PROTOCOL:
        detail = f"This service speaks protocol {protocol.PROTOCOL}. Load the page again."
        raise FarewellError(BadRequest(detail, protocol=protocol.PROTOCOL))
    caller = await to_thread.run_sync(identify, plant.database, message.key, plant.clock.now())
    check_role(caller, roles.kiosk if message.role == "kiosk" else roles.monitor)
    station = await to_thread.run_sync(_read_station, plant, code)
    link = Link(socket, message.role, caller)
    return Visit(guidance, socket, station, guidance.desks.of(code), link, Intake(), BoardMoves())


def _read_station(plant: Plant, code: str) -> StationView:
    with plant.database.read() as session:
        return read_station(session, code)


async def _serve(visit: Visit) -> None:
    """Let a client take part until it leaves; raises what ended it."""
    # Read again: whoever had the seat before may have finished the run meanwhile.
    station = await to_thread.run_sync(_read_station, visit.guidance.plant, visit.station.code)
    visit.link.tell(
        protocol.Welcome(
            protocol=protocol.PROTOCOL,
            station=station.code,
            name=station.name,
            source=station.origin,
            language=station.language,
            role=visit.link.role,
            run_id=visit.desk.session.run.id if visit.desk.session else station.run_id,
            skus=station.skus,
            may_override=visit.is_kiosk and visit.link.caller.role in ROLES_FROM[Role.ENGINEER],
            moves_board=visit.is_kiosk and station.moves_board,
        )
    )
    await _tell_problems(visit, visit.desk.begin(visit.link, station))
    work = [visit.link.send_all(), _read(visit)]
    if visit.is_kiosk:
        work += [watch(visit.desk), _drive(visit)]
    await _until_one_ends(work)


def _drive(visit: Visit) -> Coroutine[Any, Any, None]:
    """Return what brings the frames of the station's source."""
    guidance, station = visit.guidance, visit.station
    if station.moves_board:
        return drive_held(visit.desk, guidance.make_held_source, visit.moves.take)
    if station.origin is FrameOrigin.VIRTUAL:
        return drive_virtual(visit.desk, guidance.make_source, guidance.pace)
    if station.origin is FrameOrigin.BROWSER:
        return drive_browser(visit.desk, visit.intake)
    return drive_camera(visit.desk, partial(guidance.open_camera, station.source))


async def _until_one_ends(work: list[Coroutine[Any, Any, None]]) -> None:
    """Run all at once, end the others with the first one and raise why it ended."""
    reasons: list[Exception] = []
    async with create_task_group() as group:

        async def run(one: Coroutine[Any, Any, None]) -> None:
            try:
                await one
            except (FarewellError, TooSlowError, WebSocketDisconnect, ServiceError) as reason:
                reasons.append(reason)
            # Work in a thread is waited for, so that no capture is stored behind a later session's back.
            group.cancel_scope.cancel()

        for one in work:
            group.start_soon(run, one)
    if reasons:
        raise reasons[0]


async def _read(visit: Visit) -> None:
    while True:
        message = await receive(visit.socket, visit.guidance.most_bytes)
        takes_frames = visit.is_kiosk and visit.station.origin is FrameOrigin.BROWSER
        if isinstance(message, bytes) and takes_frames:
            visit.intake.put(read_frame(message))
        else:
            await _tell_problems(visit, _obey(visit, to_text(message)))


async def _obey(visit: Visit, text: str) -> None:
    message = read_message(text)
    if isinstance(message, protocol.Ack):
        visit.link.acknowledge()
        return
    if not visit.is_kiosk:
        raise NotAllowed("A monitor only watches. Connect as a kiosk to guide.", role="monitor")
    match message:
        case protocol.OpenRun(serial=serial, sku=sku, purpose=purpose):
            await visit.desk.open_run(Wish(serial, sku, purpose), visit.link.caller.name)
        case protocol.NextVehicle():
            await visit.desk.next_vehicle()
        case protocol.Capture(override=True):
            check_role(visit.link.caller, Role.ENGINEER)
            await visit.desk.ask(lambda session: session.capture(is_forced=True))
        case MoveBoard():
            _move_board(visit, message)
        case protocol.Hello():
            raise BadRequest("`hello` is said once.")
        case _:
            await visit.desk.ask(QUESTIONS[type(message)](message))


def _move_board(visit: Visit, message: MoveBoard) -> None:
    if not visit.station.moves_board:
        raise StateForbids(
            "The board of this station is not moved from a screen. Use a station with the source "
            "'virtual:mouse'."
        )
    visit.moves.put(message.to_move())


async def _tell_problems(visit: Visit, work: Coroutine[Any, Any, None]) -> None:
    try:
        await work
    except ServiceError as error:
        visit.link.tell(message_of(error))


async def _say_farewell(socket: WebSocket, farewell: FarewellError) -> None:
    log.info("a client was sent away with %d: %s", farewell.code, farewell.error.detail)
    try:
        await socket.send_text(message_of(farewell.error).model_dump_json())
        await socket.close(farewell.code, farewell.error.code)
    except (WebSocketDisconnect, RuntimeError):
        # It has left by itself; nobody is there to be told.
        return


QUESTIONS: dict[type, Callable[[Any], Callable[[Any], Any]]] = {
    protocol.Capture: lambda _: lambda session: session.capture(),
    protocol.Undo: lambda _: lambda session: session.undo(),
    protocol.Retake: lambda message: lambda session: session.retake(message.pose_index),
    protocol.Abort: lambda _: lambda session: session.abort(),
    protocol.SetAutomatic: lambda message: lambda session: session.set_automatic(message.automatic),
}
