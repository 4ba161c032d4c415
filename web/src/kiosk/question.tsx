// Asks once before something is given up: the run, or a capture.
import { type JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { words } from "../words/language";
import type { Kiosk } from "./kiosk";

export function QuestionBox({ kiosk }: { kiosk: Kiosk }): JSX.Element | null {
  const say = words.value;
  const question = kiosk.question.value;
  const { run } = kiosk.state.value;
  if (question === null || run === null) return null;
  // A dialog says that it is closed a moment after it is: by then another question may be open.
  const leave = (): void => {
    if (kiosk.question.value === question) kiosk.question.value = null;
  };
  if (question.kind === "abort") {
    return (
      <Ask
        title={say.abort_title}
        detail={say.abort_detail(run.captured.length)}
        yes={say.abort_yes}
        no={say.abort_no}
        onYes={() => kiosk.abort()}
        onLeave={leave}
      />
    );
  }
  const number = 1 + run.poses.findIndex((pose) => pose.pose_index === question.pose_index);
  return (
    <Ask
      title={say.retake_title(number)}
      detail={say.retake_detail}
      yes={say.retake_yes}
      no={say.abort_no}
      onYes={() => kiosk.retake(question.pose_index)}
      onLeave={leave}
    />
  );
}

interface AskProps {
  title: string;
  detail: string;
  yes: string;
  no: string;
  onYes: () => void;
  onLeave: () => void;
}

function Ask({ title, detail, yes, no, onYes, onLeave }: AskProps): JSX.Element {
  const dialog = useRef<HTMLDialogElement>(null);

  useEffect(() => {
    dialog.current?.showModal();
  }, []);

  const answer = (): void => {
    onLeave();
    onYes();
  };
  return (
    <dialog ref={dialog} class="ask" aria-labelledby="ask-title" onClose={onLeave}>
      <h2 id="ask-title">{title}</h2>
      <p>{detail}</p>
      <div class="ask-answers">
        <button type="button" class="act act-primary" autofocus onClick={onLeave}>
          {no}
        </button>
        <button type="button" class="act act-abort" onClick={answer}>
          {yes}
        </button>
      </div>
    </dialog>
  );
}
