// The dashboard: asks for a key where there is none, else shows the page of the address.
import { type JSX } from "preact";
import { key } from "../api/key";
import { Header, OfflineBar } from "../shell/header";
import { KeyForm } from "../shell/key_form";
import { route } from "./address";
import type { Route } from "./route";
import { BoardPage } from "./board_page";
import { ReviewPage } from "./review_page";
import { RunComparisonPage } from "./run_comparison_page";
import { RunPage } from "./run_page";
import { RunsPage } from "./runs_page";
import { SkuPage } from "./sku_page";
import { SkusPage } from "./skus_page";
import { StationsPage } from "./stations_page";
import { TargetPage } from "./target_page";
import { TargetsPage } from "./targets_page";
import { VehiclePage } from "./vehicle_page";
import { YieldPage } from "./yield_page";

export function App(): JSX.Element {
  return (
    <>
      <Header page={route.value.page} />
      <OfflineBar />
      <main id="content" tabIndex={-1}>
        {key.value === null ? <KeyForm /> : <Page route={route.value} />}
      </main>
    </>
  );
}

function Page({ route: to }: { route: Route }): JSX.Element {
  switch (to.page) {
    case "run":
      return <RunPage id={to.id} capture={to.capture} />;
    case "compare":
      return <RunComparisonPage key={`${to.a} ${to.b}`} a={to.a} b={to.b} />;
    case "vehicle":
      return <VehiclePage serial={to.serial} />;
    case "runs":
      return <RunsPage filter={to.filter} />;
    default:
      return <PlantPage route={to} />;
  }
}

type PlantRoute = Exclude<Route, { page: "run" | "compare" | "vehicle" | "runs" }>;

/** Pages that are not about runs of vehicles. */
function PlantPage({ route: to }: { route: PlantRoute }): JSX.Element {
  switch (to.page) {
    case "stations":
      return <StationsPage />;
    case "skus":
      return <SkusPage />;
    case "poseSet":
      return <ReviewPage id={to.id} other={to.with} />;
    case "sku":
      return <SkuPage key={to.code} code={to.code} poseSet={to.poseSet} />;
    case "targets":
      return <TargetsPage />;
    case "target":
      return <TargetPage key={to.spec} spec={to.spec} />;
    case "board":
      return <BoardPage key={to.board} name={to.board} version={to.shape} />;
    case "yield":
      return <YieldPage sku={to.sku} station={to.station} />;
  }
}
