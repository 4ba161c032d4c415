import { describe, expect, it } from "vitest";
import type { FrameHeader } from "../generated/protocol";
import { pack, unpack } from "./framed";

const HEAD: FrameHeader = {
  type: "frame",
  sequence: 7,
  width: 2,
  height: 2,
  scale: 2,
  full: false,
  at_ms: 1.5,
  serial: "VIN-Ü",
};

describe("a binary message", () => {
  it("comes back as it was packed, bytes and words", () => {
    const framed = unpack(pack(HEAD, Uint8Array.of(0, 16, 235, 255)));

    expect(framed?.head).toEqual(HEAD);
    expect([...(framed?.picture ?? [])]).toEqual([0, 16, 235, 255]);
  });

  it("has its length first, the low byte before the high one", () => {
    const bytes = new Uint8Array(pack(HEAD, new Uint8Array(0)));

    expect(bytes[0]).toBe(bytes.length - 4);
    expect([...bytes.slice(1, 4)]).toEqual([0, 0, 0]);
  });

  it("is nothing when it is too short, promises too much or holds no JSON", () => {
    expect(unpack(new ArrayBuffer(3))).toBeNull();
    expect(unpack(Uint8Array.of(9, 0, 0, 0, 123).buffer)).toBeNull();
    expect(unpack(Uint8Array.of(2, 0, 0, 0, 123, 123).buffer)).toBeNull();
  });
});
