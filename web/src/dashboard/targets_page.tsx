// The boards of the plant, and the way to print or show any target.
import { type JSX } from "preact";
import { useId, useState } from "preact/hooks";
import { allParts } from "../api/all_parts";
import { getTargets } from "../api/client";
import { useResource } from "../api/use_resource";
import { when } from "../format/times";
import type { Target } from "../generated/api";
import { Empty, Loading, ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { addressOf } from "./route";
import { useTitle } from "./use_title";

async function load(signal: AbortSignal): Promise<Target[]> {
  return allParts((cursor) => getTargets(cursor, signal));
}

export function TargetsPage(): JSX.Element {
  const say = words.value;
  useTitle(say.targets_title);
  const targets = useResource(load);
  return (
    <>
      <div class="page-head">
        <h1>{say.targets_title}</h1>
      </div>
      <AnyTarget />
      {targets.state === "loading" && <Loading />}
      {targets.state === "failed" && <ProblemNotice problem={targets.problem} />}
      {targets.state === "ready" && targets.value.length === 0 && (
        <Empty title={say.targets_none} detail={say.targets_none_detail} />
      )}
      {targets.state === "ready" && targets.value.length > 0 && <TargetsTable targets={targets.value} />}
    </>
  );
}

function AnyTarget(): JSX.Element {
  const say = words.value;
  const field = useId();
  const [spec, setSpec] = useState("");
  const open = (event: SubmitEvent): void => {
    event.preventDefault();
    window.location.hash = addressOf({ page: "target", spec: spec.trim() });
  };
  return (
    <form class="search target-search" onSubmit={open}>
      <label for={field}>{say.targets_name}</label>
      <input
        id={field}
        type="search"
        required
        maxLength={60}
        pattern=".*\S.*"
        spellcheck={false}
        autocomplete="off"
        placeholder={say.targets_name_hint}
        value={spec}
        onInput={(event) => setSpec(event.currentTarget.value)}
      />
      <button type="submit">{say.targets_open}</button>
    </form>
  );
}

function TargetsTable({ targets }: { targets: readonly Target[] }): JSX.Element {
  const say = words.value;
  return (
    <section class="panel" aria-label={say.targets_registered}>
      <table class="runs">
        <thead>
          <tr>
            <th scope="col">{say.col_serial}</th>
            <th scope="col">{say.col_pattern}</th>
            <th scope="col">{say.station_board_open}</th>
            <th scope="col" class="number wide-only">
              {say.col_created}
            </th>
          </tr>
        </thead>
        <tbody>
          {targets.map((target) => (
            <tr key={target.id}>
              <th scope="row">
                <a class="row-link" href={addressOf({ page: "target", spec: target.spec })}>
                  {target.serial ?? <span class="muted">{say.targets_no_serial}</span>}
                </a>
              </th>
              <td>
                <code>{target.spec}</code>
              </td>
              <td>
                <a
                  class="over-row"
                  href={addressOf({ page: "board", board: target.id, shape: "" })}
                  aria-label={say.station_board_open_of(target.serial ?? target.spec)}
                >
                  {say.station_board_open}
                </a>
              </td>
              <td class="number wide-only">{when(target.created_at)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}
