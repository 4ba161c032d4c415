import { expect, it } from "vitest";
import { allParts } from "./all_parts";

it("a list is asked for part after part until its end", async () => {
  const asked: (string | null)[] = [];
  const items = await allParts((cursor) => {
    asked.push(cursor);
    return Promise.resolve(
      cursor === null ? { items: [1, 2], next_cursor: "b" } : { items: [3], next_cursor: null },
    );
  });
  expect(items).toEqual([1, 2, 3]);
  expect(asked).toEqual([null, "b"]);
});

it("a list without end is given up", async () => {
  const items = await allParts(() => Promise.resolve({ items: [0], next_cursor: "again" }));
  expect(items).toHaveLength(20);
});
