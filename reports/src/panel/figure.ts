// One uPlot figure with its caption: lines over an ascending x, or dots anywhere.
import uPlot from "uplot";

import { element } from "../dom";
import { axisFont, currentTheme, dashes, fitWidth, lineSample, type LineRole, onThemeChange, widths } from "../theme";
import { tickText } from "../units";

export interface Curve {
  label: string;
  role: LineRole;
  values: (number | null)[];
}

export interface FigureSpec {
  title: string;
  xUnit: string;
  unit: string;
  x: number[];
  curves: Curve[];
  dots?: boolean;
  note?: string;
}

const height = 230;
const dotSizes: Partial<Record<LineRole, number>> = { measured: 3, truth: 5 };

export function figure(spec: FigureSpec): HTMLElement {
  const box = element("figure", "plot");
  const caption = element("figcaption");
  caption.append(element("strong", "", `${spec.title}, ${spec.unit}`));
  for (const curve of spec.curves) {
    const entry = element("span", "entry");
    entry.append(lineSample(curve.role), element("span", "", curve.label));
    caption.append(entry);
  }
  const host = element("div", "canvas-host");
  box.append(caption, host);
  if (spec.note !== undefined) box.append(element("p", "note", spec.note));
  const style = { stroke: () => currentTheme().muted, font: axisFont, grid: { stroke: () => currentTheme().grid, width: 1 } };
  const drawn = new uPlot(
    {
      width: 700,
      height,
      legend: { show: false },
      cursor: { drag: { x: true, y: false } },
      scales: { x: { time: false } },
      axes: [
        { ...style, values: (_p, splits) => splits.map((s) => `${tickText(s)} ${spec.xUnit}`), space: 70 },
        { ...style, size: 58, values: (_p, splits) => splits.map(tickText) },
      ],
      series: [{}, ...spec.curves.map((curve) => series(curve, spec.dots ?? false))],
    },
    [spec.x, ...spec.curves.map((curve) => curve.values)] as uPlot.AlignedData,
    host,
  );
  fitWidth(host, () => drawn.width, (width) => drawn.setSize({ width, height }));
  onThemeChange(() => drawn.redraw(false, true));
  return box;
}

// As dots the two are told apart by size: the first lies behind the second.
function series(curve: Curve, dots: boolean): uPlot.Series {
  const colour = () => currentTheme().line[curve.role];
  if (dots) {
    return {
      label: curve.label,
      stroke: colour,
      paths: () => null,
      points: { show: true, size: dotSizes[curve.role] ?? 4, width: 1, stroke: colour, fill: "transparent" },
    };
  }
  return {
    label: curve.label,
    stroke: colour,
    width: widths[curve.role],
    dash: dashes[curve.role],
    points: { show: false },
    spanGaps: false,
  };
}
