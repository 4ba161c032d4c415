// What a page shows instead of its content: loading, nothing there, a problem.
import { type ComponentChildren, type JSX } from "preact";
import type { Problem } from "../api/problem";
import { words } from "../words/language";

export function Loading(): JSX.Element {
  return (
    <p class="notice notice-loading" role="status">
      <span class="spinner" aria-hidden="true" />
      {words.value.loading}
    </p>
  );
}

interface EmptyProps {
  title: string;
  detail: string;
  children?: ComponentChildren;
}

export function Empty({ title, detail, children }: EmptyProps): JSX.Element {
  return (
    <div class="notice notice-empty">
      <strong>{title}</strong>
      <p>{detail}</p>
      {children}
    </div>
  );
}

export function ProblemNotice({ problem }: { problem: Problem }): JSX.Element {
  const say = words.value;
  return (
    <div class="notice notice-problem" role="alert">
      <strong>{problem.title}</strong>
      {problem.detail !== "" && (
        // Problem documents come from the service, which speaks English.
        <p lang="en">{problem.detail}</p>
      )}
      {problem.errors.length > 0 && (
        <ul>
          {problem.errors.map((error) => (
            <li key={error.pointer}>
              <code>{error.pointer}</code> {error.detail}
            </li>
          ))}
        </ul>
      )}
      <p class="muted">
        {say.problem_code(problem.code)}
        {problem.traceId !== null && ` · ${say.problem_trace(problem.traceId)}`}
      </p>
    </div>
  );
}
