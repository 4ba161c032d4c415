// The list of runs, newest first: kept up to date by itself, searched by serial, walked by pages.
import { type JSX } from "preact";
import { useCallback, useEffect, useState } from "preact/hooks";
import { getRuns } from "../api/client";
import { online } from "../api/connection";
import { back, FIRST_PAGE, isFirst, onward, shownCursor, type Walk } from "../api/pages";
import type { PageRunSummary } from "../generated/api";
import { useResource } from "../api/use_resource";
import { clock } from "../format/times";
import { Empty, Loading, ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { addressOf } from "./route";
import { RunsTable } from "./runs_table";
import { useTitle } from "./use_title";

const PAGE_SIZE = 50;
const REFRESH_MS = 3000;
const refresh = (): number => REFRESH_MS;

export function RunsPage({ serial }: { serial: string }): JSX.Element {
  const say = words.value;
  useTitle(say.runs_title);
  const [walk, setWalk] = useState<Walk>(FIRST_PAGE);
  useEffect(() => setWalk(FIRST_PAGE), [serial]);
  const cursor = shownCursor(walk);
  const load = useCallback(
    (signal: AbortSignal) => getRuns({ serial, cursor, limit: PAGE_SIZE }, signal),
    [serial, cursor],
  );
  const runs = useResource(load, refresh);
  return (
    <>
      <div class="page-head">
        <h1>{say.runs_title}</h1>
        <SerialSearch serial={serial} />
        {runs.state === "ready" && online.value && (
          <span class="live muted">
            <span class="live-dot" aria-hidden="true" />
            {say.runs_live(clock(new Date()))}
          </span>
        )}
      </div>
      {runs.state === "loading" && <Loading />}
      {runs.state === "failed" && <ProblemNotice problem={runs.problem} />}
      {runs.state === "ready" && <Runs page={runs.value} serial={serial} walk={walk} onWalk={setWalk} />}
    </>
  );
}

interface RunsProps {
  page: PageRunSummary;
  serial: string;
  walk: Walk;
  onWalk: (walk: Walk) => void;
}

function Runs({ page, serial, walk, onWalk }: RunsProps): JSX.Element {
  const say = words.value;
  if (page.items.length === 0 && isFirst(walk)) {
    if (serial === "") return <Empty title={say.runs_none} detail={say.runs_none_detail} />;
    return (
      <Empty title={say.runs_no_match(serial)} detail={say.runs_no_match_detail}>
        <a href="#/runs">{say.runs_clear}</a>
      </Empty>
    );
  }
  return (
    <section class="panel" aria-label={say.runs_title}>
      <RunsTable runs={page.items} />
      {!(isFirst(walk) && page.next_cursor === null) && (
        <nav class="pages" aria-label={say.runs_page(walk.length)}>
          <button type="button" disabled={isFirst(walk)} onClick={() => onWalk(back(walk))}>
            ← {say.runs_newer}
          </button>
          <span>{say.runs_page(walk.length)}</span>
          <button
            type="button"
            disabled={page.next_cursor === null}
            onClick={() => onWalk(onward(walk, page.next_cursor))}
          >
            {say.runs_older} →
          </button>
        </nav>
      )}
    </section>
  );
}

function SerialSearch({ serial }: { serial: string }): JSX.Element {
  const say = words.value;
  const [typed, setTyped] = useState(serial);
  useEffect(() => setTyped(serial), [serial]);
  const go = (event: SubmitEvent): void => {
    event.preventDefault();
    window.location.hash = addressOf({ page: "runs", serial: typed.trim() });
  };
  return (
    <form class="search" role="search" onSubmit={go}>
      <label for="serial">{say.runs_search}</label>
      <input
        id="serial"
        type="search"
        placeholder={say.runs_search_hint}
        value={typed}
        spellcheck={false}
        autocomplete="off"
        onInput={(event) => setTyped(event.currentTarget.value)}
      />
      {serial !== "" && <a href="#/runs">{say.runs_clear}</a>}
    </form>
  );
}
