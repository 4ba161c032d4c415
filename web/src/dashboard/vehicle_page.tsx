// One vehicle by its serial: all its runs, newest first, and its camera over time.
import { type JSX } from "preact";
import { useCallback } from "preact/hooks";
import { getVehicle } from "../api/client";
import { useResource } from "../api/use_resource";
import { Loading, ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { CompareChosen } from "./compare_chosen";
import { VehicleHistories } from "./history_panel";
import { RunsTable } from "./runs_table";
import { useTitle } from "./use_title";

const REFRESH_MS = 3000;
const refresh = (): number => REFRESH_MS;

export function VehiclePage({ serial }: { serial: string }): JSX.Element {
  const say = words.value;
  useTitle(serial);
  const vehicle = useResource(
    useCallback((signal: AbortSignal) => getVehicle(serial, signal), [serial]),
    refresh,
  );
  return (
    <>
      <div class="page-head">
        <h1>
          {say.vehicle_title} <span class="serial">{serial}</span>
        </h1>
        {vehicle.state === "ready" && (
          <span class="muted">{say.vehicle_runs(vehicle.value.runs.length)}</span>
        )}
      </div>
      {vehicle.state === "loading" && <Loading />}
      {vehicle.state === "failed" && <ProblemNotice problem={vehicle.problem} />}
      {vehicle.state === "ready" && (
        <section class="panel" aria-label={say.runs_title}>
          <RunsTable runs={vehicle.value.runs} />
          <CompareChosen />
        </section>
      )}
      {vehicle.state === "ready" && <VehicleHistories serial={serial} />}
    </>
  );
}
