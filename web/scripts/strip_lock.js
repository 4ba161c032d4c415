// Takes the funding addresses out of the lock file, so that it holds versions and hashes and no address at all.
// npm runs this by itself (script "dependencies") whenever it has changed node_modules.
import { readFileSync, writeFileSync } from "node:fs";

const lockFile = new URL("../package-lock.json", import.meta.url);
const before = readFileSync(lockFile, "utf8");
const lock = JSON.parse(before);

for (const entry of Object.values(lock.packages)) delete entry.funding;

const after = `${JSON.stringify(lock, null, 2)}\n`;
if (after !== before) writeFileSync(lockFile, after);
