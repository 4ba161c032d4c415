// A chart of uPlot in a place of the page, as wide as the place is.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";

export interface PlotSize {
  width: number;
  height: number;
}

/** Put a chart into a place; what is returned takes it away. */
export function mountPlot(
  place: HTMLElement,
  height: number,
  options: (size: PlotSize) => uPlot.Options,
  data: uPlot.AlignedData,
): () => void {
  const plot = new uPlot(options({ width: place.clientWidth, height }), data, place);
  const observer = new ResizeObserver(() => {
    if (place.clientWidth !== plot.width) plot.setSize({ width: place.clientWidth, height });
  });
  observer.observe(place);
  return () => {
    observer.disconnect();
    plot.destroy();
  };
}
