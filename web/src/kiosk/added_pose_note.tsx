// Why a pose that is not of the set is asked for, as long as it is.
import { type JSX } from "preact";
import type { Run } from "../generated/protocol";
import type { Words } from "../words/en";
import { addedText } from "./help_text";

export function AddedPoseNote({ run, say }: { run: Run; say: Words }): JSX.Element | null {
  const wanted = run.poses.find((pose) => pose.pose_index === run.pose_index);
  const text = wanted === undefined ? null : addedText(wanted, say);
  return text === null ? null : (
    <p class="added-note" role="status">
      <b aria-hidden="true">+</b> {text}
    </p>
  );
}
