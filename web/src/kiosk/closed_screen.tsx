// Instead of the station: why this page cannot work there, and what to do.
import { type JSX } from "preact";
import { forgetKey } from "../api/key";
import { words } from "../words/language";
import type { Words } from "../words/en";
import type { Kiosk } from "./kiosk";
import { KEY_REFUSED, NO_STATION, OTHER_VERSION, ROLE_REFUSED, STATION_TAKEN } from "./socket";
import { LanguageAndLight } from "./switches";

export function ClosedScreen({ kiosk, code }: { kiosk: Kiosk; code: number }): JSX.Element {
  const say = words.value;
  const [title, detail] = reasonOf(code, say);
  const asksForKey = code === KEY_REFUSED || code === ROLE_REFUSED;
  return (
    <main class="start">
      <section class="start-card" role="alert" data-closed={code}>
        <p class="start-station">
          {say.kiosk_title} <b>{kiosk.station}</b>
        </p>
        <h1>{title}</h1>
        <p class="start-detail">{detail}</p>
        <div class="ask-answers">
          {code === OTHER_VERSION ? (
            <button type="button" class="act act-primary" onClick={() => window.location.reload()}>
              {say.closed_reload}
            </button>
          ) : (
            <button type="button" class="act act-primary" onClick={() => kiosk.retry()}>
              {say.closed_retry}
            </button>
          )}
          {asksForKey && (
            <button type="button" class="act" onClick={forgetKey}>
              {say.closed_other_key}
            </button>
          )}
        </div>
      </section>
      <div class="switches">
        <LanguageAndLight />
      </div>
    </main>
  );
}

function reasonOf(code: number, say: Words): [string, string] {
  switch (code) {
    case STATION_TAKEN:
      return [say.closed_taken, say.closed_taken_detail];
    case NO_STATION:
      return [say.closed_unknown, say.closed_unknown_detail];
    case ROLE_REFUSED:
      return [say.closed_role, say.closed_role_detail];
    case OTHER_VERSION:
      return [say.closed_version, say.closed_version_detail];
    case KEY_REFUSED:
      return [say.closed_key, say.closed_key_detail];
    default:
      return [say.closed_lost, say.closed_lost_detail];
  }
}
