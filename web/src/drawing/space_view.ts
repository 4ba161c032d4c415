// Poses in space, drawn by three.js: looked at from any side, a board picked by a pointer. Draws only when something
// changed. Not here: what the parts look like (space_objects) and where they are (space_geometry).
import {
  Color,
  Group,
  PerspectiveCamera,
  Raycaster,
  Scene,
  Vector2,
  WebGLRenderer,
  type Material,
  type Object3D,
  type Texture,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import {
  depthOf,
  orbited,
  standpoint,
  zoomed,
  type SpaceScene,
  type Vector,
  type View,
} from "./space_geometry";
import {
  boardOf,
  cameraOf,
  checkerTexture,
  distancesOf,
  numberTexture,
  showBoard,
  type BoardParts,
} from "./space_objects";

export interface Picked {
  chosen: number;
  hovered: number | null;
}

export interface SpaceOptions {
  scene: SpaceScene;
  colours: (token: string) => string;
  nameDistance: (metres: number) => string;
  onHover: (index: number | null) => void;
  onChoose: (index: number) => void;
  onLost: () => void;
}

const WIDE_ASPECT = 1.5;
const STEP_RAD = Math.PI / 18;
/** A pointer that moved farther turned the view and meant no board. */
const CLICK_PX = 4;

export class SpaceView {
  private readonly renderer: WebGLRenderer;
  private readonly camera = new PerspectiveCamera(42, 1, 0.01, 100);
  private readonly scene = new Scene();
  private readonly controls: OrbitControls;
  private readonly caster = new Raycaster();
  private readonly observer: ResizeObserver;
  private readonly depth: number;
  private content = new Group();
  private boards: BoardParts[] = [];
  private colours: SpaceOptions["colours"];
  private picked: Picked = { chosen: 0, hovered: null };
  private pressedAt = { x: 0, y: 0 };

  /** Throws where the browser has no WebGL. */
  constructor(
    private readonly place: HTMLElement,
    private readonly options: SpaceOptions,
  ) {
    this.renderer = new WebGLRenderer({ antialias: true });
    this.renderer.setPixelRatio(window.devicePixelRatio);
    const canvas = this.renderer.domElement;
    canvas.setAttribute("aria-hidden", "true");
    place.append(canvas);
    this.depth = depthOf(options.scene.boards);
    this.colours = options.colours;
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", this.render);
    canvas.addEventListener("pointermove", this.point);
    canvas.addEventListener("pointerleave", this.leave);
    canvas.addEventListener("pointerdown", this.press);
    canvas.addEventListener("pointerup", this.release);
    canvas.addEventListener("webglcontextlost", options.onLost);
    this.observer = new ResizeObserver(() => this.fit());
    this.build();
    this.fit();
    this.look("oblique");
    this.observer.observe(place);
  }

  look(view: View): void {
    const { from, at } = standpoint(view, this.depth);
    this.controls.target.set(...at);
    // A narrow picture shows less to the sides: then it is looked at from farther away.
    this.moveTo(zoomed(from, at, Math.max(1, WIDE_ASPECT / this.camera.aspect)));
  }

  /** Steps of the keyboard: to the right, upwards. */
  turn(right: number, up: number): void {
    this.moveTo(orbited(this.from, this.at, right * STEP_RAD, up * STEP_RAD));
  }

  zoom(factor: number): void {
    this.moveTo(zoomed(this.from, this.at, factor));
  }

  pick(picked: Picked): void {
    this.picked = picked;
    this.paintBoards();
    this.render();
  }

  recolour(colours: SpaceOptions["colours"]): void {
    this.colours = colours;
    this.build();
    this.render();
  }

  dispose(): void {
    this.observer.disconnect();
    this.controls.dispose();
    release(this.content);
    this.renderer.domElement.removeEventListener("webglcontextlost", this.options.onLost);
    this.renderer.dispose();
    this.renderer.domElement.remove();
  }

  private get from(): Vector {
    return this.camera.position.toArray();
  }

  private get at(): Vector {
    return this.controls.target.toArray();
  }

  private moveTo(from: Vector): void {
    this.camera.position.set(...from);
    this.controls.update();
    this.render();
  }

  private build(): void {
    release(this.content);
    this.scene.remove(this.content);
    const { scene, nameDistance } = this.options;
    const ink = (token: string): Color => new Color(this.colours(token));
    const checker = checkerTexture(scene.squares);
    this.scene.background = ink("sunken");
    this.boards = scene.boards.map((board, i) => boardOf(board, i, checker, ink));
    this.content = new Group();
    this.content.add(
      cameraOf(scene, ink, this.colours("ink")),
      distancesOf(this.depth, ink, this.colours("plot-axis"), nameDistance),
      ...this.boards.map(({ group }) => group),
    );
    this.scene.add(this.content);
    this.paintBoards();
  }

  private paintBoards(): void {
    const { chosen, hovered } = this.picked;
    this.boards.forEach((board, i) => {
      const { edge, label } = board;
      const isChosen = i === chosen;
      const colour = this.colours(isChosen ? "plot-chosen" : "plot-point");
      edge.color.set(colour);
      showBoard(board, isChosen || i === hovered);
      label.map?.dispose();
      const [ground, ink] =
        isChosen || i === hovered ? [colour, this.colours("panel")] : [this.colours("panel"), colour];
      label.map = numberTexture(String(i + 1), ground, ink);
      label.needsUpdate = true;
    });
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.place;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.render();
  }

  private readonly render = (): void => {
    this.renderer.render(this.scene, this.camera);
  };

  private readonly point = (event: PointerEvent): void => {
    if (event.buttons === 0) this.options.onHover(this.boardAt(event));
  };

  private readonly leave = (): void => {
    this.options.onHover(null);
  };

  private readonly press = (event: PointerEvent): void => {
    this.pressedAt = { x: event.clientX, y: event.clientY };
  };

  private readonly release = (event: PointerEvent): void => {
    const moved = Math.hypot(event.clientX - this.pressedAt.x, event.clientY - this.pressedAt.y);
    const found = moved > CLICK_PX ? null : this.boardAt(event);
    if (found !== null) this.options.onChoose(found);
  };

  private boardAt(event: PointerEvent): number | null {
    const box = this.renderer.domElement.getBoundingClientRect();
    const x = (2 * (event.clientX - box.left)) / box.width - 1;
    const y = 1 - (2 * (event.clientY - box.top)) / box.height;
    this.caster.setFromCamera(new Vector2(x, y), this.camera);
    const groups = this.boards.map(({ group }) => group);
    const hit = this.caster.intersectObjects(groups).find(({ object }) => "isMesh" in object);
    const index: unknown = hit?.object.userData["index"];
    return typeof index === "number" ? index : null;
  }
}

/** Gives back what a graphics card holds for a part of the scene. */
function release(part: Object3D): void {
  part.traverse((one) => {
    const { geometry, material } = one as Partial<{ geometry: { dispose: () => void }; material: Material }>;
    geometry?.dispose();
    if (material === undefined) return;
    const { map } = material as Partial<{ map: Texture | null }>;
    map?.dispose();
    material.dispose();
  });
}
