// A camera and an operator inside the kiosk's page. The camera replaces getUserMedia: it draws the board at its
// present pose through the true lens, as raw I420 frames. The operator holds the board and obeys only what the
// kiosk says: the instruction that the page shows, at a pace by the coarse amount that comes with it; it knows no
// pose, no picture and no number of the service. `window.reactive` is set before, by the test:
//   camera {width, height, fx, fy, cx, cy, k1, k2, p1, p2, k3}, board {columns, rows, square_m},
//   start {centre, upside_down}, swapped (hints that it reads as the other one), stubborn (it never moves);
//   later the test may set: paused (no frames come), gone (the camera is unplugged); and it may read lived_s (for
//   how long the operator acted: on a busy computer less than the clock says).
// Axes as in the core: x right, y down, z away. Not here: what a run must come to.
"use strict";
(() => {
  const { camera, board, start, swapped = {}, stubborn = false } = window.reactive;
  const { width, height } = camera;
  window.reactive.lived_s = 0;

  // --- the lens: for each pixel its ray on the ideal plane, and how the ray changes from pixel to pixel ---

  function distorted(x, y) {
    const r2 = x * x + y * y;
    const radial = 1 + r2 * (camera.k1 + r2 * (camera.k2 + r2 * camera.k3));
    return [
      x * radial + 2 * camera.p1 * x * y + camera.p2 * (r2 + 2 * x * x),
      y * radial + camera.p1 * (r2 + 2 * y * y) + 2 * camera.p2 * x * y,
    ];
  }

  function rayOf(u, v) {
    const wanted = [(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy];
    let [x, y] = wanted;
    for (let i = 0; i < 40; i += 1) {
      const [dx, dy] = distorted(x, y);
      x += wanted[0] - dx;
      y += wanted[1] - dy;
    }
    return [x, y];
  }

  const rays = new Float64Array(2 * width * height);
  for (let v = 0, at = 0; v < height; v += 1) for (let u = 0; u < width; u += 1, at += 2) rays.set(rayOf(u, v), at);

  // --- the picture: squares with edges as wide as a sharp lens makes them, and a little noise ---

  const EDGE_PX = 0.9; // half the width of an edge
  const WHITE = 205;
  const BLACK = 35;
  const MARGIN = 1; // of the plate round the pattern, squares
  const noise = new Float32Array(65_536);
  let seed = 7;
  const random = () => (seed = (seed * 1_103_515_245 + 12_345) % 2_147_483_648) / 2_147_483_648;
  for (let i = 0; i < noise.length; i += 1) noise[i] = 1.7 * (random() + random() + random() + random() - 2);

  const ramp = (px) => Math.max(-1, Math.min(1, px / EDGE_PX));

  /** +1 in squares of even number, −1 in odd ones, between them a ramp as wide as the lens makes it. */
  function stripes(x, px, last) {
    const cell = Math.max(-1, Math.min(last - 1, Math.floor(x)));
    const line = Math.round(x);
    const sign = cell % 2 === 0 ? 1 : -1;
    if (line < 0 || line > last - 1) return sign;
    return (line % 2 === 0 ? 1 : -1) * ramp((x - line) / px);
  }

  /** Share of a pixel that lies between two lines. */
  const within = (x, low, high, px) => (0.5 + 0.5 * ramp((x - low) / px)) * (0.5 + 0.5 * ramp((high - x) / px));

  function draw({ R, centre }, grey) {
    const inverse = boardFromRay(R, centre);
    const [[au, av, aw], [bu, bv, bw], [cu, cv, cw]] = inverse;
    const [lastU, lastV] = [board.columns, board.rows];
    const isFront = R[0][2] * centre[0] + R[1][2] * centre[1] + R[2][2] * centre[2] > 0;
    const offset = Math.floor(random() * noise.length);
    for (let at = 0; at < width * height; at += 1) {
      const [x, y] = [rays[2 * at], rays[2 * at + 1]];
      const c = cu * x + cv * y + cw;
      const u = (au * x + av * y + aw) / c;
      const v = (bu * x + bv * y + bw) / c;
      const wall = 90 + (30 * at) / (width * height);
      let level = wall;
      if (c > 0 && u > -3 && v > -3 && u < lastU + 2 && v < lastV + 2) {
        const pu = perPixel(inverse[0], inverse[2], at, u, c);
        const pv = perPixel(inverse[1], inverse[2], at, v, c);
        const plate = within(u, -1 - MARGIN, lastU + MARGIN, pu) * within(v, -1 - MARGIN, lastV + MARGIN, pv);
        const pattern = isFront ? within(u, -1, lastU, pu) * within(v, -1, lastV, pv) : 0;
        const dark = pattern * (0.5 + 0.5 * stripes(u, pu, lastU) * stripes(v, pv, lastV));
        level += plate * (WHITE + dark * (BLACK - WHITE) - wall);
      }
      grey[at] = level + noise[(at * 7 + offset) & 65_535];
    }
  }

  /** By how many squares a board coordinate changes from one pixel to the next, across its lines. */
  function perPixel(row, last, at, value, c) {
    const right = at % width < width - 1 ? at + 1 : at - 1;
    const below = at < width * (height - 1) ? at + width : at - width;
    const gx = (row[0] - value * last[0]) / c;
    const gy = (row[1] - value * last[1]) / c;
    const [x, y] = [rays[2 * at], rays[2 * at + 1]];
    return Math.hypot(
      gx * (rays[2 * right] - x) + gy * (rays[2 * right + 1] - y),
      gx * (rays[2 * below] - x) + gy * (rays[2 * below + 1] - y),
    );
  }

  /** Rows that take (x, y, 1) of the ideal plane to (u, v, 1) / depth; u, v in squares from corner 0. */
  function boardFromRay(R, centre) {
    const half = [(board.columns - 1) / 2, (board.rows - 1) / 2];
    const s = board.square_m;
    const corner = [0, 1, 2].map((i) => centre[i] - s * (R[i][0] * half[0] + R[i][1] * half[1]));
    const m = [0, 1, 2].map((i) => [s * R[i][0], s * R[i][1], corner[i]]);
    const minor = (i, j) => {
      const [a, b] = [(i + 1) % 3, (i + 2) % 3];
      const [c, d] = [(j + 1) % 3, (j + 2) % 3];
      return m[a][c] * m[b][d] - m[a][d] * m[b][c];
    };
    const det = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
    return [0, 1, 2].map((i) => [0, 1, 2].map((j) => minor(j, i) / det));
  }

  // --- the hand ---

  const REACTION_S = 0.12;
  const SPEED_M_S = 0.4;
  const TURN_RAD_S = 2.5;
  const FLIP_S = 0.6;
  const AXES = {
    "move-right": [0, 1],
    "move-left": [0, -1],
    "move-down": [1, 1],
    "move-up": [1, -1],
    "move-closer": [2, 1],
    "move-away": [2, -1],
    "tilt-top-forward": [3, 1],
    "tilt-top-back": [3, -1],
    "turn-left-back": [4, 1],
    "turn-right-back": [4, -1],
    "rotate-clockwise": [5, 1],
    "rotate-counterclockwise": [5, -1],
  };
  const pose = { R: rotation([0, 0, start.upside_down ? Math.PI : 0]), centre: [...start.centre] };
  const care = [1, 1, 1, 1, 1, 1]; // less on an axis whose hint turned round: that was too far
  const sense = [0, 0, 0, 0, 0, 0];
  const amounts = new Map(); // of the hints that came last: how far there is to go, coarsely
  let heard = []; // what the page showed, until it reaches the hand
  let obeyed = [];
  let flipping_s = 0;

  function rotation([x, y, z]) {
    const angle = Math.hypot(x, y, z);
    if (angle < 1e-12) return [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    const [a, b, c] = [x / angle, y / angle, z / angle];
    const [s, k] = [Math.sin(angle), 1 - Math.cos(angle)];
    return [
      [1 - k * (b * b + c * c), k * a * b - s * c, k * a * c + s * b],
      [k * a * b + s * c, 1 - k * (a * a + c * c), k * b * c - s * a],
      [k * a * c - s * b, k * b * c + s * a, 1 - k * (a * a + b * b)],
    ];
  }

  const product = (A, B) => A.map((row) => [0, 1, 2].map((j) => row[0] * B[0][j] + row[1] * B[1][j] + row[2] * B[2][j]));

  /** Right, down, closer along the line of sight, m; turns about the camera's axes, rad. */
  function move(way) {
    const { centre } = pose;
    const far = Math.hypot(...centre);
    const sight = centre.map((part) => part / far);
    pose.centre = centre.map((part, i) => part + (i < 2 ? way[i] : 0) - way[2] * sight[i]);
    pose.centre[2] = Math.max(0.12, pose.centre[2]);
    pose.R = product(rotation(way.slice(3)), pose.R);
  }

  function live(now_s, dt_s) {
    const strip = document.querySelector(".strip");
    const step = [strip?.dataset.hint, strip?.dataset.beside].filter((code) => code !== undefined);
    const told = step.map((shown) => ({ code: swapped[shown] ?? shown, amount: amounts.get(shown) ?? 1 }));
    heard.push({ at_s: now_s + REACTION_S, told });
    while (heard.length > 0 && heard[0].at_s <= now_s) obeyed = heard.shift().told;
    if (flipping_s > 0) {
      flipping_s -= dt_s;
      move([0, 0, 0, 0, 0, (Math.PI * dt_s) / FLIP_S]);
      if (flipping_s <= 0) [heard, obeyed] = [[], []];
    } else for (const hint of obeyed) obey(hint, dt_s);
    tremble();
  }

  function obey({ code, amount }, dt_s) {
    if (stubborn) return;
    if (code === "turn-upside-down") flipping_s = FLIP_S;
    if (code === "show-board" || code === "show-whole-board") goHome(code === "show-board" ? 1 : 0.3, dt_s);
    if (!(code in AXES)) return;
    const [axis, way] = AXES[code];
    care[axis] = way === -sense[axis] ? Math.max(0.15, 0.5 * care[axis]) : Math.min(1, care[axis] * 2 ** (dt_s / 1.5));
    sense[axis] = way;
    const pace = way * care[axis] * amount ** 0.6 * (axis < 3 ? SPEED_M_S : TURN_RAD_S) * dt_s;
    move([0, 1, 2, 3, 4, 5].map((i) => (i === axis ? pace : 0)));
  }

  /** Back before the camera, where the operator began, with the board's face to it. */
  function goHome(share, dt_s) {
    const way = start.centre.map((part, i) => part - pose.centre[i]);
    const step = Math.min(1, (share * SPEED_M_S * dt_s) / Math.max(1e-9, Math.hypot(...way)));
    pose.centre = pose.centre.map((part, i) => part + step * way[i]);
    const [nx, ny] = [pose.R[0][2], pose.R[1][2]];
    if (share === 1) move([0, 0, 0, 2 * ny * dt_s, -2 * nx * dt_s, 0]);
  }

  function tremble() {
    const shake = () => 0.0003 * (random() - 0.5);
    move([shake(), shake(), shake(), 2 * shake(), 2 * shake(), 2 * shake()]);
  }

  // --- into the page ---

  const PlainSocket = window.WebSocket;
  window.WebSocket = class extends PlainSocket {
    constructor(...address) {
      super(...address);
      this.addEventListener("message", ({ data }) => {
        const message = typeof data === "string" ? JSON.parse(data) : {};
        for (const { code, amount } of message.hints ?? []) amounts.set(code, amount);
      });
    }
  };

  const FRAME_MS = 66;
  const LONGEST_STEP_S = 0.1; // a busy machine makes the hand slow, never wild

  function film(track) {
    const writer = track.writable.getWriter();
    const pixels = new Uint8ClampedArray((width * height * 3) / 2).fill(128);
    let before_ms = performance.now();
    const tick = async () => {
      const now_ms = performance.now();
      const dt_s = Math.min(LONGEST_STEP_S, (now_ms - before_ms) / 1000);
      live(now_ms / 1000, dt_s);
      window.reactive.lived_s += dt_s;
      before_ms = now_ms;
      if (track.readyState === "ended") return;
      if (window.reactive.gone) {
        await writer.close();
        return;
      }
      if (!window.reactive.paused) {
        draw(pose, pixels);
        const shape = { format: "I420", codedWidth: width, codedHeight: height, timestamp: 1000 * now_ms };
        await writer.write(new VideoFrame(pixels, shape));
      }
      setTimeout(tick, Math.max(0, FRAME_MS - (performance.now() - now_ms)));
    };
    void tick();
  }

  navigator.mediaDevices.getUserMedia = async () => {
    const track = new MediaStreamTrackGenerator({ kind: "video" });
    film(track);
    return new MediaStream([track]);
  };
})();
