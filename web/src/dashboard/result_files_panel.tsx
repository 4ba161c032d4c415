// What a finished run leaves as files: its certificate, and its result in every format that the service has.
import { type JSX } from "preact";
import { useState } from "preact/hooks";
import { getCertificate, getExportFormats, getExportedResult, type NamedFile } from "../api/client";
import { useResource } from "../api/use_resource";
import type { RunDetail } from "../generated/api";
import { saveFile } from "../shell/files";
import { ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { useAction } from "./use_action";

export function ResultFilesPanel({ run }: { run: RunDetail }): JSX.Element {
  const say = words.value;
  const formats = useResource(getExportFormats);
  const [isAllowed, setAllowed] = useState(false);
  const action = useAction();
  const failed = run.verdict === "FAIL";
  const save = (get: () => Promise<NamedFile>): void =>
    action.run(async () => {
      const { name, content } = await get();
      saveFile(name, content);
    });
  // Proper names stay as they are; what is a word is said in the language of the page.
  const named: Readonly<Record<string, string>> = { pdf: say.files_pdf, block: say.files_block };
  return (
    <section class="panel files-panel" aria-labelledby="files-title">
      <div class="panel-head">
        <h2 id="files-title">{say.files_title}</h2>
      </div>
      <div class="panel-body">
        <button
          type="button"
          class="primary"
          disabled={action.isBusy}
          onClick={() => save(() => getCertificate(run.id))}
        >
          {say.files_certificate}
        </button>
        <p class="muted">{failed ? say.files_certificate_of_fail : say.files_certificate_detail}</p>
        {failed && (
          <label class="files-allow">
            <input
              type="checkbox"
              checked={isAllowed}
              onChange={(event) => setAllowed(event.currentTarget.checked)}
            />
            {say.files_allow_failed}
          </label>
        )}
        {formats.state === "ready" && (
          <ul class="files-formats" aria-label={say.files_formats}>
            {formats.value.formats.map(({ name, label }) => (
              <li key={name}>
                <button
                  type="button"
                  disabled={action.isBusy || (failed && !isAllowed)}
                  onClick={() => save(() => getExportedResult(run.id, name, isAllowed))}
                >
                  {named[name] ?? label}
                </button>
              </li>
            ))}
          </ul>
        )}
        {formats.state === "failed" && <ProblemNotice problem={formats.problem} />}
        {action.problem !== null && <ProblemNotice problem={action.problem} />}
      </div>
    </section>
  );
}
