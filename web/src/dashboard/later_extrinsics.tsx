// Where the camera of a run is in the vehicle, as it was measured after the run; nothing where nobody did.
import { type JSX } from "preact";
import { useCallback, useId } from "preact/hooks";
import { allParts } from "../api/all_parts";
import { getExtrinsicsCertificate, getLaterExtrinsics } from "../api/client";
import { useResource } from "../api/use_resource";
import type { LaterExtrinsics } from "../generated/api";
import { when } from "../format/times";
import { saveFile } from "../shell/files";
import { ProblemNotice } from "../shell/notices";
import { adviceOf } from "../words/advice";
import { language, words } from "../words/language";
import { measurementName } from "../words/measurements";
import { ExtrinsicsBody } from "./extrinsics_panel";
import { reasonsOf } from "./reasons";
import { StandingTag } from "./runs_table";
import { useAction } from "./use_action";

export function LaterExtrinsicsPanels({ runId }: { runId: string }): JSX.Element | null {
  const found = useResource(
    useCallback(
      (signal: AbortSignal) => allParts((cursor) => getLaterExtrinsics(runId, cursor, signal)),
      [runId],
    ),
  );
  if (found.state === "loading") return null;
  if (found.state === "failed") return <ProblemNotice problem={found.problem} />;
  return (
    <>
      {found.value.map((one) => (
        <Panel key={one.id} measured={one} />
      ))}
    </>
  );
}

function Panel({ measured }: { measured: LaterExtrinsics }): JSX.Element {
  const say = words.value;
  const title = useId();
  const action = useAction();
  const saveCertificate = (): void =>
    action.run(async () => {
      const { name, content } = await getExtrinsicsCertificate(measured.id);
      saveFile(name, content);
    });
  const reasons = reasonsOf(measured.gates);
  return (
    <section class="panel" aria-labelledby={title}>
      <div class="panel-head">
        <h2 id={title}>{say.later_extrinsics_title}</h2>
        <span class="muted">{say.later_extrinsics_when(when(measured.created_at), measured.station)}</span>
        <StandingTag standing={measured.verdict} />
      </div>
      {reasons.length > 0 && (
        <ul class="panel-body later-reasons">
          {reasons.map((gate) => {
            const advice = adviceOf(gate, language.value, say);
            return (
              <li key={gate.name}>
                <strong>{measurementName(gate.name, language.value)}.</strong>{" "}
                <span lang={advice.lang}>{advice.all}</span>
              </li>
            );
          })}
        </ul>
      )}
      <ExtrinsicsBody extrinsics={measured.extrinsics} />
      <div class="panel-body">
        <button type="button" disabled={action.isBusy} onClick={saveCertificate}>
          {say.files_certificate}
        </button>
        {action.problem !== null && <ProblemNotice problem={action.problem} />}
      </div>
    </section>
  );
}
