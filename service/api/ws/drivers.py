"""What pushes frames through a station's session, and what notices that none come.

Each runs as long as the station's kiosk is connected. Not here: what a frame leads to (`desk`).
"""

import asyncio
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from time import monotonic

from anyio import to_thread

from service.api.ws.desk import Desk
from service.core.guidance.problems import SourceStalled
from service.ports import BoardMove, FrameSourceMaker, HeldSourceMaker, LiveFrame
from service.usecases.guide_camera import Camera
from service.usecases.guide_frames import RawFrame

STALLED_S = 1.5  # with the time between two looks, it is told within 2 s
FULL_FRAME_S = 3.0
WATCH_S = 0.25
FRAME_WAIT_S = 0.25
HELD_FRAME_S = 0.04  # between two frames of a board that a person moves, where the machine is fast enough
LONGEST_STEP_S = 0.2  # after a longer pause, time goes on as if there had been none


@dataclass(frozen=True)
class Pace:
    """How fast a virtual station lives: its frames per second, and seconds of its own in one of ours."""

    frames_per_s: float = 15.0
    speed: float = 1.0

    @property
    def frame_s(self) -> float:
        """Time between two frames, in the station's own seconds."""
        return 1.0 / self.frames_per_s


@dataclass(frozen=True)
class BrowserFrame:
    """A frame from a kiosk's own camera: whose vehicle it shows, and whether it was asked for in full."""

    frame: RawFrame
    serial: str
    full: bool


class Intake:
    """Frames that a kiosk sent: of live ones only the newest waits, one that was asked for is kept."""

    def __init__(self) -> None:
        self._live: BrowserFrame | None = None
        self._full: BrowserFrame | None = None
        self._something = asyncio.Event()

    def put(self, frame: BrowserFrame) -> None:
        """Take a frame in."""
        if frame.full:
            self._full = frame
        else:
            self._live = frame
        self._something.set()

    async def get(self) -> BrowserFrame:
        """Return the frame that is due, when there is one."""
        while (frame := self._full or self._live) is None:
            self._something.clear()
            await self._something.wait()
        if frame.full:
            self._full = None
        else:
            self._live = None
        return frame


async def drive_virtual(desk: Desk, make: FrameSourceMaker, pace: Pace) -> None:
    """Pull frames from the simulator for every run that is guided, until cancelled."""
    while True:
        session = await desk.guided()
        revision = session.run.revision
        source = await to_thread.run_sync(make, revision.intrinsics, revision.target, session.run.serial)
        desk.take_source(session, source)
        while desk.session is session and not session.is_over:
            due = monotonic() + pace.frame_s / pace.speed
            await desk.look(partial(source.next_frame, session.hints, pace.frame_s))
            await asyncio.sleep(max(0.0, due - monotonic()))


async def drive_held(desk: Desk, make: HeldSourceMaker, take_move: Callable[[], BoardMove | None]) -> None:
    """Draw a board that a person moves, in real time and as often as it can be shown, until cancelled."""
    while True:
        session = await desk.guided()
        revision = session.run.revision
        source = await to_thread.run_sync(
            make, revision.intrinsics, revision.target, session.run.serial, take_move
        )
        desk.take_source(session, source)
        before_s = monotonic() - HELD_FRAME_S
        while desk.session is session and not session.is_over:
            now_s = monotonic()
            step_s, before_s = min(now_s - before_s, LONGEST_STEP_S), now_s
            await desk.look(partial(source.next_frame, session.hints, step_s))
            await asyncio.sleep(max(0.0, now_s + HELD_FRAME_S - monotonic()))


async def drive_camera(desk: Desk, open_camera: Callable[[tuple[int, int]], Camera]) -> None:
    """Hand the newest frame of a camera on, as fast as they can be judged, until cancelled.

    The camera stays open between runs, so that the next one begins with a picture.
    """
    camera, size = None, None
    try:
        while True:
            session = await desk.guided()
            wanted = session.run.revision.intrinsics.image_size
            if camera is not None and size != wanted:
                camera.close()
            if camera is None or size != wanted:
                camera, size = open_camera(wanted), wanted
            desk.take_source(session, camera)
            while desk.session is session and not session.is_over:
                frame = await to_thread.run_sync(camera.next_frame, FRAME_WAIT_S)
                if frame is not None:
                    await desk.look(partial(_itself, frame))
    finally:
        if camera is not None:
            camera.close()


async def drive_browser(desk: Desk, intake: Intake) -> None:
    """Hand the kiosk's frames on as fast as they can be judged, until cancelled."""
    while True:
        given = await intake.get()
        session = desk.session
        if session is None or session.is_over or given.serial != session.run.serial:
            continue
        if given.full:
            await desk.keep(given.frame.sequence, given.frame.image)
        else:
            await desk.look(partial(_itself, given.frame))


async def watch(desk: Desk) -> None:
    """Say when no frames come, and give up on a full frame that does not, until cancelled."""
    told_of: tuple[float, str] | None = None
    while True:
        await asyncio.sleep(WATCH_S)
        now, seen_s = monotonic(), desk.seen_s
        if desk.wanted is not None and now - desk.wanted[1] > FULL_FRAME_S:
            await desk.miss(desk.wanted[0])
        if desk.awaits_frames and now - seen_s > STALLED_S:
            error = desk.trouble or _stalled()
            if told_of != (seen_s, error.code):
                told_of = seen_s, error.code
                desk.complain(error)


def _stalled() -> SourceStalled:
    return SourceStalled(
        f"No picture has come from the camera for {STALLED_S:g} s. Check its cable and power; guidance goes "
        "on by itself with the next picture.",
        seconds=STALLED_S,
    )


def _itself(frame: LiveFrame) -> LiveFrame:
    return frame
