// One run, top to bottom: the verdict and why, its gates and intrinsics, its images, its residuals.
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
import { ExtrinsicsPanel } from "./extrinsics_panel";
import { GatesTable } from "./gates_table";
import { IntrinsicsTable } from "./intrinsics_table";
import { ResidualsPanel } from "./residuals_panel";
import { residualsOf } from "./run_residuals";
import { useTitle } from "./use_title";
import { VerdictBanner } from "./verdict_banner";

const REFRESH_MS = 2000;
/** A finished run never changes, so only an open one is asked for again. */
const whileOpen = (run: RunDetail): number | null => (run.state === "open" ? REFRESH_MS : null);

export function RunPage({ id }: { id: string }): JSX.Element {
  const run = useResource(
    useCallback((signal: AbortSignal) => getRun(id, signal), [id]),
    whileOpen,
  );
  useEffect(() => releaseImages, [id]);
  if (run.state === "loading") return <Loading />;
  if (run.state === "failed") return <ProblemNotice problem={run.problem} />;
  return <Run key={id} run={run.value} />;
}

function Run({ run }: { run: RunDetail }): JSX.Element {
  const say = words.value;
  const captures = useMemo(
    () => [...run.capture_list].sort((a, b) => a.number - b.number),
    [run.capture_list],
  );
  const details = useCaptureDetails(captures, run.state);
  const residuals = useMemo(() => residualsOf(details), [details]);
  const [chosenId, setChosenId] = useState<string | null>(null);
  const chosen = captures.find((capture) => capture.id === chosenId) ?? captures[0];
  const { result } = run;
  useTitle(run.serial);
  const chooseAndShow = (id: string): void => {
    setChosenId(id);
    document.getElementById("captures")?.scrollIntoView({ block: "start" });
  };
  return (
    <>
      <VerdictBanner run={run} />
      {result !== null && (
        <div class="columns columns-gates">
          <GatesTable gates={result.gates} />
          <div class="column">
            <IntrinsicsTable result={result} />
            <ExtrinsicsPanel result={result} />
            <ResidualsPanel
              result={result}
              captures={captures}
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
          onChoose={setChosenId}
        />
      )}
      {run.state === "open" && <p class="muted">{say.run_result_when_finished}</p>}
    </>
  );
}
