// A verdict's shape: tick in a circle, mark in a triangle, cross in an octagon. The colour only repeats it.
import { type JSX } from "preact";
import type { RunSummary } from "../generated/api";

export type Standing = "PASS" | "MARGINAL" | "FAIL" | "open" | "aborted" | "finished";

export function standingOf(run: Pick<RunSummary, "verdict" | "state">): Standing {
  return run.verdict ?? run.state;
}

const OUTLINES: Record<Standing, JSX.Element> = {
  PASS: <circle cx="12" cy="12" r="10" />,
  MARGINAL: <path d="M12 2 L23 21.5 H1 Z" stroke-linejoin="round" />,
  FAIL: <path d="M7.9 2 H16.1 L22 7.9 V16.1 L16.1 22 H7.9 L2 16.1 V7.9 Z" stroke-linejoin="round" />,
  open: <circle cx="12" cy="12" r="9.5" stroke-dasharray="3 2.2" fill="none" />,
  aborted: <rect x="3" y="3" width="18" height="18" rx="1" fill="none" />,
  finished: <rect x="3" y="3" width="18" height="18" rx="9" fill="none" />,
};

const SIGNS: Record<Standing, string> = {
  PASS: "M6.8 12.4 L10.5 16 L17.2 8.6",
  MARGINAL: "M12 9 V14.5 M12 17.6 V17.7",
  FAIL: "M8 8 L16 16 M16 8 L8 16",
  open: "M12 7 V12 L15.5 14",
  aborted: "M7.5 12 H16.5",
  finished: "M7.5 12 H16.5",
};

export function VerdictMark({ standing, size }: { standing: Standing; size: number }): JSX.Element {
  const filled = ["PASS", "MARGINAL", "FAIL"].includes(standing);
  return (
    <svg
      class={`mark mark-${standing} ${filled ? "mark-filled" : ""}`}
      width={size}
      height={size}
      viewBox="0 0 24 24"
      aria-hidden="true"
    >
      <g class="mark-outline">{OUTLINES[standing]}</g>
      <path
        class="mark-sign"
        d={SIGNS[standing]}
        fill="none"
        stroke-linecap="round"
        stroke-linejoin="round"
      />
    </svg>
  );
}
