// One station on the page of stations.
import { type JSX } from "preact";
import type { RunSummary, StationStanding } from "../generated/api";
import { exactly, when } from "../format/times";
import { standingOf } from "../shell/verdict_mark";
import { words } from "../words/language";
import { BoardDrift } from "./board_drift";
import { addressOf } from "./route";
import { StandingTag } from "./runs_table";
import { StationBoard } from "./station_board";
import { StationFixture } from "./station_fixture";
import { StationLanguage } from "./station_language";
import { StationSource } from "./station_source";

/** More poses than this are drawn as one bar: single fields would be too thin to count. */
const MOST_FIELDS = 40;

export function StationCard({ station }: { station: StationStanding }): JSX.Element {
  const say = words.value;
  const { code, name, open_run: open, last_run: last } = station;
  return (
    <li class="panel station" aria-labelledby={`station-${code}`}>
      <div class="panel-head">
        <h2 id={`station-${code}`}>
          {code} <span class="station-name muted">{name}</span>
        </h2>
        <a href={`/kiosk?station=${encodeURIComponent(code)}`} aria-label={say.station_kiosk_of(code)}>
          {say.station_kiosk}
        </a>
      </div>
      <div class="station-now">
        {open === null ? <p class="muted">{say.station_idle}</p> : <OpenRun run={open} />}
      </div>
      {station.board_drift !== null && <BoardDrift drift={station.board_drift} />}
      <StationBoard board={station.board} />
      <StationSource code={code} source={station.source} />
      <StationLanguage code={code} language={station.language} />
      <StationFixture code={code} fixture={station.fixture} />
      <div class="station-last">
        <span class="muted">{say.station_last}</span>
        {last === null ? <span class="muted">{say.station_no_verdict}</span> : <LastRun run={last} />}
        <a class="station-all" href={addressOf({ page: "runs", filter: { station: code } })}>
          {say.station_runs}
        </a>
      </div>
    </li>
  );
}

function OpenRun({ run }: { run: RunSummary }): JSX.Element {
  const say = words.value;
  return (
    <>
      <p class="station-line">
        <StandingTag standing={standingOf(run)} />
        <RunLink run={run} />
        <span class="muted">
          {run.sku.code} {say.sku_revision(run.sku.revision)}
        </span>
      </p>
      <Progress done={run.captures} all={run.poses} />
      <p class="station-line">
        <strong>{run.poses > 0 ? `${run.captures} / ${run.poses}` : run.captures}</strong>
        <span class="muted">{say.station_captures}</span>
        <span class="muted station-since">
          {say.station_since} <When iso={run.created_at} />
        </span>
      </p>
    </>
  );
}

function LastRun({ run }: { run: RunSummary }): JSX.Element {
  return (
    <>
      <StandingTag standing={standingOf(run)} />
      <RunLink run={run} />
      <span class="muted">
        <When iso={run.finished_at ?? run.created_at} />
      </span>
    </>
  );
}

function RunLink({ run }: { run: RunSummary }): JSX.Element {
  return (
    <a class="serial" href={addressOf({ page: "run", id: run.id, capture: "" })}>
      {run.serial}
    </a>
  );
}

function When({ iso }: { iso: string }): JSX.Element {
  return (
    <time dateTime={iso} title={exactly(iso)}>
      {when(iso)}
    </time>
  );
}

function Progress({ done, all }: { done: number; all: number }): JSX.Element | null {
  if (all === 0) return null;
  if (all > MOST_FIELDS) return <progress class="station-progress" value={done} max={all} />;
  return (
    <div class="station-fields" aria-hidden="true">
      {Array.from({ length: all }, (_, i) => (
        <span key={i} class={i < done ? "done" : ""} />
      ))}
    </div>
  );
}
