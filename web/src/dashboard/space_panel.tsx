// The poses in space. three.js is loaded when this is shown, and where the browser cannot draw so, words say it.
import { type JSX } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { coloursOf } from "../drawing/drawing";
import { pinholeRays, VIEWS, type SpaceScene, type View } from "../drawing/space_geometry";
import type { SpaceView } from "../drawing/space_view";
import type { PoseSetReview } from "../generated/api";
import { plain } from "../format/numbers";
import { dark } from "../look/theme";
import { words } from "../words/language";

interface Props {
  review: PoseSetReview;
  chosen: number;
  hovered: number | null;
  onChoose: (index: number) => void;
  onHover: (index: number | null) => void;
}

type State = "loading" | "ready" | "none";

export function SpacePanel({ review, chosen, hovered, onChoose, onHover }: Props): JSX.Element {
  const say = words.value;
  const place = useRef<HTMLDivElement>(null);
  const view = useRef<SpaceView | null>(null);
  const [state, setState] = useState<State>("loading");
  const scene = useMemo(() => sceneOf(review), [review]);
  const isDark = dark.value;

  useEffect(() => {
    const { current } = place;
    if (current === null) return undefined;
    let isGone = false;
    const show = async (): Promise<void> => {
      const made = await makeView(current, scene, { onChoose, onHover, onLost: () => setState("none") });
      if (isGone) made?.dispose();
      else {
        view.current = made;
        setState(made === null ? "none" : "ready");
      }
    };
    void show();
    return () => {
      isGone = true;
      view.current?.dispose();
      view.current = null;
    };
  }, [scene, onChoose, onHover]);

  useEffect(() => {
    view.current?.pick({ chosen, hovered });
  }, [chosen, hovered, state]);

  useEffect(() => {
    if (place.current !== null) view.current?.recolour(coloursOf(place.current));
  }, [isDark]);

  return (
    <section class="panel space-panel" aria-labelledby="space-title">
      <div class="panel-head">
        <h2 id="space-title">{say.review_in_space}</h2>
        {state === "ready" && <ViewButtons onLook={(from) => view.current?.look(from)} />}
      </div>
      <figure class="field-figure">
        {state === "ready" && <figcaption class="muted key">{say.space_keys}</figcaption>}
        {state === "loading" && <p class="muted">{say.space_loading}</p>}
        {state === "none" && (
          <div class="notice notice-empty">
            <strong>{say.space_none}</strong>
            <p>{say.space_none_detail}</p>
          </div>
        )}
        <div
          ref={place}
          class="space"
          hidden={state === "none"}
          role="img"
          tabIndex={0}
          aria-label={say.space_label(review.poses.length, chosen + 1)}
          onKeyDown={(event) => {
            if (view.current !== null && steer(view.current, event.key)) event.preventDefault();
          }}
        />
      </figure>
    </section>
  );
}

function ViewButtons({ onLook }: { onLook: (from: View) => void }): JSX.Element {
  const say = words.value;
  const names = {
    oblique: say.space_oblique,
    camera: say.space_camera,
    side: say.space_side,
    above: say.space_above,
  };
  return (
    <span class="choice">
      {say.space_views}
      <span class="space-views">
        {VIEWS.map((from) => (
          <button key={from} type="button" onClick={() => onLook(from)}>
            {names[from]}
          </button>
        ))}
      </span>
    </span>
  );
}

function sceneOf({ poses, target, corner_rays, nominal, image_size }: PoseSetReview): SpaceScene {
  return {
    boards: poses.map(({ plate_corners_m }) => ({ corners: plate_corners_m })),
    squares: { columns: target.columns + 1, rows: target.rows + 1 },
    cornerRays: corner_rays ?? pinholeRays(nominal, image_size),
  };
}

interface Heard {
  onChoose: (index: number) => void;
  onHover: (index: number | null) => void;
  onLost: () => void;
}

/** Null where there is no WebGL, or the drawing cannot be loaded. */
async function makeView(place: HTMLElement, scene: SpaceScene, heard: Heard): Promise<SpaceView | null> {
  if (!hasWebGl()) return null;
  try {
    const { SpaceView: Made } = await import("../drawing/space_view");
    return new Made(place, {
      scene,
      ...heard,
      colours: coloursOf(place),
      nameDistance: (metres) => `${plain(metres)} m`,
    });
  } catch {
    return null;
  }
}

/** Asked before three.js is loaded, which would log an error of its own. */
function hasWebGl(): boolean {
  const context = document.createElement("canvas").getContext("webgl2");
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return context !== null;
}

const ZOOM = 1.15;

/** Whether a key was one of the drawing's. */
function steer(view: SpaceView, key: string): boolean {
  switch (key) {
    case "ArrowLeft":
      view.turn(-1, 0);
      return true;
    case "ArrowRight":
      view.turn(1, 0);
      return true;
    case "ArrowUp":
      view.turn(0, 1);
      return true;
    case "ArrowDown":
      view.turn(0, -1);
      return true;
    case "+":
      view.zoom(1 / ZOOM);
      return true;
    case "-":
      view.zoom(ZOOM);
      return true;
    case "Home":
      view.look("oblique");
      return true;
    default:
      return false;
  }
}
