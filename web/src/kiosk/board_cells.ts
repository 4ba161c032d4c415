// What is filled of the wanted board, and the place that tells its two orientations apart. Pure.
import type { Run } from "../generated/protocol";
import type { Point } from "../drawing/viewport";
import { centreOf } from "./arrows";

type Board = Run["board"];

const RIM_POINTS = 20;

/** Light squares of a chessboard or its like, or the dots of a grid of circles, as polygons. */
export function cellsOf(corners: readonly Point[], board: Board): Point[][] {
  return board.dot_steps === null ? lightSquares(corners, board) : dots(corners, board, board.dot_steps);
}

/** Middle of the square at corner 0, or the first dot. */
export function firstCell(corners: readonly Point[], { columns, dot_steps }: Board): Point | null {
  if (dot_steps !== null) return corners[0] ?? null;
  const square = [0, 1, columns, columns + 1].flatMap((i) => corners[i] ?? []);
  return square.length === 4 ? centreOf(square) : null;
}

/** The square inside of corner 0 is dark, as the one outside of it, so light ones have an odd sum of places. */
function lightSquares(corners: readonly Point[], { columns, rows }: Board): Point[][] {
  const squares: Point[][] = [];
  for (let row = 0; row + 1 < rows; row += 1) {
    for (let column = 0; column + 1 < columns; column += 1) {
      if ((row + column) % 2 === 0) continue;
      const i = row * columns + column;
      squares.push([i, i + 1, i + columns + 1, i + columns].flatMap((at) => corners[at] ?? []));
    }
  }
  return squares;
}

/** Next dots of a row are two steps apart, and so are dots two rows apart: how long a step is there. */
function dots(corners: readonly Point[], { columns, rows }: Board, diameter: number): Point[][] {
  return corners.map((centre, i) => {
    const across = stepAt(corners, i, (i % columns) + 1 < columns ? 1 : -1);
    const down = stepAt(corners, i, Math.floor(i / columns) + 2 < rows ? 2 * columns : -2 * columns);
    return Array.from({ length: RIM_POINTS }, (_, k) => {
      const angle = (2 * Math.PI * k) / RIM_POINTS;
      const [u, v] = [0.5 * diameter * Math.cos(angle), 0.5 * diameter * Math.sin(angle)];
      return { x: centre.x + u * across.x + v * down.x, y: centre.y + u * across.y + v * down.y };
    });
  });
}

function stepAt(corners: readonly Point[], i: number, away: number): Point {
  const [here, there] = [corners[i], corners[i + away]];
  if (here === undefined || there === undefined) return { x: 0, y: 0 };
  const sign = Math.sign(away);
  return { x: (sign * (there.x - here.x)) / 2, y: (sign * (there.y - here.y)) / 2 };
}
