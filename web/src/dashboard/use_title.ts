// What the browser's tab says: many runs may be open in many tabs.
import { useEffect } from "preact/hooks";
import { words } from "../words/language";

export function useTitle(subject: string): void {
  const { product } = words.value;
  useEffect(() => {
    document.title = `${subject} · ${product}`;
  }, [subject, product]);
}
