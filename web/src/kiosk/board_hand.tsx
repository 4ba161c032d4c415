// The hand of whoever practises at a screen: drags over the picture, wheel, fingers and keys move the virtual board.
import { type JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { fit, type Point } from "../drawing/viewport";
import { words } from "../words/language";
import type { Words } from "../words/en";
import { dragMove, graspOf, keyMove, pinchMove, wheelMove, type Grasp, type Move } from "./hand_moves";
import type { Kiosk } from "./kiosk";

interface Finger {
  at: Point;
  grasp: Grasp;
}

type Fingers = Map<number, Finger>;

export function BoardHand({ kiosk }: { kiosk: Kiosk }): JSX.Element {
  const area = useRef<HTMLDivElement>(null);
  const fingers = useRef<Fingers>(new Map());
  const [chosen, setChosen] = useState<Grasp>("shift");
  const say = words.value;
  useMoveKeys(kiosk);
  useWheel(kiosk, area);

  const take = (event: PointerEvent): void => {
    area.current?.setPointerCapture(event.pointerId);
    fingers.current.set(event.pointerId, { at: placeOf(event), grasp: graspOf(event, chosen) });
  };
  const drag = (event: PointerEvent): void => {
    const move = draggedMove(fingers.current, event, scaleOf(kiosk, area.current));
    if (move !== null) kiosk.moveBoard(move);
  };
  const letGo = (event: PointerEvent): void => {
    fingers.current.delete(event.pointerId);
  };
  return (
    <>
      <div
        ref={area}
        class="board-hand"
        role="application"
        aria-label={say.hand_area}
        onPointerDown={take}
        onPointerMove={drag}
        onPointerUp={letGo}
        onPointerCancel={letGo}
        onContextMenu={(event) => event.preventDefault()}
      />
      <HandHelp chosen={chosen} onChosen={setChosen} say={say} />
    </>
  );
}

interface HelpProps {
  chosen: Grasp;
  onChosen: (grasp: Grasp) => void;
  say: Words;
}

function HandHelp({ chosen, onChosen, say }: HelpProps): JSX.Element {
  const grasps: readonly [Grasp, string][] = [
    ["shift", say.hand_shift],
    ["tilt", say.hand_tilt],
    ["roll", say.hand_roll],
  ];
  return (
    <div class="board-hand-help">
      {grasps.map(([grasp, text]) => (
        <button
          key={grasp}
          type="button"
          class="act"
          aria-pressed={chosen === grasp}
          onClick={() => onChosen(grasp)}
        >
          {text}
        </button>
      ))}
      <p>{say.hand_help}</p>
    </div>
  );
}

/** Two fingers pinch, one drags; null where nothing is held. */
function draggedMove(fingers: Fingers, event: PointerEvent, scale: number): Partial<Move> | null {
  const held = fingers.get(event.pointerId);
  if (held === undefined || scale <= 0) return null;
  const before = held.at;
  const after = placeOf(event);
  held.at = after;
  const other = [...fingers].find(([id]) => id !== event.pointerId)?.[1].at;
  if (other !== undefined) return pinchMove([other, before], [other, after], scale);
  return dragMove(held.grasp, { x: after.x - before.x, y: after.y - before.y }, scale);
}

function placeOf({ clientX, clientY }: PointerEvent): Point {
  return { x: clientX, y: clientY };
}

/** Css px per px of the image, as the stage shows it. */
function scaleOf(kiosk: Kiosk, area: HTMLElement | null): number {
  const size = kiosk.state.peek().run?.image_size;
  if (size === undefined || area === null) return 0;
  return fit({ width: size[0], height: size[1] }, { width: area.clientWidth, height: area.clientHeight })
    .scale;
}

function useWheel(kiosk: Kiosk, area: { readonly current: HTMLElement | null }): void {
  useEffect(() => {
    const element = area.current;
    const turn = (event: WheelEvent): void => {
      event.preventDefault();
      kiosk.moveBoard(wheelMove(event));
    };
    // Not passive, so that the page does not scroll instead.
    element?.addEventListener("wheel", turn, { passive: false });
    return () => element?.removeEventListener("wheel", turn);
  }, [kiosk, area]);
}

function useMoveKeys(kiosk: Kiosk): void {
  useEffect(() => {
    const press = (event: KeyboardEvent): void => {
      const isElsewhere = event.ctrlKey || event.altKey || event.metaKey || kiosk.question.value !== null;
      if (isElsewhere || event.target instanceof HTMLInputElement) return;
      const move = keyMove(event.key, event.shiftKey);
      if (move === null) return;
      event.preventDefault();
      // A key that is held repeats as fast as a scanner types.
      if (event.repeat) event.stopPropagation();
      kiosk.moveBoard(move);
    };
    window.addEventListener("keydown", press, { capture: true });
    return () => window.removeEventListener("keydown", press, { capture: true });
  }, [kiosk]);
}
