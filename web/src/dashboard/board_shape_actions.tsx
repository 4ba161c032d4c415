// What may be done with a board's shape: certify it or retire it, after a question.
import { type JSX } from "preact";
import { useState } from "preact/hooks";
import { certifyShape, retireShape } from "../api/client";
import type { BoardShape } from "../generated/api";
import { ProblemNotice } from "../shell/notices";
import { QuestionBox } from "../shell/question_box";
import { words } from "../words/language";
import { useAction } from "./use_action";

interface Props {
  board: string;
  shape: BoardShape;
  onChange: () => void;
}

export function BoardShapeActions({ board, shape, onChange }: Props): JSX.Element {
  const say = words.value;
  const [asked, setAsked] = useState<"certify" | "retire" | null>(null);
  const action = useAction();
  const change = (work: (id: string) => Promise<BoardShape>): void =>
    action.run(async () => {
      await work(shape.id);
      onChange();
    });
  const leave = (): void => setAsked(null);
  const isCertified = shape.state === "certified";
  return (
    <div class="review-actions panel-body board-actions">
      {!isCertified && (
        <button type="button" class="primary" disabled={action.isBusy} onClick={() => setAsked("certify")}>
          {say.shape_certify}
        </button>
      )}
      <button type="button" disabled={action.isBusy} onClick={() => setAsked("retire")}>
        {say.shape_retire}
      </button>
      {action.problem !== null && <ProblemNotice problem={action.problem} />}
      {asked === "certify" && (
        <QuestionBox
          title={say.shape_certify_ask}
          detail={say.shape_certify_detail(board)}
          yes={say.shape_certify}
          no={say.shape_leave}
          onYes={() => change(certifyShape)}
          onLeave={leave}
        />
      )}
      {asked === "retire" && (
        <QuestionBox
          title={say.shape_retire_ask}
          detail={isCertified ? say.shape_retire_certified(board) : say.shape_retire_draft}
          yes={say.shape_retire}
          no={say.shape_leave}
          onYes={() => change(retireShape)}
          onLeave={leave}
        />
      )}
    </div>
  );
}
