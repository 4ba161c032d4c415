// The yield of the last 30 days: in one line, by day, by SKU, by station, and which gates failed.
import { type JSX } from "preact";
import { useCallback } from "preact/hooks";
import { getYield } from "../api/client";
import { useResource } from "../api/use_resource";
import type { Yield } from "../generated/api";
import { longDay } from "../format/times";
import { Empty, Loading, ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { ParetoTable } from "./pareto_table";
import { CodeChoice } from "./code_choice";
import { addressOf } from "./route";
import type { RunFilter } from "./run_filter";
import { useCodes } from "./use_codes";
import { useTitle } from "./use_title";
import { YieldChart } from "./yield_chart";
import { YieldFigures } from "./yield_figures";
import { runsOf, sumOf, sumsBy } from "./yield_sums";
import { YieldTable } from "./yield_table";

const REFRESH_MS = 60_000;
const refresh = (): number => REFRESH_MS;

export function YieldPage({ sku, station }: { sku: string; station: string }): JSX.Element {
  const say = words.value;
  useTitle(say.yield_title);
  const codes = useCodes();
  const found = useResource(
    useCallback((signal: AbortSignal) => getYield(sku, station, signal), [sku, station]),
    refresh,
  );
  const go = (to: { sku: string; station: string }): void => {
    window.location.hash = addressOf({ page: "yield", ...to });
  };
  return (
    <>
      <div class="page-head">
        <h1>{say.yield_title}</h1>
        <div class="search">
          <CodeChoice
            label={say.col_sku}
            value={sku}
            codes={codes.skus}
            onChoose={(value) => go({ sku: value, station })}
          />
          <CodeChoice
            label={say.col_station}
            value={station}
            codes={codes.stations}
            onChoose={(value) => go({ sku, station: value })}
          />
        </div>
        {found.state === "ready" && (
          <span class="muted">{say.yield_days(longDay(found.value.since), longDay(found.value.until))}</span>
        )}
      </div>
      <p class="definition muted">{say.yield_definition}</p>
      {found.state === "loading" && <Loading />}
      {found.state === "failed" && <ProblemNotice problem={found.problem} />}
      {found.state === "ready" && <Figures found={found.value} sku={sku} station={station} />}
    </>
  );
}

interface FiguresProps {
  found: Yield;
  sku: string;
  station: string;
}

function Figures({ found, sku, station }: FiguresProps): JSX.Element {
  const say = words.value;
  const { counts, gates, since, until } = found;
  const all = sumOf(counts);
  if (runsOf(all) === 0) return <Empty title={say.yield_none} detail={say.yield_none_detail} />;
  const filter: RunFilter = { sku, station, since, until };
  const byDay = sumsBy(counts, ({ day }) => day);
  return (
    <>
      <YieldFigures sums={all} filter={filter} />
      <YieldChart byDay={byDay} since={since} until={until} />
      <div class="columns columns-half">
        <div class="column">
          <YieldTable
            id="by-sku"
            title={say.yield_by_sku}
            what={say.col_sku}
            rows={sumsBy(counts, (count) => count.sku).map(({ key, sums }) => ({
              name: key,
              filter: { ...filter, sku: key },
              href: addressOf({ page: "yield", sku: key, station }),
              sums,
            }))}
          />
          <YieldTable
            id="by-station"
            title={say.yield_by_station}
            what={say.col_station}
            rows={sumsBy(counts, (count) => count.station).map(({ key, sums }) => ({
              name: key ?? say.without_station,
              filter: key === null ? { ...filter, without_station: "true" } : { ...filter, station: key },
              ...(key !== null && { href: addressOf({ page: "yield", sku, station: key }) }),
              sums,
            }))}
          />
          <ParetoTable gates={gates} failed={all.failed} filter={filter} />
        </div>
        <YieldTable
          id="by-day"
          title={say.yield_by_day}
          what={say.yield_day}
          rows={[...byDay].reverse().map(({ key, sums }) => ({
            name: longDay(key),
            filter: { ...filter, since: key, until: key },
            sums,
          }))}
        />
      </div>
    </>
  );
}
