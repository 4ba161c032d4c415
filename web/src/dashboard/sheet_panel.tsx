// A target's sheet to print: on which paper, as which file.
import { type JSX } from "preact";
import { useId, useState } from "preact/hooks";
import { getSheet } from "../api/client";
import { saveFile } from "../shell/files";
import { ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { useAction } from "./use_action";

const AUTO = "auto";
const OWN = "own";
const PAPERS = ["A4", "A3", "A2", "A1", "A0"];

export function SheetPanel({ spec }: { spec: string }): JSX.Element {
  const say = words.value;
  const choice = useId();
  const [paper, setPaper] = useState(AUTO);
  const [own, setOwn] = useState("");
  const action = useAction();
  const download = (format: "pdf" | "svg"): void =>
    action.run(async () => {
      const { name, content } = await getSheet(spec, format, paper === OWN ? own : paper);
      saveFile(name, content);
    });
  return (
    <section class="panel" aria-labelledby="sheet-title">
      <div class="panel-head">
        <h2 id="sheet-title">{say.sheet_title}</h2>
      </div>
      <div class="panel-body target-steps">
        <p>{say.sheet_detail}</p>
        <div class="target-row">
          <span class="choice">
            <label for={choice}>{say.sheet_paper}</label>
            <select id={choice} value={paper} onChange={(event) => setPaper(event.currentTarget.value)}>
              <option value={AUTO}>{say.sheet_paper_auto}</option>
              {PAPERS.map((name) => (
                <option key={name} value={name}>
                  {name}
                </option>
              ))}
              <option value={OWN}>{say.sheet_paper_own}</option>
            </select>
          </span>
          {paper === OWN && (
            <input
              type="search"
              maxLength={20}
              spellcheck={false}
              aria-label={say.sheet_paper_own_label}
              placeholder={say.sheet_paper_own_hint}
              value={own}
              onInput={(event) => setOwn(event.currentTarget.value)}
            />
          )}
        </div>
        <div class="target-row">
          <button type="button" class="primary" disabled={action.isBusy} onClick={() => download("pdf")}>
            {say.sheet_pdf}
          </button>
          <button type="button" disabled={action.isBusy} onClick={() => download("svg")}>
            {say.sheet_svg}
          </button>
        </div>
        {action.problem !== null && <ProblemNotice problem={action.problem} />}
      </div>
    </section>
  );
}
