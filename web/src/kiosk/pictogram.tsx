// One drawing per instruction, beside its words: blue and solid is the board, yellow and dashed is wanted.
import { type JSX } from "preact";
import type { PoseAngles, State } from "../generated/protocol";
import type { Point } from "../drawing/viewport";
import type { HintCode } from "./mirror";
import { sideView, type SideView } from "./side_view";

interface Props {
  code: HintCode;
  /** The other shift of a slanting one. */
  beside: HintCode | null;
  wanted: PoseAngles | null;
  difference: State["difference"];
  dwell: number;
  isMirrored: boolean;
}

export function Pictogram({ code, beside, wanted, difference, dwell, isMirrored }: Props): JSX.Element {
  const view = sideView(code, wanted, difference, isMirrored);
  return (
    <svg class="pictogram" viewBox="0 0 160 120" aria-hidden="true" data-view={view?.view ?? code}>
      {view !== null ? (
        <Side view={view} />
      ) : code === "hold" ? (
        <Hold dwell={dwell} />
      ) : (
        drawingOf(code, beside)
      )}
    </svg>
  );
}

function Side({ view }: { view: SideView }): JSX.Element {
  const { from, to, isClockwise } = view.bend;
  return (
    <>
      {view.view === "side" ? <Camera x={14} y={60} turn={0} /> : <Camera x={80} y={106} turn={-90} />}
      <Line points={view.wanted} class="p-wanted" />
      <Line points={view.present} class="p-seen" />
      <Bend from={from} to={to} isClockwise={isClockwise} radius={49} />
    </>
  );
}

function Line({ points: [a, b], class: name }: { points: [Point, Point]; class: string }): JSX.Element {
  return <line class={name} x1={a.x} y1={a.y} x2={b.x} y2={b.y} />;
}

function Camera({ x, y, turn }: { x: number; y: number; turn: number }): JSX.Element {
  return (
    <path
      class="p-camera"
      transform={`translate(${x} ${y}) rotate(${turn})`}
      d="M-11 -10 H7 V-4 L15 -10 V10 L7 4 V10 H-11 Z"
    />
  );
}

interface BendProps {
  from: Point;
  to: Point;
  isClockwise: boolean;
  radius: number;
}

function Bend({ from, to, isClockwise, radius }: BendProps): JSX.Element {
  return (
    <path
      class="p-move"
      marker-end="url(#p-head)"
      d={`M${from.x} ${from.y} A${radius} ${radius} 0 0 ${isClockwise ? 1 : 0} ${to.x} ${to.y}`}
    />
  );
}

/** The arrow head of all pictograms; once per page. */
export function PictogramHead(): JSX.Element {
  return (
    <svg class="visually-hidden" aria-hidden="true">
      <defs>
        <marker id="p-head" viewBox="-6 -6 12 12" markerWidth="2.7" markerHeight="2.7" orient="auto">
          <path class="p-head" d="M-6 -6 L6 0 L-6 6 Z" />
        </marker>
      </defs>
    </svg>
  );
}

function Hold({ dwell }: { dwell: number }): JSX.Element {
  const round = 2 * Math.PI * 46;
  return (
    <>
      <circle class="p-ring" cx="80" cy="60" r="46" />
      <circle
        class="p-good"
        cx="80"
        cy="60"
        r="46"
        transform="rotate(-90 80 60)"
        stroke-dasharray={`${dwell * round} ${round}`}
      />
      <path class="p-pause" d="M70 42 V78 M90 42 V78" />
    </>
  );
}

function Shift({ x, y }: { x: number; y: number }): JSX.Element {
  const [left, top] = [80 - 34 * x - 20, 60 - 26 * y - 16];
  return (
    <>
      <rect class="p-board" x={left} y={top} width="40" height="32" />
      <path
        class="p-move"
        marker-end="url(#p-head)"
        d={`M${80 - 8 * x} ${60 - 4 * y} l${46 * x} ${40 * y}`}
      />
    </>
  );
}

function Rotate({ sign }: { sign: 1 | -1 }): JSX.Element {
  const [from, to] = [80 - 44 * sign, 80 + 50 * sign];
  return (
    <>
      <rect class="p-board" x="50" y="48" width="60" height="44" transform={`rotate(${-14 * sign} 80 70)`} />
      <path
        class="p-move"
        marker-end="url(#p-head)"
        d={`M${from} 42 A60 60 0 0 ${sign === 1 ? 1 : 0} ${to} 40`}
      />
    </>
  );
}

function Nearness({ isCloser }: { isCloser: boolean }): JSX.Element {
  const [present, wanted] = isCloser ? [0.5, 1] : [1, 0.5];
  const [a, b] = isCloser ? [0.56, 0.86] : [0.94, 0.64];
  return (
    <>
      <Board size={wanted} class="p-wanted" />
      <Board size={present} class="p-board" />
      {[-1, 1].flatMap((x) =>
        [-1, 1].map((y) => (
          <path
            key={`${x}${y}`}
            class="p-move"
            marker-end="url(#p-head)"
            d={`M${80 + 66 * a * x} ${60 + 48 * a * y} L${80 + 66 * b * x} ${60 + 48 * b * y}`}
          />
        )),
      )}
    </>
  );
}

function Board({ size, class: name }: { size: number; class: string }): JSX.Element {
  const [width, height] = [132 * size, 96 * size];
  return <rect class={name} x={80 - width / 2} y={60 - height / 2} width={width} height={height} />;
}

function UpsideDown(): JSX.Element {
  return (
    <>
      <rect class="p-board" x="42" y="36" width="76" height="48" />
      <circle class="p-wanted" cx="54" cy="47" r="7" />
      <circle class="p-dot" cx="106" cy="73" r="7" />
      <path class="p-move" marker-end="url(#p-head)" d="M132 74 A54 54 0 0 1 92 110" />
      <path class="p-move" marker-end="url(#p-head)" d="M28 46 A54 54 0 0 1 68 10" />
    </>
  );
}

const CHESS =
  "M56 42h12v12h-12z M80 42h12v12h-12z M68 54h12v12h-12z M92 54h12v12h-12z M56 66h12v12h-12z M80 66h12v12h-12z";

function Chess({ sign }: { sign: "frame" | "cut" | "cross" }): JSX.Element {
  return (
    <>
      <rect class="p-board" x="50" y="36" width="60" height="48" />
      <path class="p-chess" d={CHESS} />
      {sign === "frame" && (
        <path class="p-corners" d="M24 34 V12 H50 M110 12 H136 V34 M136 86 V108 H110 M50 108 H24 V86" />
      )}
      {sign === "cut" && <path class="p-cut" d="M84 4 V116" />}
      {sign === "cross" && <path class="p-bad" d="M44 24 L116 96 M116 24 L44 96" />}
    </>
  );
}

function Light({ isMore }: { isMore: boolean }): JSX.Element {
  return (
    <>
      <circle class="p-sun" cx="80" cy="60" r="22" />
      <path
        class="p-rays"
        d="M80 14 V26 M80 94 V106 M34 60 H46 M114 60 H126 M47 27 L56 36 M104 84 L113 93 M113 27 L104 36 M56 84 L47 93"
      />
      <path class="p-plus" d={isMore ? "M70 60 H90 M80 50 V70" : "M70 60 H90"} />
    </>
  );
}

function drawingOf(code: HintCode, beside: HintCode | null): JSX.Element {
  const [shift, other] = [SHIFTS[code], beside === null ? undefined : SHIFTS[beside]];
  if (shift !== undefined) return <Shift x={shift.x + (other?.x ?? 0)} y={shift.y + (other?.y ?? 0)} />;
  return DRAWINGS[code] ?? <Hold dwell={0} />;
}

const SHIFTS: Partial<Record<HintCode, Point>> = {
  "move-left": { x: -1, y: 0 },
  "move-right": { x: 1, y: 0 },
  "move-up": { x: 0, y: -1 },
  "move-down": { x: 0, y: 1 },
};

const DRAWINGS: Partial<Record<HintCode, JSX.Element>> = {
  "move-closer": <Nearness isCloser />,
  "move-away": <Nearness isCloser={false} />,
  "rotate-clockwise": <Rotate sign={1} />,
  "rotate-counterclockwise": <Rotate sign={-1} />,
  "turn-upside-down": <UpsideDown />,
  "show-board": <Chess sign="frame" />,
  "show-whole-board": <Chess sign="cut" />,
  "wrong-board": <Chess sign="cross" />,
  "more-light": <Light isMore />,
  "less-light": <Light isMore={false} />,
};
