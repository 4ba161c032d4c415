// Parts of the drawing of poses in space: boards, numbers, the camera with its view, marks of distance. three.js is
// loaded with this module, so pages import it only when they show it.
import {
  BackSide,
  BufferAttribute,
  BufferGeometry,
  CanvasTexture,
  Group,
  Line,
  LineBasicMaterial,
  LineDashedMaterial,
  LineLoop,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  NearestFilter,
  Sprite,
  SpriteMaterial,
  SRGBColorSpace,
  type ColorRepresentation,
  type Texture,
} from "three";
import {
  axisMarks,
  depthOf,
  toDrawing,
  viewAt,
  type SpaceBoard,
  type SpaceScene,
  type Vector,
} from "./space_geometry";

export type Ink = (token: string) => ColorRepresentation;

/** A board that can be picked out. */
export interface BoardParts {
  group: Group;
  face: MeshBasicMaterial;
  back: MeshBasicMaterial;
  edge: LineBasicMaterial;
  label: SpriteMaterial;
}

const SQUARE_PX = 24;
const LABEL_PX = 96;
/** Height of a label, as a share of the picture's height at distance 1. */
const LABEL_SIZE = 0.05;
const FADED = 0.35;

/** The square beyond corner 0, at the top left, is dark. */
export function checkerTexture({ columns, rows }: SpaceScene["squares"]): Texture {
  const canvas = document.createElement("canvas");
  canvas.width = columns * SQUARE_PX;
  canvas.height = rows * SQUARE_PX;
  const context = canvas.getContext("2d");
  if (context !== null) {
    for (let row = 0; row < rows; row += 1) {
      for (let column = 0; column < columns; column += 1) {
        context.fillStyle = (row + column) % 2 === 0 ? "#1c2226" : "#f4f5f5";
        context.fillRect(column * SQUARE_PX, row * SQUARE_PX, SQUARE_PX, SQUARE_PX);
      }
    }
  }
  const texture = new CanvasTexture(canvas);
  texture.magFilter = NearestFilter;
  texture.colorSpace = SRGBColorSpace;
  texture.anisotropy = 4;
  return texture;
}

export function boardOf(board: SpaceBoard, index: number, checker: Texture, ink: Ink): BoardParts {
  const geometry = new BufferGeometry();
  const corners = board.corners.map(toDrawing);
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(corners.flat()), 3));
  geometry.setAttribute("uv", new BufferAttribute(new Float32Array([0, 1, 1, 1, 1, 0, 0, 0]), 2));
  // Anticlockwise as the camera sees the printed side.
  geometry.setIndex([0, 3, 2, 0, 2, 1]);
  const face = new MeshBasicMaterial({ map: checker, transparent: true });
  const back = new MeshBasicMaterial({ color: ink("line-strong"), side: BackSide, transparent: true });
  const edge = new LineBasicMaterial({ color: ink("plot-point") });
  const label = new SpriteMaterial({ depthTest: false, sizeAttenuation: false, transparent: true });
  const sprite = new Sprite(label);
  // At its first corner, as centres of boards lie near each other.
  sprite.position.set(...toDrawing(board.corners[0] ?? [0, 0, 0]));
  sprite.scale.setScalar(LABEL_SIZE);
  const group = new Group();
  group.add(
    new Mesh(geometry, face),
    new Mesh(geometry, back),
    new LineLoop(geometryOf(corners), edge),
    sprite,
  );
  for (const part of group.children) part.userData["index"] = index;
  return { group, face, back, edge, label };
}

/** A board that is picked out stands before all others, solid; the rest let each other through. */
export function showBoard({ group, face, back, edge, label }: BoardParts, isPicked: boolean): void {
  for (const material of [face, back, edge]) material.depthTest = !isPicked;
  for (const material of [face, back]) {
    material.opacity = isPicked ? 1 : FADED;
    material.depthWrite = isPicked;
  }
  for (const part of group.children) {
    const isLabel = "material" in part && part.material === label;
    part.renderOrder = (isPicked ? 4 : 0) + (isLabel ? 3 : 1);
  }
}

/** A number in a circle, as in the picture of the poses in the image. */
export function numberTexture(text: string, ground: string, ink: string): Texture {
  return drawnTexture((context) => {
    const middle = LABEL_PX / 2;
    context.beginPath();
    context.arc(middle, middle, middle - 5, 0, 2 * Math.PI);
    context.fillStyle = ground;
    context.fill();
    context.lineWidth = 5;
    context.strokeStyle = ink;
    context.stroke();
    write(context, text, ink, 50);
  });
}

function wordSprite(text: string, ink: string, at: Vector, size = 1.25): Sprite {
  const map = drawnTexture((context) => write(context, text, ink, 34));
  const sprite = new Sprite(new SpriteMaterial({ map, depthTest: false, sizeAttenuation: false }));
  sprite.position.set(...at);
  sprite.scale.setScalar(LABEL_SIZE * size);
  sprite.renderOrder = 1;
  return sprite;
}

function drawnTexture(draw: (context: CanvasRenderingContext2D) => void): Texture {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = LABEL_PX;
  const context = canvas.getContext("2d");
  if (context !== null) draw(context);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  return texture;
}

function write(context: CanvasRenderingContext2D, text: string, ink: string, px: number): void {
  context.fillStyle = ink;
  context.font = `650 ${px}px ${getComputedStyle(document.body).fontFamily}`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillText(text, LABEL_PX / 2, LABEL_PX / 2 + 3);
}

/** The camera: its axes, and the edges of what it sees up to the farthest board. */
export function cameraOf(scene: SpaceScene, ink: Ink, textInk: string): Group {
  const depth = depthOf(scene.boards);
  const far = viewAt(scene.cornerRays, depth);
  const near = viewAt(scene.cornerRays, 0.12 * depth);
  const origin: Vector = [0, 0, 0];
  const group = new Group();
  const faint = new LineBasicMaterial({ color: ink("line-strong") });
  const strong = new LineBasicMaterial({ color: ink("plot-ring") });
  group.add(new LineSegments(geometryOf(near.flatMap((corner, i) => [corner, far[i] ?? corner])), faint));
  group.add(new LineLoop(geometryOf(far), faint));
  group.add(new LineSegments(geometryOf(near.flatMap((corner) => [origin, corner])), strong));
  group.add(new LineLoop(geometryOf(near), strong));
  const length = 0.17 * depth;
  const axes: [string, Vector][] = [
    ["x", [length, 0, 0]],
    ["y", [0, length, 0]],
    ["z", [0, 0, length]],
  ];
  for (const [name, end] of axes) {
    const tip = toDrawing(end);
    group.add(new Line(geometryOf([origin, tip]), new LineBasicMaterial({ color: ink("ink") })));
    group.add(wordSprite(name, textInk, toDrawing([end[0] * 1.14, end[1] * 1.14, end[2] * 1.14])));
  }
  return group;
}

/** The optical axis with round distances written on it. */
export function distancesOf(
  depth: number,
  ink: Ink,
  textInk: string,
  name: (metres: number) => string,
): Group {
  const group = new Group();
  const dashes = new LineDashedMaterial({ color: ink("plot-axis"), dashSize: 0.015, gapSize: 0.012 });
  const axis = new Line(geometryOf([[0, 0, 0], toDrawing([0, 0, depth])]), dashes);
  axis.computeLineDistances();
  group.add(axis);
  for (const metres of axisMarks(depth)) {
    const tick = 0.012 * depth;
    const ends: Vector[] = [toDrawing([-tick, 0, metres]), toDrawing([tick, 0, metres])];
    group.add(new Line(geometryOf(ends), new LineBasicMaterial({ color: ink("plot-axis") })));
    group.add(wordSprite(name(metres), textInk, toDrawing([0, 3 * tick, metres])));
  }
  return group;
}

function geometryOf(points: readonly Vector[]): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(points.flat()), 3));
  return geometry;
}
