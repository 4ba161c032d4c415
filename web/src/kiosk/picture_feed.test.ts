import { describe, expect, it, vi } from "vitest";
import { Underway, type Picture } from "./picture_feed";

interface Watched {
  picture: Picture;
  close: ReturnType<typeof vi.fn>;
}

function watched(): Watched {
  const close = vi.fn();
  return { picture: { close } as unknown as Picture, close };
}

describe("frames under way", () => {
  it("are two at most", () => {
    const underway = new Underway();
    underway.add(1, watched().picture);

    expect(underway.credits).toBe(1);
    underway.add(2, watched().picture);
    expect(underway.credits).toBe(0);
  });

  it("come back as the one that was judged; skipped ones are let go", () => {
    const underway = new Underway();
    const [skipped, judged] = [watched(), watched()];
    underway.add(1, skipped.picture);
    underway.add(2, judged.picture);

    expect(underway.take(2)).toBe(judged.picture);
    expect(skipped.close).toHaveBeenCalledOnce();
    expect(judged.close).not.toHaveBeenCalled();
    expect(underway.credits).toBe(2);
  });

  it("that are newer than the word keep waiting", () => {
    const underway = new Underway();
    underway.add(1, watched().picture);
    const newer = watched();
    underway.add(2, newer.picture);
    underway.take(1);

    expect(newer.close).not.toHaveBeenCalled();
    expect(underway.credits).toBe(1);
  });

  it("are let go together when nobody will answer any more", () => {
    const underway = new Underway();
    const waiting = watched();
    underway.add(1, waiting.picture);
    underway.forget();

    expect(waiting.close).toHaveBeenCalledOnce();
    expect(underway.take(1)).toBeNull();
  });
});
