// One camera variant: the pose set in its image with what it promises, the nominal camera, limits, all pose sets.
import { type JSX } from "preact";
import { useCallback } from "preact/hooks";
import { getPoseSets, getSku } from "../api/client";
import { useResource } from "../api/use_resource";
import type { PoseSetSummary, SkuDetail, SkuRevision } from "../generated/api";
import { Empty, Loading, ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { LimitsPanel } from "./limits_panel";
import { NominalPanel } from "./nominal_panel";
import { PopulationPanel } from "./population_panel";
import { PoseSetView } from "./pose_set_view";
import { PoseSetsPanel } from "./pose_sets_panel";
import { PublicationTag } from "./publication_tag";
import { addressOf } from "./route";
import { useTitle } from "./use_title";

const REFRESH_MS = 5000;
const refresh = (): number => REFRESH_MS;

interface Loaded {
  sku: SkuDetail;
  poseSets: PoseSetSummary[];
}

export function SkuPage({ code, poseSet }: { code: string; poseSet: string }): JSX.Element {
  useTitle(code);
  const found = useResource(
    useCallback(
      async (signal: AbortSignal): Promise<Loaded> => {
        const [sku, sets] = await Promise.all([getSku(code, signal), getPoseSets(code, null, signal)]);
        return { sku, poseSets: sets.items };
      },
      [code],
    ),
    refresh,
  );
  if (found.state === "loading") return <Loading />;
  if (found.state === "failed") return <ProblemNotice problem={found.problem} />;
  return <Sku loaded={found.value} poseSet={poseSet} />;
}

function Sku({ loaded: { sku, poseSets }, poseSet }: { loaded: Loaded; poseSet: string }): JSX.Element {
  const say = words.value;
  const chosen = choosePoseSet(sku, poseSets, poseSet);
  const revision = chooseRevision(sku, chosen?.sku.revision);
  return (
    <>
      <div class="page-head">
        <h1>{sku.code}</h1>
        <span>{sku.name}</span>
        {revision !== undefined && (
          <span class="muted">
            {say.sku_revision(revision.number)} · <PublicationTag state={revision.state} />
          </span>
        )}
        <nav class="page-links" aria-label={sku.code}>
          <a href={addressOf({ page: "runs", filter: { sku: sku.code } })}>{say.sku_runs}</a>
          {revision !== undefined && (
            <a href={addressOf({ page: "target", spec: revision.document.target })}>
              {say.target_print_or_show}
            </a>
          )}
          <a href={addressOf({ page: "yield", sku: sku.code, station: "" })}>{say.nav_yield}</a>
        </nav>
      </div>
      {chosen === undefined || revision === undefined ? (
        <Empty title={say.pose_sets_none} detail={say.pose_sets_none_detail} />
      ) : (
        <PoseSetView key={chosen.id} id={chosen.id} document={revision.document} />
      )}
      {revision !== undefined && (
        <div class="columns columns-sku">
          <div class="column">
            <NominalPanel document={revision.document} />
            <PopulationPanel code={sku.code} revision={revision.number} />
          </div>
          <LimitsPanel code={sku.code} revision={revision.number} />
          <PoseSetsPanel
            code={sku.code}
            poseSets={poseSets}
            chosen={chosen?.id ?? ""}
            revision={sku.published_revision ?? sku.latest_revision}
          />
        </div>
      )}
    </>
  );
}

/** The set of the address, else the published one, else the newest. */
function choosePoseSet(
  sku: SkuDetail,
  poseSets: readonly PoseSetSummary[],
  wanted: string,
): PoseSetSummary | undefined {
  const byId = (id: string | undefined): PoseSetSummary | undefined => poseSets.find((set) => set.id === id);
  return byId(wanted) ?? byId(sku.published_pose_set?.id) ?? poseSets[0];
}

/** The revision that the pose set is for, else the published one, else the newest. */
function chooseRevision(sku: SkuDetail, wanted: number | undefined): SkuRevision | undefined {
  const number = wanted ?? sku.published_revision ?? sku.latest_revision;
  return sku.revisions.find((revision) => revision.number === number);
}
