// The camera variants: which revision and which pose set new runs use.
import { type JSX } from "preact";
import { allParts } from "../api/all_parts";
import { getSkus } from "../api/client";
import { useResource } from "../api/use_resource";
import { when } from "../format/times";
import type { Sku } from "../generated/api";
import { Empty, Loading, ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { addressOf } from "./route";
import { useTitle } from "./use_title";

const REFRESH_MS = 10_000;
const refresh = (): number => REFRESH_MS;

async function load(signal: AbortSignal): Promise<Sku[]> {
  const skus = await allParts((cursor) => getSkus(cursor, signal));
  return skus.sort((a, b) => a.code.localeCompare(b.code, "en", { numeric: true }));
}

export function SkusPage(): JSX.Element {
  const say = words.value;
  useTitle(say.skus_title);
  const skus = useResource(load, refresh);
  return (
    <>
      <div class="page-head">
        <h1>{say.skus_title}</h1>
      </div>
      {skus.state === "loading" && <Loading />}
      {skus.state === "failed" && <ProblemNotice problem={skus.problem} />}
      {skus.state === "ready" && skus.value.length === 0 && (
        <Empty title={say.skus_none} detail={say.skus_none_detail} />
      )}
      {skus.state === "ready" && skus.value.length > 0 && <SkusTable skus={skus.value} />}
    </>
  );
}

function SkusTable({ skus }: { skus: readonly Sku[] }): JSX.Element {
  const say = words.value;
  return (
    <section class="panel" aria-label={say.skus_title}>
      <table class="runs">
        <thead>
          <tr>
            <th scope="col">{say.col_sku}</th>
            <th scope="col">{say.col_name}</th>
            <th scope="col">{say.col_published}</th>
            <th scope="col">{say.col_pose_set}</th>
            <th scope="col" class="number wide-only">
              {say.col_created}
            </th>
          </tr>
        </thead>
        <tbody>
          {skus.map((sku) => (
            <tr key={sku.id}>
              <th scope="row">
                <a class="row-link" href={addressOf({ page: "sku", code: sku.code, poseSet: "" })}>
                  {sku.code}
                </a>
              </th>
              <td>{sku.name}</td>
              <td>
                <Published sku={sku} />
              </td>
              <td>
                {sku.published_pose_set === null ? (
                  <span class="muted">{say.sku_no_pose_set}</span>
                ) : (
                  say.sku_poses(sku.published_pose_set.poses)
                )}
              </td>
              <td class="number wide-only">{when(sku.created_at)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}

function Published({ sku }: { sku: Sku }): JSX.Element {
  const say = words.value;
  if (sku.published_revision === null) return <span class="muted">{say.sku_not_published}</span>;
  return (
    <>
      {say.sku_revision(sku.published_revision)}
      {sku.latest_revision > sku.published_revision && (
        <span class="muted"> · {say.sku_newer_draft(sku.latest_revision)}</span>
      )}
    </>
  );
}
