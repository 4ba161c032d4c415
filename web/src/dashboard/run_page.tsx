// One run, top to bottom: the verdict and why, its gates and intrinsics, its images, its residuals, its history.
import { type JSX } from "preact";
import { useCallback, useEffect, useMemo, useState } from "preact/hooks";
import { getRun } from "../api/client";
import type { RunDetail } from "../generated/api";
import { useResource } from "../api/use_resource";
import { releaseImages } from "../shell/images";
import { Empty, Loading, ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { useCaptureDetails } from "./capture_details";
import { CapturesPanel } from "./captures_panel";
import { ErrorMapsPanel } from "./error_maps_panel";
import { ExtrinsicsPanel } from "./extrinsics_panel";
import { GatesTable } from "./gates_table";
import { HistoryPanel } from "./history_panel";
import { IntrinsicsTable } from "./intrinsics_table";
import { LaterExtrinsicsPanels } from "./later_extrinsics";
import { ResidualsPanel } from "./residuals_panel";
import { ResultFilesPanel } from "./result_files_panel";
import { residualsOf, type Spot } from "./run_residuals";
import { SharedPictures } from "./shared_pictures";
import { useTitle } from "./use_title";
import { VerdictBanner } from "./verdict_banner";

const REFRESH_MS = 2000;
/** A finished run never changes, so only an open one is asked for again. */
const whileOpen = (run: RunDetail): number | null => (run.state === "open" ? REFRESH_MS : null);

/** `capture`: number of the capture that the address asks for, or nothing. */
export function RunPage({ id, capture }: { id: string; capture: string }): JSX.Element {
  const run = useResource(
    useCallback((signal: AbortSignal) => getRun(id, signal), [id]),
    whileOpen,
  );
  useEffect(() => releaseImages, [id]);
  if (run.state === "loading") return <Loading />;
  if (run.state === "failed") return <ProblemNotice problem={run.problem} />;
  return <Run key={`${id} ${capture}`} run={run.value} asked={capture} />;
}

function showCaptures(): void {
  document.getElementById("captures")?.scrollIntoView({ block: "start" });
}

function Run({ run, asked }: { run: RunDetail; asked: string }): JSX.Element {
  const say = words.value;
  const captures = useMemo(
    () => [...run.capture_list].sort((a, b) => a.number - b.number),
    [run.capture_list],
  );
  const numbers = useMemo(() => new Map(captures.map(({ id, number }) => [id, number])), [captures]);
  const details = useCaptureDetails(captures, run.state);
  const residuals = useMemo(() => residualsOf(details), [details]);
  const [spot, setSpot] = useState<Spot | null>(null);
  const chosen =
    captures.find(({ id, number }) => (spot === null ? String(number) === asked : id === spot.captureId)) ??
    captures[0];
  const { result } = run;
  useTitle(run.serial);
  useEffect(() => {
    if (asked !== "") showCaptures();
  }, [asked]);
  const choose = (to: Spot): void => setSpot({ ...to });
  const chooseAndShow = (to: Spot): void => {
    choose(to);
    showCaptures();
  };
  return (
    <>
      <VerdictBanner run={run} />
      {result !== null && (
        <div class="columns columns-gates">
          <GatesTable gates={result.gates} />
          <div class="column">
            <IntrinsicsTable result={result} />
            <ResultFilesPanel run={run} />
            <ExtrinsicsPanel result={result} />
            <LaterExtrinsicsPanels runId={run.id} />
            <ResidualsPanel
              result={result}
              captures={captures}
              numbers={numbers}
              residuals={residuals}
              chosenId={chosen?.id ?? ""}
              onChoose={chooseAndShow}
            />
          </div>
        </div>
      )}
      {chosen === undefined ? (
        <Empty title={say.captures_none} detail={say.captures_none_detail} />
      ) : (
        <CapturesPanel
          captures={captures}
          chosen={chosen}
          detail={details.get(chosen.id) ?? null}
          result={result}
          residuals={residuals}
          numbers={numbers}
          spot={spot}
          onChoose={(to) => (to.corner === null ? choose(to) : chooseAndShow(to))}
        />
      )}
      {run.state === "open" && <p class="muted">{say.run_result_when_finished}</p>}
      <SharedPictures runId={run.id} />
      {result !== null && <ErrorMapsPanel runId={run.id} />}
      <HistoryPanel serial={run.serial} sku={run.sku.code} runId={run.id} />
    </>
  );
}
