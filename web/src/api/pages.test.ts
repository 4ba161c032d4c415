import { describe, expect, it } from "vitest";
import { back, FIRST_PAGE, isFirst, onward, shownCursor } from "./pages";
import { runsPath } from "./paths";

describe("walking pages by cursors", () => {
  it("goes on with the next cursor and finds the way back", () => {
    const second = onward(FIRST_PAGE, "a");
    const third = onward(second, "b");
    expect(shownCursor(third)).toBe("b");
    expect(shownCursor(back(third))).toBe("a");
    expect(shownCursor(back(back(third)))).toBeNull();
    expect(isFirst(back(back(third)))).toBe(true);
  });

  it("stays where there is no further page, on both ends", () => {
    expect(onward(FIRST_PAGE, null)).toBe(FIRST_PAGE);
    expect(back(FIRST_PAGE)).toBe(FIRST_PAGE);
  });
});

describe("the address of a list of runs", () => {
  it("leaves out what is not asked for", () => {
    expect(runsPath({ filter: "", cursor: null, limit: 50 })).toBe("/api/v1/runs?limit=50");
  });

  it("keeps the conditions as they are and escapes the cursor", () => {
    const path = runsPath({ filter: "serial=A%26B+1", cursor: "x=", limit: 5 });
    expect(path).toBe("/api/v1/runs?serial=A%26B+1&limit=5&cursor=x%3D");
  });
});
