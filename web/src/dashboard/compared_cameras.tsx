// The cameras that two runs came to: parameters in sd of both, and how far their mappings are apart.
import { type JSX } from "preact";
import { useCallback } from "preact/hooks";
import { getComparison } from "../api/client";
import { useResource } from "../api/use_resource";
import { Loading, ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { ComparedMappings } from "./compared_mappings";
import { ComparedParameters } from "./compared_parameters";
import type { FinishedSide } from "./run_comparison_page";

export function ComparedCameras({ a, b }: { a: FinishedSide; b: FinishedSide }): JSX.Element {
  const say = words.value;
  const found = useResource(
    useCallback((signal: AbortSignal) => getComparison(a.id, b.id, signal), [a.id, b.id]),
  );
  if (found.state === "loading") return <Loading />;
  if (found.state === "failed") return <ProblemNotice problem={found.problem} />;
  const comparison = found.value;
  const { lens_a, lens_b } = comparison;
  return (
    <>
      {lens_a === lens_b ? (
        <ComparedParameters comparison={comparison} a={a.result} b={b.result} />
      ) : (
        <p class="notice notice-problem">{say.pair_lenses(lens_a, lens_b)}</p>
      )}
      <ComparedMappings comparison={comparison} />
    </>
  );
}
