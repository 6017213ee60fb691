// One plot over the last seconds.
import uPlot from "uplot";

import { element, setText } from "../dom";
import { axisFont, currentTheme, dashes, fitWidth, lineSample, type LineRole, onThemeChange, widths } from "../theme";
import { readable, tickText } from "../units";

export interface Line {
  label: string;
  role: LineRole;
  // From the columns of the log's history or of the truth's.
  of: (columns: (number | null)[][]) => (number | null)[];
}

export interface ScopeSpec {
  title: string;
  unit: string;
  lines: Line[];
}

const plotHeight = 150;

export class Scope {
  readonly box = element("figure", "scope");
  private readonly outputs: HTMLOutputElement[] = [];
  private readonly plot: uPlot;

  constructor(private readonly spec: ScopeSpec) {
    const caption = element("figcaption");
    caption.append(element("strong", "", `${spec.title}, ${spec.unit}`));
    const legend = element("span", "legend");
    for (const line of spec.lines) {
      const entry = element("span", "entry");
      const output = element("output");
      entry.append(lineSample(line.role), element("span", "", line.label), output);
      legend.append(entry);
      this.outputs.push(output);
    }
    caption.append(legend);
    const host = element("div", "canvas-host");
    this.box.append(caption, host);
    this.plot = this.makePlot(host);
    fitWidth(host, () => this.plot.width, (width) => this.plot.setSize({ width, height: plotHeight }));
    onThemeChange(() => this.plot.redraw(false, true));
  }

  show(columns: (number | null)[][]): void {
    const drawn = this.spec.lines.map((line) => line.of(columns));
    this.plot.setData([columns[0], ...drawn] as uPlot.AlignedData);
    drawn.forEach((values, i) => {
      const last = values[values.length - 1];
      setText(this.outputs[i]!, last == null ? "" : readable(last));
    });
  }

  private makePlot(host: HTMLElement): uPlot {
    const axis = {
      stroke: () => currentTheme().muted,
      font: axisFont,
      grid: { stroke: () => currentTheme().grid, width: 1 },
      ticks: { show: false },
    };
    return new uPlot(
      {
        width: 320,
        height: plotHeight,
        padding: [8, 8, 0, 0],
        legend: { show: false },
        cursor: { show: false },
        scales: { x: { time: false }, y: { range: (_p, low, high) => paddedRange(low, high) } },
        axes: [
          { ...axis, size: 24, values: (_p, splits) => splits.map((s) => `${tickText(s)} s`) },
          { ...axis, size: 52, space: 28, values: (_p, splits) => splits.map(tickText) },
        ],
        series: [
          {},
          ...this.spec.lines.map((line) => ({
            label: line.label,
            stroke: () => currentTheme().line[line.role],
            width: widths[line.role],
            dash: dashes[line.role],
            points: { show: false },
          })),
        ],
      },
      [[], ...this.spec.lines.map(() => [])] as uPlot.AlignedData,
      host,
    );
  }
}

function paddedRange(low: number | null, high: number | null): [number, number] {
  if (low === null || high === null) return [0, 1];
  const pad = (high - low || Math.abs(high) * 0.1 || 1e-3) * 0.08;
  return [low - pad, high + pad];
}
