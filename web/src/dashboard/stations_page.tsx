// What every station does now: the open run and how far it is, the last verdict, the way to its kiosk.
import { type JSX } from "preact";
import { allParts } from "../api/all_parts";
import { getStations } from "../api/client";
import { online } from "../api/connection";
import { useResource } from "../api/use_resource";
import { clock } from "../format/times";
import type { StationStanding } from "../generated/api";
import { Empty, Loading, ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { StationCard } from "./station_card";
import { useTitle } from "./use_title";

const REFRESH_MS = 2000;
const refresh = (): number => REFRESH_MS;

async function load(signal: AbortSignal): Promise<StationStanding[]> {
  const stations = await allParts((cursor) => getStations(cursor, signal));
  // A station keeps its place on the page, whatever happens at it.
  return stations.sort((a, b) => a.code.localeCompare(b.code, "en", { numeric: true }));
}

export function StationsPage(): JSX.Element {
  const say = words.value;
  useTitle(say.stations_title);
  const stations = useResource(load, refresh);
  return (
    <>
      <div class="page-head">
        <h1>{say.stations_title}</h1>
        {stations.state === "ready" && online.value && (
          <span class="live muted">
            <span class="live-dot" aria-hidden="true" />
            {say.runs_live(clock(new Date()))}
          </span>
        )}
      </div>
      {stations.state === "loading" && <Loading />}
      {stations.state === "failed" && <ProblemNotice problem={stations.problem} />}
      {stations.state === "ready" && stations.value.length === 0 && (
        <Empty title={say.stations_none} detail={say.stations_none_detail} />
      )}
      {stations.state === "ready" && stations.value.length > 0 && (
        <ul class="stations">
          {stations.value.map((station) => (
            <StationCard key={station.code} station={station} />
          ))}
        </ul>
      )}
    </>
  );
}
