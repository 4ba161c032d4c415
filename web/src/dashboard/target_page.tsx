// One target: what it looks like, its sheet to print, and showing it on a screen at true size.
import { type JSX } from "preact";
import { useCallback } from "preact/hooks";
import { getPattern } from "../api/client";
import { useResource } from "../api/use_resource";
import { Drawing, type Draw } from "../drawing/drawing";
import { drawPattern, neededSize, placePattern } from "../drawing/target_drawing";
import { plain, withUnit } from "../format/numbers";
import type { TargetPattern } from "../generated/api";
import { Loading, ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { Facts } from "./facts";
import { addressOf } from "./route";
import { ScreenPanel } from "./screen_panel";
import { SheetPanel } from "./sheet_panel";
import { squareName } from "./target_words";
import { useTitle } from "./use_title";

export function TargetPage({ spec }: { spec: string }): JSX.Element {
  const say = words.value;
  useTitle(spec);
  const found = useResource(useCallback((signal: AbortSignal) => getPattern(spec, signal), [spec]));
  return (
    <>
      <div class="page-head">
        <h1>{found.state === "ready" ? found.value.spec : spec}</h1>
        <nav class="page-links" aria-label={say.targets_title}>
          <a href={addressOf({ page: "targets" })}>{say.targets_title}</a>
        </nav>
      </div>
      {found.state === "loading" && <Loading />}
      {found.state === "failed" && <ProblemNotice problem={found.problem} />}
      {found.state === "ready" && <Panels pattern={found.value} />}
    </>
  );
}

function Panels({ pattern }: { pattern: TargetPattern }): JSX.Element {
  return (
    <div class="columns columns-half">
      <div class="target-left">
        <PatternPanel pattern={pattern} />
        <SheetPanel spec={pattern.spec} />
      </div>
      <ScreenPanel pattern={pattern} />
    </div>
  );
}

function PatternPanel({ pattern }: { pattern: TargetPattern }): JSX.Element {
  const say = words.value;
  const draw = useCallback<Draw>(
    (context, size, colours) => {
      const needed = neededSize(pattern, 1);
      // A little less than fits: rounding must not make it too large.
      const perM = 0.999 * Math.min(size.width / needed.width, size.height / needed.height);
      const place = placePattern(pattern, size, perM);
      if (place !== null) drawPattern(context, pattern, place, colours("target-ink"));
    },
    [pattern],
  );
  const millimetres = (lengths: readonly number[]): string =>
    withUnit(lengths.map((length) => plain(1000 * length)).join(" × "), "mm");
  return (
    <section class="panel" aria-labelledby="pattern-title">
      <div class="panel-head">
        <h2 id="pattern-title" lang="en">
          {pattern.name}
        </h2>
      </div>
      <Drawing class="target-preview" draw={draw} label={say.target_preview(pattern.name)} />
      <Facts
        facts={[
          { name: squareName(pattern.spec, say), value: millimetres([pattern.square_m]) },
          { name: say.target_size, value: millimetres(pattern.size_m) },
        ]}
      />
    </section>
  );
}
