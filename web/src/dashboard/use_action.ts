// Something that is done at the service once, at a press: whether it is under way, and what it failed of.
import { useState } from "preact/hooks";
import { RequestFailed, type Problem } from "../api/problem";

export interface Action {
  isBusy: boolean;
  problem: Problem | null;
  run: (work: () => Promise<void>) => void;
}

export function useAction(): Action {
  const [isBusy, setBusy] = useState(false);
  const [problem, setProblem] = useState<Problem | null>(null);

  const attempt = async (work: () => Promise<void>): Promise<void> => {
    setBusy(true);
    setProblem(null);
    try {
      await work();
    } catch (error) {
      if (!(error instanceof RequestFailed)) throw error;
      setProblem(error.problem);
    } finally {
      setBusy(false);
    }
  };
  return { isBusy, problem, run: (work) => void attempt(work) };
}
