// The calibrations of a serial in numbers, newest first; each leads to its run, and to a comparison with this one.
import { type JSX } from "preact";
import type { PastCalibration } from "../generated/api";
import { digitsForSd, fixed } from "../format/numbers";
import { exactly, when } from "../format/times";
import { words } from "../words/language";
import { purposeName } from "../words/measurements";
import { QUANTITIES, quantityOf } from "./history_quantities";
import { addressOf } from "./route";
import { StandingTag } from "./runs_table";
import { WideTable } from "./wide_table";

interface Props {
  calibrations: readonly PastCalibration[];
  /** The run on show, if any. */
  here: string;
}

export function HistoryTable({ calibrations, here }: Props): JSX.Element {
  const say = words.value;
  return (
    <WideTable label={say.history_caption}>
      <table class="history">
        <caption class="visually-hidden">{say.history_caption}</caption>
        <thead>
          <tr>
            <th scope="col">{say.col_verdict}</th>
            <th scope="col">{say.col_when}</th>
            <th scope="col">{say.col_purpose}</th>
            {QUANTITIES.map((name) => (
              <th key={name} scope="col" class="number">
                {name === "rms" ? say.col_rms : name}
              </th>
            ))}
            {here !== "" && <th scope="col">{say.history_compare}</th>}
          </tr>
        </thead>
        <tbody>
          {[...calibrations].reverse().map((one) => (
            <Row key={one.run_id} one={one} here={here} />
          ))}
        </tbody>
      </table>
    </WideTable>
  );
}

function Row({ one, here }: { one: PastCalibration; here: string }): JSX.Element {
  const say = words.value;
  const isHere = one.run_id === here;
  const time = (
    <time dateTime={one.created_at} title={exactly(one.created_at)}>
      {when(one.created_at)}
    </time>
  );
  return (
    <tr class={isHere ? "chosen" : ""} aria-current={isHere ? "true" : undefined}>
      <td>
        <StandingTag standing={one.verdict} />
      </td>
      <th scope="row">
        {isHere ? time : <a href={addressOf({ page: "run", id: one.run_id, capture: "" })}>{time}</a>}
      </th>
      <td>{purposeName(one.purpose, say)}</td>
      {QUANTITIES.map((name) => {
        const { value, sd } = quantityOf(one, name);
        const digits = name === "rms" ? 4 : digitsForSd(sd);
        return (
          <td key={name} class="number">
            {fixed(value, digits)}
            {sd !== null && <small class="muted"> ± {fixed(sd, digits)}</small>}
          </td>
        );
      })}
      {here !== "" && (
        <td>
          {isHere ? (
            say.history_this
          ) : (
            <a
              href={addressOf({ page: "compare", a: one.run_id, b: here })}
              aria-label={say.history_compare_with(when(one.created_at))}
            >
              {say.history_compare}
            </a>
          )}
        </td>
      )}
    </tr>
  );
}
