// Asks once before something is changed that everybody works with.
import { type JSX } from "preact";
import { useEffect, useId, useRef } from "preact/hooks";

interface Props {
  title: string;
  detail: string;
  yes: string;
  no: string;
  onYes: () => void;
  onLeave: () => void;
}

export function QuestionBox({ title, detail, yes, no, onYes, onLeave }: Props): JSX.Element {
  const dialog = useRef<HTMLDialogElement>(null);
  const id = useId();

  useEffect(() => {
    dialog.current?.showModal();
  }, []);

  const answer = (): void => {
    onLeave();
    onYes();
  };
  return (
    <dialog ref={dialog} class="question" aria-labelledby={id} onClose={onLeave}>
      <h2 id={id}>{title}</h2>
      <p>{detail}</p>
      <div class="question-answers">
        <button type="button" autofocus onClick={onLeave}>
          {no}
        </button>
        <button type="button" class="primary" onClick={answer}>
          {yes}
        </button>
      </div>
    </dialog>
  );
}
