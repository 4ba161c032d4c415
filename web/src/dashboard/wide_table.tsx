// A table that may be wider than the screen: it scrolls by itself, by keys too.
import { type ComponentChildren, type JSX } from "preact";

export function WideTable({ label, children }: { label: string; children: ComponentChildren }): JSX.Element {
  return (
    <div class="wide-table" tabIndex={0} role="group" aria-label={label}>
      {children}
    </div>
  );
}
