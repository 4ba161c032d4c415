// Has a board's shape learnt from its last runs: asks for the job, follows it, and says when it is done.
import { type JSX } from "preact";
import { useEffect, useId, useState } from "preact/hooks";
import { getJob, learnShape } from "../api/client";
import { problemFrom, RequestFailed } from "../api/problem";
import type { Job } from "../generated/api";
import { percent } from "../format/numbers";
import { ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { useAction } from "./use_action";

const FOLLOW_MS = 500;
const FEWEST = 5;
const USUAL = 50;
const MOST = 200;

interface Props {
  /** Its id. */
  board: string;
  onLearnt: () => void;
}

export function BoardLearning({ board, onLearnt }: Props): JSX.Element {
  const say = words.value;
  const field = useId();
  const [runs, setRuns] = useState(String(USUAL));
  const [progress, setProgress] = useState<number | null>(null);
  const [abort] = useState(() => new AbortController());
  useEffect(() => () => abort.abort(), [abort]);
  const action = useAction();
  const submit = (event: SubmitEvent): void => {
    event.preventDefault();
    action.run(async () => {
      try {
        await follow(await learnShape(board, Number(runs)), setProgress, abort.signal);
        if (!abort.signal.aborted) onLearnt();
      } finally {
        setProgress(null);
      }
    });
  };
  return (
    <section class="panel" aria-labelledby="learn-title">
      <div class="panel-head">
        <h2 id="learn-title">{say.learn_title}</h2>
      </div>
      <form class="panel-body learn-form" onSubmit={submit}>
        <p class="muted">{say.learn_detail}</p>
        <label for={field}>{say.learn_runs}</label>
        <input
          id={field}
          type="number"
          required
          min={FEWEST}
          max={MOST}
          step={1}
          value={runs}
          onInput={(event) => setRuns(event.currentTarget.value)}
        />
        <button type="submit" disabled={action.isBusy}>
          {say.learn_start}
        </button>
        <span role="status">{progress !== null && say.learn_running(percent(progress))}</span>
        {action.problem !== null && <ProblemNotice problem={action.problem} />}
      </form>
    </section>
  );
}

/** Until the job is done; raises what it failed of. */
async function follow(job: Job, tell: (progress: number) => void, signal: AbortSignal): Promise<void> {
  let now = job;
  while (now.state === "queued" || now.state === "running") {
    tell(now.progress);
    await new Promise((go) => window.setTimeout(go, FOLLOW_MS));
    // Who left the page does not want to know.
    if (signal.aborted) return;
    now = await getJob(job.id);
  }
  if (now.state === "failed" || now.state === "cancelled") {
    const status = Number(now.problem?.["status"] ?? 500);
    throw new RequestFailed(problemFrom(status, now.problem));
  }
}
