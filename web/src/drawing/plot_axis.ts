// How the axes of uPlot's charts look. Not here: what they say.
import type { Colours } from "./drawing";

export function plotAxis(colours: Colours) {
  return {
    stroke: colours("plot-axis"),
    grid: { stroke: colours("plot-grid"), width: 1 },
    ticks: { stroke: colours("plot-grid"), width: 1, size: 4 },
    font: `11px ${getComputedStyle(document.body).fontFamily}`,
  };
}
