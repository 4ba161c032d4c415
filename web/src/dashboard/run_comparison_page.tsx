// Two runs side by side: verdicts and conditions, parameters, mappings over the image, gates.
import { type JSX } from "preact";
import { useCallback } from "preact/hooks";
import { getRun } from "../api/client";
import { useResource } from "../api/use_resource";
import type { Result, RunDetail } from "../generated/api";
import { Empty, Loading, ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { ComparedCameras } from "./compared_cameras";
import { ComparedConditions } from "./compared_conditions";
import { ComparedGates } from "./compared_gates";
import { addressOf } from "./route";
import { useTitle } from "./use_title";

/** A run, with its result where it has one. */
export type Side = RunDetail;
export interface FinishedSide extends Side {
  result: Result;
}

export const SIDES = ["A", "B"] as const;

export function RunComparisonPage({ a, b }: { a: string; b: string }): JSX.Element {
  const say = words.value;
  useTitle(say.pair_title);
  if (a === "" || b === "") {
    return (
      <Empty title={say.pair_none} detail={say.pair_none_detail}>
        <a href="#/runs">{say.nav_runs}</a>
      </Empty>
    );
  }
  return <Pair a={a} b={b} />;
}

function Pair({ a, b }: { a: string; b: string }): JSX.Element {
  const say = words.value;
  const found = useResource(
    useCallback((signal: AbortSignal) => Promise.all([getRun(a, signal), getRun(b, signal)]), [a, b]),
  );
  if (found.state === "loading") return <Loading />;
  if (found.state === "failed") return <ProblemNotice problem={found.problem} />;
  const sides = found.value;
  return (
    <>
      <div class="page-head">
        <h1>{say.pair_title}</h1>
        <nav class="page-links" aria-label={say.pair_title}>
          <a href={addressOf({ page: "compare", a: b, b: a })}>B ⇄ A</a>
          <a href="#/runs">{say.pair_others}</a>
        </nav>
      </div>
      <ComparedConditions sides={sides} />
      <Compared sides={sides} />
    </>
  );
}

function Compared({ sides: [a, b] }: { sides: [Side, Side] }): JSX.Element {
  const say = words.value;
  if (!isFinished(a) || !isFinished(b)) {
    return (
      <Empty title={say.pair_unfinished(isFinished(a) ? "B" : "A")} detail={say.pair_unfinished_detail} />
    );
  }
  const sizes = [a, b].map(({ result }) => result.image_size.join(" × ")) as [string, string];
  return (
    <>
      {sizes[0] === sizes[1] ? (
        <ComparedCameras a={a} b={b} />
      ) : (
        <p class="notice notice-problem">{say.pair_sizes(...sizes)}</p>
      )}
      <ComparedGates a={a.result.gates} b={b.result.gates} />
    </>
  );
}

function isFinished(side: Side): side is FinishedSide {
  return side.result !== null;
}
