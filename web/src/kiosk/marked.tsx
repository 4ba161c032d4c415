// A text in which *stars* mark the word that matters.
import { type JSX } from "preact";

export function Marked({ text }: { text: string }): JSX.Element {
  return (
    <>
      {text.split("*").map((part, i) => (i % 2 === 1 ? <b key={i}>{part}</b> : <span key={i}>{part}</span>))}
    </>
  );
}
