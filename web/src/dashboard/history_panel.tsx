// The camera of a serial over its runs: charts with sd bars, and the same in numbers with links.
import { type JSX } from "preact";
import { useCallback, useMemo } from "preact/hooks";
import { getHistory } from "../api/client";
import { useResource } from "../api/use_resource";
import type { PastCalibration } from "../generated/api";
import { Loading, ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { HistoryCharts } from "./history_charts";
import { previousOf } from "./history_quantities";
import { HistoryTable } from "./history_table";
import { addressOf } from "./route";

interface Props {
  serial: string;
  /** Only runs of this SKU are one camera's. */
  sku: string;
  runId: string;
}

/** The history of a run's serial and SKU, the run picked out in it. */
export function HistoryPanel({ serial, sku, runId }: Props): JSX.Element | null {
  const say = words.value;
  const found = useResource(useCallback((signal: AbortSignal) => getHistory(serial, signal), [serial]));
  if (found.state === "loading") return <Loading />;
  if (found.state === "failed") return <ProblemNotice problem={found.problem} />;
  const calibrations = found.value.calibrations.filter((one) => one.sku === sku);
  if (calibrations.length === 0) return null;
  const previous = previousOf(calibrations, runId);
  return (
    <History
      title={`${say.history_title} ${serial}`}
      calibrations={calibrations}
      here={runId}
      action={
        previous === null ? null : (
          <a href={addressOf({ page: "compare", a: previous, b: runId })}>{say.history_compare_previous}</a>
        )
      }
    />
  );
}

/** The histories of a serial, one for each SKU that it was calibrated as. */
export function VehicleHistories({ serial }: { serial: string }): JSX.Element {
  const say = words.value;
  const found = useResource(useCallback((signal: AbortSignal) => getHistory(serial, signal), [serial]));
  const skus = useMemo(
    () => (found.state === "ready" ? [...new Set(found.value.calibrations.map(({ sku }) => sku))] : []),
    [found],
  );
  if (found.state === "loading") return <Loading />;
  if (found.state === "failed") return <ProblemNotice problem={found.problem} />;
  return (
    <>
      {skus.map((sku) => (
        <History
          key={sku}
          title={`${say.history_over_time} · ${sku}`}
          calibrations={found.value.calibrations.filter((one) => one.sku === sku)}
          here=""
          action={null}
        />
      ))}
    </>
  );
}

interface HistoryProps {
  title: string;
  calibrations: readonly PastCalibration[];
  here: string;
  action: JSX.Element | null;
}

function History({ title, calibrations, here, action }: HistoryProps): JSX.Element {
  const say = words.value;
  return (
    <section class="panel history-panel" aria-label={title}>
      <div class="panel-head">
        <h2>{title}</h2>
        <span class="muted">
          ● {say.verdict_PASS} ▲ {say.verdict_MARGINAL} ◆ {say.verdict_FAIL} · {say.history_bars}
        </span>
        {action}
      </div>
      <HistoryCharts calibrations={calibrations} here={here} />
      <HistoryTable calibrations={calibrations} here={here} />
    </section>
  );
}
