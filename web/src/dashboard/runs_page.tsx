// The list of runs, newest first: kept up to date by itself, narrowed by conditions, walked by pages.
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
import { CompareChosen } from "./compare_chosen";
import { addressOf } from "./route";
import { RunConditions } from "./run_conditions";
import { queryOf, withCondition, type RunFilter } from "./run_filter";
import { RunsTable } from "./runs_table";
import { useTitle } from "./use_title";

const PAGE_SIZE = 50;
const REFRESH_MS = 3000;
const refresh = (): number => REFRESH_MS;

export function RunsPage({ filter }: { filter: RunFilter }): JSX.Element {
  const say = words.value;
  useTitle(say.runs_title);
  const query = queryOf(filter);
  const [walk, setWalk] = useState<Walk>(FIRST_PAGE);
  useEffect(() => setWalk(FIRST_PAGE), [query]);
  const cursor = shownCursor(walk);
  const load = useCallback(
    (signal: AbortSignal) => getRuns({ filter: query, cursor, limit: PAGE_SIZE }, signal),
    [query, cursor],
  );
  const runs = useResource(load, refresh);
  return (
    <>
      <div class="page-head">
        <h1>{say.runs_title}</h1>
        <SerialSearch filter={filter} />
        {runs.state === "ready" && online.value && (
          <span class="live muted">
            <span class="live-dot" aria-hidden="true" />
            {say.runs_live(clock(new Date()))}
          </span>
        )}
      </div>
      <RunConditions filter={filter} />
      {runs.state === "loading" && <Loading />}
      {runs.state === "failed" && <ProblemNotice problem={runs.problem} />}
      {runs.state === "ready" && <Runs page={runs.value} filter={filter} walk={walk} onWalk={setWalk} />}
    </>
  );
}

interface RunsProps {
  page: PageRunSummary;
  filter: RunFilter;
  walk: Walk;
  onWalk: (walk: Walk) => void;
}

function Runs({ page, filter, walk, onWalk }: RunsProps): JSX.Element {
  const say = words.value;
  if (page.items.length === 0 && isFirst(walk)) {
    return <NoRuns filter={filter} />;
  }
  return (
    <section class="panel" aria-label={say.runs_title}>
      <RunsTable runs={page.items} />
      <CompareChosen />
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

function NoRuns({ filter }: { filter: RunFilter }): JSX.Element {
  const say = words.value;
  if (queryOf(filter) === "") return <Empty title={say.runs_none} detail={say.runs_none_detail} />;
  const onlySerial = queryOf(withCondition(filter, "serial", "")) === "";
  return (
    <Empty
      title={onlySerial ? say.runs_no_match(filter.serial ?? "") : say.runs_none_meet}
      detail={onlySerial ? say.runs_no_match_detail : say.runs_none_meet_detail}
    >
      <a href="#/runs">{say.runs_clear}</a>
    </Empty>
  );
}

function SerialSearch({ filter }: { filter: RunFilter }): JSX.Element {
  const say = words.value;
  const serial = filter.serial ?? "";
  const [typed, setTyped] = useState(serial);
  useEffect(() => setTyped(serial), [serial]);
  const go = (event: SubmitEvent): void => {
    event.preventDefault();
    window.location.hash = addressOf({
      page: "runs",
      filter: withCondition(filter, "serial", typed.trim()),
    });
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
    </form>
  );
}
