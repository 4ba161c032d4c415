// What may be done with a pose set: publish it or retire it, after a question, and take it away as a file.
import { type JSX } from "preact";
import { useState } from "preact/hooks";
import { exportPoseSet, publishPoseSet, retirePoseSet } from "../api/client";
import { isEngineer } from "../api/own_role";
import type { PoseSet } from "../generated/api";
import { saveFile } from "../shell/files";
import { ProblemNotice } from "../shell/notices";
import { QuestionBox } from "../shell/question_box";
import { words } from "../words/language";
import { useAction } from "./use_action";

interface Props {
  set: PoseSet;
  onChange: (set: PoseSet) => void;
}

export function ReviewActions({ set, onChange }: Props): JSX.Element {
  const say = words.value;
  const [asked, setAsked] = useState<"publish" | "retire" | null>(null);
  const action = useAction();
  const change = (work: (id: string) => Promise<PoseSet>): void =>
    action.run(async () => onChange(await work(set.id)));
  const download = (): void =>
    action.run(async () => {
      const { name, content } = await exportPoseSet(set.id);
      saveFile(name, content);
    });
  const isPlanned = set.poses.length > 0;
  const mayChange = isEngineer.value;
  const leave = (): void => setAsked(null);
  return (
    <div class="review-actions">
      {mayChange && set.state === "draft" && isPlanned && (
        <button type="button" class="primary" disabled={action.isBusy} onClick={() => setAsked("publish")}>
          {say.review_publish}
        </button>
      )}
      {mayChange && set.state === "published" && (
        <button type="button" disabled={action.isBusy} onClick={() => setAsked("retire")}>
          {say.review_retire}
        </button>
      )}
      {isPlanned && (
        <button type="button" disabled={action.isBusy} onClick={download}>
          {say.review_download}
        </button>
      )}
      {action.problem !== null && <ProblemNotice problem={action.problem} />}
      {asked === "publish" && (
        <QuestionBox
          title={say.review_publish_ask}
          detail={say.review_publish_detail(set.sku.code, set.sku.revision)}
          yes={say.review_publish}
          no={say.review_no}
          onYes={() => change(publishPoseSet)}
          onLeave={leave}
        />
      )}
      {asked === "retire" && (
        <QuestionBox
          title={say.review_retire_ask}
          detail={say.review_retire_detail(set.sku.code)}
          yes={say.review_retire}
          no={say.review_no}
          onYes={() => change(retirePoseSet)}
          onLeave={leave}
        />
      )}
    </div>
  );
}
