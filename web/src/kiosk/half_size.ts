// Grey pixels of a camera frame: out of its first plane or its green channel, and at half size.

/** Mean of 2x2 pixels, rounded; an odd last row or column is left out. */
export function halfSize(grey: Uint8Array, width: number, height: number): Uint8Array<ArrayBuffer> {
  const columns = width >> 1;
  const rows = height >> 1;
  const half = new Uint8Array(columns * rows);
  for (let row = 0; row < rows; row += 1) {
    let above = 2 * row * width;
    let below = above + width;
    const start = row * columns;
    for (let column = 0; column < columns; column += 1, above += 2, below += 2) {
      half[start + column] =
        ((grey[above] ?? 0) + (grey[above + 1] ?? 0) + (grey[below] ?? 0) + (grey[below + 1] ?? 0) + 2) >> 2;
    }
  }
  return half;
}

/** Rows of `stride` bytes, `step` bytes per pixel, as rows of `width` pixels. */
export function packRows(
  bytes: Uint8Array,
  layout: { offset: number; stride: number; step: number },
  width: number,
  height: number,
): Uint8Array<ArrayBuffer> {
  const { offset, stride, step } = layout;
  const grey = new Uint8Array(width * height);
  for (let row = 0; row < height; row += 1) {
    const from = offset + row * stride;
    if (step === 1) grey.set(bytes.subarray(from, from + width), row * width);
    else
      for (let column = 0; column < width; column += 1)
        grey[row * width + column] = bytes[from + column * step] ?? 0;
  }
  return grey;
}
