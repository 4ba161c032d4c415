// Binary messages of the guidance socket: 4-byte little-endian length, so many bytes of JSON, then a picture.
import type { FrameHeader } from "../generated/protocol";

const LENGTH_BYTES = 4;

export interface Framed {
  head: unknown;
  picture: Uint8Array<ArrayBuffer>;
}

/** Null when the bytes are no such message. */
export function unpack(message: ArrayBuffer): Framed | null {
  if (message.byteLength < LENGTH_BYTES) return null;
  const length = new DataView(message).getUint32(0, true);
  if (length > message.byteLength - LENGTH_BYTES) return null;
  const text = new TextDecoder().decode(new Uint8Array(message, LENGTH_BYTES, length));
  try {
    return { head: JSON.parse(text) as unknown, picture: new Uint8Array(message, LENGTH_BYTES + length) };
  } catch {
    return null;
  }
}

export function pack(head: FrameHeader, grey: Uint8Array): ArrayBuffer {
  const text = new TextEncoder().encode(JSON.stringify(head));
  const message = new ArrayBuffer(LENGTH_BYTES + text.length + grey.length);
  new DataView(message).setUint32(0, text.length, true);
  new Uint8Array(message, LENGTH_BYTES).set(text);
  new Uint8Array(message, LENGTH_BYTES + text.length).set(grey);
  return message;
}
