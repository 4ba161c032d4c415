"""Every message of the guidance socket, version 1, both ways; docs/guidance-protocol.md tells when each goes.

Text messages are one JSON object told apart by `type`. Binary messages are a 4-byte little-endian length,
that many bytes of JSON (`FrameHeader` from a browser source, `State` from the server) and the picture (grey
bytes row by row, or a JPEG). Points are px of the full-size raw image, (0, 0) the centre of its first pixel.
Not here: the socket itself (`guidance`), and what the values mean (`service.core.guidance`).
"""

from typing import Annotated, Any, Literal
from uuid import UUID

from pydantic import Field

from service.api.shapes import Request
from service.api.ws.board_moves import MoveBoard
from service.api.ws.run_parts import Accuracy, BoardSize, Estimate, Point, PoseAngles, Share, Told, WantedPose
from service.core.quality.gates import Verdict
from service.core.run import Purpose
from service.storage.words import FrameOrigin, Language
from service.usecases.text import Code

PROTOCOL = 1

Sequence = Annotated[int, Field(ge=0, le=2**53, description="Number of a frame, rising within a source.")]
PoseIndex = Annotated[int, Field(ge=0, le=10_000, description="Place in the pose set, from 0.")]
Serial = Annotated[str, Field(max_length=200, description="As scanned; checked by the server.")]
HintCode = Literal[
    "move-left",
    "move-right",
    "move-up",
    "move-down",
    "move-closer",
    "move-away",
    "tilt-top-back",
    "tilt-top-forward",
    "turn-left-back",
    "turn-right-back",
    "rotate-clockwise",
    "rotate-counterclockwise",
    "turn-upside-down",
    "hold-still",
    "hold",
    "show-board",
    "show-whole-board",
    "more-light",
    "less-light",
    "wrong-board",
]

# --- from the kiosk, a monitor or a browser source ---


class Hello(Request):
    """The first message, within 5 s: who asks. A station has one kiosk; monitors only watch."""

    type: Literal["hello"]
    key: str = Field(max_length=200, description="API key: operator at least for a kiosk, viewer to watch.")
    protocol: int = Field(ge=1, description="The version that the client speaks; this service speaks 1.")
    role: Literal["kiosk", "monitor"]


class OpenRun(Request):
    """Calibrate this vehicle. The station's open run of the serial is resumed, else one is opened."""

    type: Literal["open_run"]
    serial: Serial
    sku: Code | None = Field(default=None, description="Null: only resume a run that is open already.")
    purpose: Purpose | None = Field(
        default=None,
        strict=False,
        description="Null: `retest` where the serial has a counted result for this SKU, else `production`. A"
        " virtual station's runs are `simulated`.",
    )


class Capture(Request):
    """Take the picture now, by the same checks as by itself: pose, stillness, sharpness, light, target."""

    type: Literal["capture"]
    override: bool = Field(
        default=False,
        description="Take it though the checks are not met, recorded with what was not; engineers only.",
    )


class Undo(Request):
    """Withdraw the newest capture; its pose is asked for again."""

    type: Literal["undo"]


class Retake(Request):
    """Withdraw a pose's capture, if it has one, and ask for that pose now."""

    type: Literal["retake"]
    pose_index: PoseIndex


class Abort(Request):
    """End the run without a result."""

    type: Literal["abort"]


class NextVehicle(Request):
    """Leave the run that has ended; the station is free for the next serial."""

    type: Literal["next_vehicle"]


class SetAutomatic(Request):
    """Let the station capture by itself, or only when it is told."""

    type: Literal["set_automatic"]
    automatic: bool


class Ack(Request):
    """A picture was drawn: another may be sent. Two may be under way."""

    type: Literal["ack"]
    sequence: Sequence


ClientMessage = Annotated[
    Hello | OpenRun | Capture | Undo | Retake | Abort | NextVehicle | SetAutomatic | MoveBoard | Ack,
    Field(discriminator="type"),
]


class FrameHeader(Request):
    """Head of a browser source's picture; `width`x`height` grey bytes follow it."""

    type: Literal["frame"]
    sequence: Sequence
    width: int = Field(ge=1, le=16_384, description="Of the bytes that follow.")
    height: int = Field(ge=1, le=16_384)
    scale: Literal[1, 2] = Field(description="2: each pixel is the mean of 2x2 of the camera.")
    full: bool = Field(description="Whether this answers `want_full_frame`: the raw frame at scale 1.")
    at_ms: float = Field(ge=0, description="The client's clock; only differences are used.")
    serial: Serial = Field(description="Of the run that the client shows; another run's frames are dropped.")


# --- from the server ---


class Run(Told):
    """The run that the station works on: when it is opened or resumed, after an undo, with a pose more."""

    type: Literal["run"] = "run"
    run_id: UUID
    serial: str
    sku: str
    revision: int
    purpose: Purpose
    image_size: tuple[int, int]
    board: BoardSize
    poses: list[WantedPose]
    captured: list[int] = Field(description="Pose indices with a stored capture.")
    pose_index: int | None = Field(description="The pose asked for now; null: all are captured.")
    automatic: bool
    promised: Accuracy | None = Field(description="What the whole pose set was planned to reach.")
    total: int = Field(description="How many captures the run is to have; without poses that were replaced.")
    accuracy: Accuracy | None = Field(description="So far; null before the captures determine the camera.")
    estimate: Estimate | None = Field(description="The same with all parameters and the mapping error.")


class Welcome(Told):
    """The hello was accepted. A `run` follows when one is resumed."""

    type: Literal["welcome"] = "welcome"
    protocol: int
    station: str
    name: str
    source: FrameOrigin
    language: Language | None = Field(description="That the kiosk starts in; null: its browser's.")
    role: Literal["kiosk", "monitor"]
    run_id: UUID | None
    skus: list[str] = Field(description="Codes that a run can be opened for, newest first.")
    may_override: bool = Field(description="Whether this client's captures may override the checks.")
    moves_board: bool = Field(description="Whether this client moves a virtual board: `move_board`.")


class CaptureAccepted(Told):
    """A capture is stored durably; only now the next pose is asked for."""

    type: Literal["capture_accepted"] = "capture_accepted"
    pose_index: int
    capture_id: UUID
    number: int = Field(description="Order within the run, from 1.")
    captured: list[int]
    total: int
    match_error_px: float | None
    edge_width_px: float | None
    accuracy: Accuracy | None
    estimate: Estimate | None


class CaptureRefused(Told):
    """The picture was not taken, and the pose is asked for again. `code` as in a problem document."""

    type: Literal["capture_refused"] = "capture_refused"
    pose_index: int | None
    code: str
    title: str
    detail: str
    facts: dict[str, Any]


class WantFullFrame(Told):
    """To a browser source: send the raw full-size frame of this number; it was judged fit to keep."""

    type: Literal["want_full_frame"] = "want_full_frame"
    sequence: int


class GateLine(Told):
    """One measurement of the result, with the limit that it met or missed."""

    gate: str
    name: str
    value: float | None
    unit: str
    limit: float | None
    comparison: str
    margin: float | None
    verdict: Verdict
    advice: str
    reason: str | None = Field(description="Code of what `advice` says, for other languages.")
    facts: dict[str, Any] | None = Field(description="What `advice` names besides value and limit.")


class RunVerdict(Told):
    """The result, sent only after it is stored."""

    type: Literal["verdict"] = "verdict"
    run_id: UUID
    serial: str
    verdict: Verdict
    gates: list[GateLine] = Field(description="Failed first, then marginal, then passed.")
    reasons: list[str] = Field(description="What to do, one sentence per gate that did not pass.")
    result: str = Field(description="Address of the whole result.")


class RunClosed(Told):
    """The station has no run any more: it was aborted, or the next vehicle was asked for."""

    type: Literal["run_closed"] = "run_closed"
    run_id: UUID
    reason: Literal["aborted", "next_vehicle"]


class ProblemTold(Told):
    """Something went wrong, in words with what to do; nothing that was accepted is lost."""

    type: Literal["problem"] = "problem"
    code: str
    title: str
    detail: str
    facts: dict[str, Any]


class HintSaid(Told):
    """One instruction; directions are those of the raw image, a mirrored display swaps them."""

    code: HintCode
    amount: Share = Field(description="How far there is to go, coarsely: 1 is far, 0 is nearly there.")


class Ghost(Told):
    """Where the board of the pose asked for would appear."""

    outline: list[Point] = Field(description="The four outer corners, in order round the board.")
    corners: list[Point] = Field(description="All corners, row by row.")


class BoardSeen(Told):
    """The whole board in the picture."""

    outline: list[Point] = Field(description="The four outer corners, in order round the board.")
    corners: list[Point] = Field(description="All corners, row by row.")
    angles: PoseAngles | None = Field(description="Null where no pose explains the corners.")


class Difference(Told):
    """How the board must move in the raw image to reach the pose asked for."""

    right_px: float
    down_px: float
    closer_share: float
    tilt_deg: float
    turn_deg: float
    roll_deg: float
    corner_px: float = Field(description="Mean distance of the four outer corners: the paper's rule.")
    is_upside_down: bool


class CameraTold(Told):
    """How the camera that the service reads keeps up, for engineers."""

    name: str | None = Field(description="What the device calls itself, with its serial if it says so.")
    fps: float | None = Field(description="Frames that it sends in a second; null at first.")
    source_s: float | None = Field(description="When the frame was taken, by the camera's own clock.")
    waited_ms: float = Field(description="From the frame's arrival at the service to this message.")


class State(Told):
    """What the newest judged frame shows, and what to do next; with the picture where the server has it."""

    type: Literal["state"] = "state"
    sequence: int
    at_ms: float
    run_id: UUID
    board: Literal["present", "partial", "absent", "wrong"]
    seen: BoardSeen | None = Field(description="Null unless the whole declared board is present.")
    ghost: Ghost | None = Field(description="Null once all poses are captured.")
    difference: Difference | None
    hints: list[HintSaid] = Field(
        description="Of at most two steps, the first one in front; two shifts in a row are one slanting step."
    )
    match: Share = Field(description="1: within every tolerance.")
    dwell: Share = Field(description="How much of the time that the match must last has passed.")
    pose_index: int | None
    captured: int
    total: int
    automatic: bool
    is_capturing: bool = Field(description="A frame was judged fit and is being stored.")
    accuracy: Accuracy | None
    instead_of: int | None = Field(
        default=None,
        description="The pose that `pose_index` comes before, as it was not reached, or stands in for.",
    )
    tried_s: float = Field(
        default=0.0, description="How long this pose is tried with a board in the picture."
    )
    absent_s: float = Field(default=0.0, description="How long no board has been in the picture; 0 with one.")
    camera: CameraTold | None = Field(default=None, description="Null where the service reads no camera.")
    round_trip_ms: float | None = Field(
        default=None,
        description="Of the newest picture that this client acknowledged, from sending it; null without one.",
    )


ServerMessage = Annotated[
    Welcome
    | Run
    | CaptureAccepted
    | CaptureRefused
    | WantFullFrame
    | RunVerdict
    | RunClosed
    | ProblemTold
    | State,
    Field(discriminator="type"),
]
