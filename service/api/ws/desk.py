"""A station at work: its kiosk, its monitors and the run in guidance, all of this one process.

Sessions are asked in a thread, one question at a time; what they tell goes to everybody who listens. Not
here: how a client speaks (`guidance`), and what pushes frames through a session (`drivers`).
"""

import asyncio
from collections.abc import AsyncIterator, Callable, Sequence
from contextlib import asynccontextmanager
from dataclasses import dataclass
from time import monotonic

from anyio import to_thread

from service.api.ws.link import Link
from service.api.ws.messages import message_of, state_message
from service.core.errors import ServiceError, StateForbids
from service.core.guidance.problems import FrameForgotten, KioskLeft, StationHeld
from service.ports import FrameSource, LiveFrame
from service.storage.words import FrameOrigin
from service.usecases.guide import GuidedSession, Plant, open_session, resume_session
from service.usecases.guide_camera import Camera
from service.usecases.guide_frames import Pixels, to_jpeg
from service.usecases.guide_runs import StationView, Wish
from service.usecases.guide_views import ClosedView, StateView, Told, VerdictView, WantedFrame

HANDOVER_S = 2.0  # how long a reloaded page may overlap with itself


@dataclass(frozen=True)
class Looked:
    """What a frame led to, and its picture if anybody could take it."""

    told: list[Told]
    jpeg: bytes | None


class Desk:
    """What happens at one station."""

    def __init__(self, plant: Plant, code: str) -> None:
        self.session: GuidedSession | None = None
        self.source: FrameSource | Camera | None = None
        self.changed = asyncio.Event()
        self.seen_s = monotonic()
        self.wanted: tuple[int, float] | None = None
        self._plant, self._code = plant, code
        self._origin = FrameOrigin.BROWSER
        self._kiosk: Link | None = None
        self._links: set[Link] = set()
        self._verdict: VerdictView | None = None
        self._complaint: str | None = None
        self._lock = asyncio.Lock()
        self._free = asyncio.Event()
        self._free.set()

    @property
    def is_guiding(self) -> bool:
        """Whether a run waits for frames."""
        return self.session is not None and not self.session.is_over

    @property
    def awaits_frames(self) -> bool:
        """Whether frames should be coming; a source in the service takes a while to be made or connected."""
        if isinstance(self.source, Camera) and self.source.is_connecting:
            return False
        return self.is_guiding and (self._origin is FrameOrigin.BROWSER or self.source is not None)

    @property
    def trouble(self) -> ServiceError | None:
        """Why no frames come, where the service reads the camera and knows it."""
        return self.source.trouble if isinstance(self.source, Camera) else None

    async def guided(self) -> GuidedSession:
        """Return the session that waits for frames, once there is one."""
        while (session := self.session) is None or session.is_over:
            self.changed.clear()
            await self.changed.wait()
        return session

    @asynccontextmanager
    async def seat(self, link: Link, origin: FrameOrigin) -> AsyncIterator[None]:
        """Let a client take part until the block ends; raises StationHeld for a second kiosk."""
        if link.role == "kiosk":
            await self._take_seat(link)
            self._origin = origin
        self._links.add(link)
        try:
            yield
        finally:
            self._links.discard(link)
            if self._kiosk is link:
                self._leave()

    async def begin(self, link: Link, station: StationView) -> None:
        """Show a client that was welcomed where the station stands; a kiosk resumes the open run."""
        async with self._lock:
            if self.session is None and link.role == "kiosk" and station.run_id is not None:
                session = await to_thread.run_sync(
                    resume_session, self._plant, station.run_id, link.caller.name
                )
                await self._attach(session)
            elif self.session is not None:
                link.tell(message_of(self.session.show_run()))
                if self._verdict is not None:
                    link.tell(message_of(self._verdict))

    async def open_run(self, wish: Wish, who: str) -> None:
        """Take a serial's run; the one that is guided already is shown again. Raises StateForbids."""
        async with self._lock:
            present = self.session
            if present is not None and present.run.serial == wish.serial.strip(" "):
                self._publish([present.show_run(), *([self._verdict] if self._verdict else [])])
                return
            if present is not None and not present.is_over:
                raise StateForbids(
                    f"Vehicle '{present.run.serial}' is being calibrated here. Finish or abort its run.",
                    serial=present.run.serial,
                )
            session = await to_thread.run_sync(open_session, self._plant, self._code, wish, who)
            await self._attach(session)

    async def next_vehicle(self) -> None:
        """Leave a run that is over; raises StateForbids while it is not."""
        async with self._lock:
            if self.session is None:
                return
            if not self.session.is_over:
                raise StateForbids(
                    "The run is still open. Take the missing poses, or abort it.",
                    run=str(self.session.run.id),
                )
            self._publish([ClosedView(self.session.run.id, "next_vehicle")])

    async def ask(self, question: Callable[[GuidedSession], list[Told]]) -> None:
        """Ask the session something in a thread and publish what it tells.

        Raises StateForbids without a run.
        """
        async with self._lock:
            session = self.session
            if session is None or session.is_over:
                raise StateForbids("There is no open run at this station. Scan a serial first.")
            told = await to_thread.run_sync(question, session)
            await self._follow(session, told)

    async def look(self, next_frame: Callable[[], LiveFrame]) -> None:
        """Let the session see the next frame, taken in the same thread; nothing happens without a run.

        A frame that cannot be used is told, once for all that follow it.
        """
        async with self._lock:
            session = self.session
            if session is None or session.is_over:
                return
            wants_picture = any(link.takes_picture for link in self._links if self._is_shown_to(link))
            try:
                looked = await to_thread.run_sync(_look, session, next_frame, wants_picture)
            except ServiceError as error:
                self._complain_of_frame(error)
            else:
                self._complaint = None
                await self._follow(session, looked.told, looked.jpeg)

    async def keep(self, sequence: int, image: Pixels) -> None:
        """Give the session the full picture that it asked for."""
        self.wanted = None
        await self._answer(lambda session: session.keep(sequence, image))

    async def miss(self, sequence: int) -> None:
        """Tell the session that the full picture did not come."""
        self.wanted = None
        await self._answer(lambda session: session.miss(sequence))

    def take_source(self, session: GuidedSession, source: FrameSource | Camera) -> None:
        """Let a session's full pictures come from a source in the service."""
        if self.session is session:
            self.source, self.seen_s = source, monotonic()

    async def _answer(self, answer: Callable[[GuidedSession], list[Told]]) -> None:
        async with self._lock:
            session = self.session
            if session is not None:
                await self._follow(session, await to_thread.run_sync(answer, session))

    def complain(self, error: ServiceError) -> None:
        """Tell everybody about a problem."""
        self._publish([error])

    def _complain_of_frame(self, error: ServiceError) -> None:
        self.seen_s = monotonic()
        if self._complaint != error.code:
            self._complaint = error.code
            self._publish([error])

    async def _take_seat(self, link: Link) -> None:
        try:
            async with asyncio.timeout(HANDOVER_S):
                while self._kiosk is not None:
                    await self._free.wait()
        except TimeoutError as error:
            raise StationHeld(
                f"Another kiosk works at station '{self._code}'. Close its page first, or choose another "
                "station.",
                station=self._code,
            ) from error
        self._kiosk = link
        self._free.clear()

    def _leave(self) -> None:
        self._kiosk = None
        self._free.set()
        if not self.is_guiding:
            return
        self._clear()
        self._publish(
            [
                KioskLeft(
                    "The kiosk of this station is no longer connected. Nothing that was accepted is lost; "
                    "open its page again to go on.",
                    station=self._code,
                )
            ]
        )

    async def _attach(self, session: GuidedSession) -> None:
        self._clear()
        self.session, self.seen_s = session, monotonic()
        self.changed.set()
        await self._follow(session, await to_thread.run_sync(session.begin))

    def _clear(self) -> None:
        self.session = self.source = self.wanted = self._verdict = None

    async def _follow(self, session: GuidedSession, told: list[Told], jpeg: bytes | None = None) -> None:
        """Publish what was told; a picture that is asked for comes from the source in the service at once."""
        while True:
            self.seen_s = monotonic()
            self._publish(told, jpeg)
            wanted = next((one for one in told if isinstance(one, WantedFrame)), None)
            if wanted is None or self.source is None:
                return
            told = await to_thread.run_sync(_capture, session, self.source, wanted.sequence)

    def _publish(self, told: Sequence[Told], jpeg: bytes | None = None) -> None:
        for one in told:
            if isinstance(one, StateView):
                state = state_message(one)
                for link in self._links:
                    if not self._is_shown_to(link):
                        # It answers a frame of the kiosk's own camera, which waits for it.
                        link.tell(state)
                    elif jpeg is not None:
                        link.show(state, jpeg)
            elif isinstance(one, WantedFrame):
                self._want(one)
            else:
                self._remember(one)
                message = message_of(one)
                for link in self._links:
                    link.tell(message)

    def _remember(self, told: Told) -> None:
        if isinstance(told, VerdictView):
            self._verdict = told
        elif isinstance(told, ClosedView):
            self._clear()

    def _want(self, frame: WantedFrame) -> None:
        if self._origin is FrameOrigin.BROWSER and self._kiosk is not None:
            self.wanted = (frame.sequence, monotonic())
            self._kiosk.tell(message_of(frame))

    def _is_shown_to(self, link: Link) -> bool:
        """Whether a client needs the picture: a kiosk with its own camera has it."""
        return link.role == "monitor" or self._origin is not FrameOrigin.BROWSER


class Desks:
    """The desks of all stations of this process."""

    def __init__(self, plant: Plant) -> None:
        self._plant = plant
        self._desks: dict[str, Desk] = {}

    def of(self, code: str) -> Desk:
        """Return the desk of a station that exists."""
        return self._desks.setdefault(code, Desk(self._plant, code))


def _look(session: GuidedSession, next_frame: Callable[[], LiveFrame], wants_picture: bool) -> Looked:
    frame = next_frame()
    return Looked(session.see(frame), to_jpeg(frame.image) if wants_picture else None)


def _capture(session: GuidedSession, source: FrameSource | Camera, sequence: int) -> list[Told]:
    try:
        image = source.capture(sequence)
    except FrameForgotten:
        return session.miss(sequence)
    facts = source.facts_of(sequence) if isinstance(source, Camera) else {}
    return session.keep(sequence, image, **facts)
