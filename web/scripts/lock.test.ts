import { readFileSync } from "node:fs";
import { expect, it } from "vitest";

it("the lock file names packages by version and hash, and no address", () => {
  const lock = readFileSync(new URL("../package-lock.json", import.meta.url), "utf8");
  expect(lock).not.toMatch(/https?:\/\//);
  expect(lock).toContain('"integrity": "sha512-');
});
