// First-pass yield and verdicts by SKU, station or day; every number leads to the runs behind it.
import { type JSX } from "preact";
import { fixed } from "../format/numbers";
import { words } from "../words/language";
import { addressOf } from "./route";
import type { RunFilter } from "./run_filter";
import { StandingTag } from "./runs_table";
import { firstPassYield, runsOf, type Sums } from "./yield_sums";

const VERDICTS = ["PASS", "MARGINAL", "FAIL"] as const;

export interface YieldRow {
  name: string;
  /** Which runs the row is about. */
  filter: RunFilter;
  /** Where the name leads. */
  href?: string;
  sums: Sums;
}

interface Props {
  id: string;
  title: string;
  /** Name of the first column. */
  what: string;
  rows: readonly YieldRow[];
}

export function YieldTable({ id, title, what, rows }: Props): JSX.Element {
  const say = words.value;
  const most = Math.max(1, ...rows.map((row) => runsOf(row.sums)));
  return (
    <section class="panel" aria-labelledby={id}>
      <div class="panel-head">
        <h2 id={id}>{title}</h2>
      </div>
      <table class="yield">
        <thead>
          <tr>
            <th scope="col">{what}</th>
            <th scope="col" class="number">
              {say.yield_first_pass}
            </th>
            <th scope="col" class="number">
              {say.yield_of_first}
            </th>
            <th scope="col" class="wide-only" aria-hidden="true" />
            {VERDICTS.map((verdict) => (
              <th key={verdict} scope="col" class="number">
                <StandingTag standing={verdict} />
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {rows.map((row) => (
            <Row key={row.name} row={row} most={most} />
          ))}
        </tbody>
      </table>
    </section>
  );
}

function Row({ row, most }: { row: YieldRow; most: number }): JSX.Element {
  const { name, filter, href, sums } = row;
  return (
    <tr>
      <th scope="row">{href === undefined ? name : <a href={href}>{name}</a>}</th>
      <td class="number estimate">{shareText(firstPassYield(sums))}</td>
      <td class="number">
        <RunsLink count={sums.firstRuns} filter={{ ...filter, first: "true" }}>
          {sums.firstPassed} / {sums.firstRuns}
        </RunsLink>
      </td>
      <td class="yield-bar-cell wide-only" aria-hidden="true">
        <VerdictBar sums={sums} most={most} />
      </td>
      <VerdictCells sums={sums} filter={filter} />
    </tr>
  );
}

function VerdictCells({ sums, filter }: { sums: Sums; filter: RunFilter }): JSX.Element {
  const counted = { ...filter, counted: "true" };
  return (
    <>
      {(
        [
          ["PASS", sums.passed],
          ["MARGINAL", sums.marginal],
          ["FAIL", sums.failed],
        ] as const
      ).map(([verdict, count]) => (
        <td key={verdict} class="number">
          <RunsLink count={count} filter={{ ...counted, verdict }}>
            {count}
          </RunsLink>
        </td>
      ))}
    </>
  );
}

interface RunsLinkProps {
  count: number;
  filter: RunFilter;
  children: (string | number)[] | string | number;
}

/** A number that leads to its runs; nothing leads nowhere. */
export function RunsLink({ count, filter, children }: RunsLinkProps): JSX.Element {
  if (count === 0) return <span class="muted">{children}</span>;
  return <a href={addressOf({ page: "runs", filter })}>{children}</a>;
}

/** Digits as the number of runs deserves: 100 %, 98.5 %. */
export function shareText(share: number | null): string {
  if (share === null) return "–";
  return share === 0 || share === 1 ? `${fixed(100 * share, 0)} %` : `${fixed(100 * share, 1)} %`;
}

function VerdictBar({ sums, most }: { sums: Sums; most: number }): JSX.Element {
  const wide = (count: number): number => (100 * count) / most;
  return (
    <svg class="verdict-bar" viewBox="0 0 100 12" preserveAspectRatio="none">
      <rect class="verdict-bar-PASS" x="0" y="1" width={wide(sums.passed)} height="10" />
      <rect class="verdict-bar-MARGINAL" x={wide(sums.passed)} y="3" width={wide(sums.marginal)} height="6" />
      <rect
        class="verdict-bar-FAIL"
        x={wide(sums.passed + sums.marginal)}
        y="1"
        width={wide(sums.failed)}
        height="10"
      />
    </svg>
  );
}
