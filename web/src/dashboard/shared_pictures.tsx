// Pictures of the run that other runs hold too; shown only where there are any.
import { type JSX } from "preact";
import { useCallback } from "preact/hooks";
import { getSharedPictures } from "../api/client";
import { useResource } from "../api/use_resource";
import { when } from "../format/times";
import { words } from "../words/language";
import { addressOf } from "./route";
import { byRun } from "./shared_runs";

export function SharedPictures({ runId }: { runId: string }): JSX.Element | null {
  const say = words.value;
  const found = useResource(useCallback((signal: AbortSignal) => getSharedPictures(runId, signal), [runId]));
  if (found.state !== "ready" || found.value.length === 0) return null;
  return (
    <section class="panel" aria-labelledby="shared-title">
      <div class="panel-head">
        <h2 id="shared-title">{say.shared_title}</h2>
        <span class="muted">{say.shared_note}</span>
      </div>
      <ul class="panel-body shared">
        {byRun(found.value).map(({ id, serial, since, pictures }) => (
          <li key={id}>
            <span>
              {say.shared_with(pictures.length)}{" "}
              <a class="serial" href={addressOf({ page: "run", id, capture: "" })}>
                {serial}
              </a>{" "}
              <span class="muted">{when(since)}</span>
            </span>
            <span class="shared-numbers">
              {pictures.map(({ number, other_number }) => (
                <a
                  key={`${number} ${other_number}`}
                  href={addressOf({ page: "run", id, capture: String(other_number) })}
                  aria-label={say.shared_picture(number, other_number)}
                >
                  {number}
                  {number === other_number ? "" : ` → ${other_number}`}
                </a>
              ))}
            </span>
          </li>
        ))}
      </ul>
    </section>
  );
}
