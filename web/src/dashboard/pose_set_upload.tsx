// A pose set out of a file becomes a draft of a SKU's revision; what the service says against it is shown.
import { type JSX } from "preact";
import { useId, useState } from "preact/hooks";
import { importPoseSet } from "../api/client";
import { RequestFailed } from "../api/problem";
import { readJson } from "../shell/files";
import { ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { addressOf } from "./route";
import { useAction } from "./use_action";

export function PoseSetUpload({ code, revision }: { code: string; revision: number }): JSX.Element {
  const say = words.value;
  const id = useId();
  const action = useAction();
  const [made, setMade] = useState<{ id: string; file: string } | null>(null);

  const send = (input: HTMLInputElement): void => {
    const file = input.files?.[0];
    // The same file chosen again is another try.
    input.value = "";
    if (file === undefined) return;
    setMade(null);
    action.run(async () => {
      const document = await readJson(file);
      if (document === undefined)
        throw new RequestFailed(notJson(say.review_not_json, say.review_not_json_detail));
      const { pose_set } = await importPoseSet(code, revision, document);
      setMade({ id: pose_set.id, file: file.name });
    });
  };
  return (
    <div class="panel-body pose-set-upload">
      <label for={id}>
        {say.review_upload} <span class="muted">{say.sku_revision(revision)}</span>
      </label>
      <input
        id={id}
        type="file"
        accept=".json,application/json"
        disabled={action.isBusy}
        onChange={(event) => send(event.currentTarget)}
      />
      {made !== null && (
        <p role="status" class="upload-done">
          {say.review_uploaded}{" "}
          <a href={addressOf({ page: "poseSet", id: made.id, with: "" })}>{made.file}</a>
        </p>
      )}
      {action.problem !== null && <ProblemNotice problem={action.problem} />}
    </div>
  );
}

function notJson(title: string, detail: string): RequestFailed["problem"] {
  return { status: 0, code: "not-json", title, detail, errors: [], traceId: null };
}
