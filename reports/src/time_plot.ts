// One plot over time: canvas, legend with read-out, keyboard.
import uPlot from "uplot";

import { extentOf, type EventMark } from "./data";
import { element, missingNote } from "./dom";
import type { Curve, Figure } from "./figures";
import { drawEvents, drawGuides, drawSpans, drawUnit, drawWords, type Span } from "./marks";
import { axisFont, currentTheme, dashes, fitWidth, lineSample, onThemeChange, widths } from "./theme";
import type { TimeGroup } from "./time_group";
import { type DisplayUnit, displayUnit, readableWithUnit, tickText } from "./units";

export interface Marks {
  events: EventMark[];
  spans: Span[];
}

const steps = uPlot.paths.stepped!({ align: 1 });
const lines = uPlot.paths.linear!();

// Steps where ticks can be told apart. Further out, lines: uPlot draws those with the smallest and
// largest value of each pixel column, so that no peak is lost.
const held: uPlot.Series.PathBuilder = (plot, series, from, to) =>
  (to - from < plot.over.clientWidth / 2 ? steps : lines)(plot, series, from, to);

function height(width: number): number {
  return width < 520 ? 190 : 230;
}

function yRange(figure: Figure, guides: number[]): uPlot.Range.Function {
  return (_plot, dataMin, dataMax) => {
    if (dataMin === null || dataMax === null) return [0, 1];
    let low = Math.min(dataMin, ...guides, ...(figure.zero ? [0] : []));
    let high = Math.max(dataMax, ...guides, ...(figure.zero ? [0] : []));
    const span = high - low || Math.abs(high) * 0.1 || 1;
    const pad = span * (guides.length > 0 ? 0.16 : 0.08); // guides need room for their labels
    low -= figure.zero && low === 0 ? 0 : pad;
    high += figure.zero && high === 0 ? 0 : pad;
    return [low, high];
  };
}

// A curve that is alone needs no name beside the plot's own.
function legendEntry(curve: Curve, alone: boolean): { entry: HTMLElement; output: HTMLOutputElement } {
  const entry = element("span", "entry");
  const output = element("output");
  if (!alone) entry.append(lineSample(curve.role), element("span", "", curve.label));
  entry.append(output);
  return { entry, output };
}

// "largest 310 µm at 3.214 s", where the size of the curve is what matters.
function largestNote(curve: Curve, time: Float64Array, unit: DisplayUnit): string {
  let at = -1;
  curve.values.forEach((value, row) => {
    if (Math.abs(value) > Math.abs(at < 0 ? 0 : curve.values[at]!)) at = row;
  });
  if (at < 0) return "";
  const size = readableWithUnit(Math.abs(curve.values[at]!) * unit.perSi, unit);
  return `${curve.label}: largest ${size} at ${time[at]!.toFixed(3)} s`;
}

function describedFor(figure: Figure): string {
  const labels = figure.curves.map((curve) => curve.label).join(", ");
  return `${figure.title} over time: ${labels}. Arrow keys move the cursor, plus and minus zoom, 0 resets.`;
}

export function addTimePlot(host: HTMLElement, figure: Figure, group: TimeGroup, marks: Marks): void {
  const box = element("figure", "plot");
  box.dataset.plot = figure.id;
  host.append(box);
  const caption = element("figcaption");
  caption.append(element("strong", "", figure.title));
  box.append(caption);

  const drawn = figure.curves.filter((curve) => extentOf(curve.values) !== null);
  if (drawn.length === 0) {
    box.append(missingNote(figure.empty || `${figure.title}: the log holds no value.`));
    return;
  }
  const largest = Math.max(
    ...drawn.flatMap((curve) => {
      const extent = extentOf(curve.values)!;
      return [Math.abs(extent.min), Math.abs(extent.max)];
    }),
  );
  const unit = displayUnit(figure.unit, largest);
  const legend = element("span", "legend");
  const outputs = drawn.map((curve) => {
    const { entry, output } = legendEntry(curve, drawn.length === 1);
    legend.append(entry);
    return output;
  });
  caption.append(legend);
  const canvasHost = element("div", "canvas-host");
  box.append(canvasHost);
  if (figure.showLargest) {
    const notes = drawn.map((curve) => largestNote(curve, group.time, unit)).filter((n) => n !== "");
    box.append(element("p", "note", notes.join("; ")));
  }
  box.tabIndex = 0;
  box.setAttribute("role", "group");
  box.setAttribute("aria-label", describedFor(figure));

  const plot = makePlot(canvasHost, figure, drawn, unit, group, marks);
  group.add(plot);
  group.onCursor((row) => {
    drawn.forEach((curve, i) => {
      const value = row === null ? NaN : curve.values[row]! * unit.perSi;
      outputs[i]!.textContent = row === null ? "" : readableWithUnit(value, unit);
    });
  });
  box.addEventListener("keydown", (event) => onKey(event, plot, group));
  const resize = (width: number) => plot.setSize({ width, height: height(width) });
  fitWidth(canvasHost, () => plot.width, resize);
  onThemeChange(() => plot.redraw(false, true));
}

function makePlot(
  canvasHost: HTMLElement,
  figure: Figure,
  drawn: Curve[],
  unit: DisplayUnit,
  group: TimeGroup,
  marks: Marks,
): uPlot {
  const guides = figure.guides.map((guide) => ({ ...guide, value: guide.value * unit.perSi }));
  const gapped = (values: Float64Array) =>
    Array.from(values, (value) => (Number.isNaN(value) ? null : value * unit.perSi));
  const hasDataInView = (plot: uPlot) =>
    drawn.some((_, i) => {
      const [from, to] = plot.series[0]!.idxs!;
      return (plot.data[i + 1] as (number | null)[]).slice(from, to + 1).some((v) => v !== null);
    });
  const width = canvasHost.clientWidth || 640;
  const axis = {
    stroke: () => currentTheme().muted,
    font: axisFont,
    grid: { stroke: () => currentTheme().grid, width: 1 },
    ticks: { stroke: () => currentTheme().grid, width: 1, size: 4 },
  };
  const options: uPlot.Options = {
    width,
    height: height(width),
    padding: [24, 16, 0, 0],
    legend: { show: false },
    scales: {
      x: { time: false, range: (_p, min, max) => [min ?? group.full.from, max ?? group.full.to] },
      y: { range: yRange(figure, guides.map((guide) => guide.value)) },
    },
    axes: [
      { ...axis, size: 28, space: 64, values: (_p, splits) => splits.map((s) => `${tickText(s)} s`) },
      { ...axis, size: 58, space: 36, values: (_p, splits) => splits.map(tickText) },
    ],
    series: [
      {},
      ...drawn.map((curve): uPlot.Series => ({
        label: curve.label,
        scale: "y",
        stroke: () => currentTheme().line[curve.role],
        width: widths[curve.role],
        dash: dashes[curve.role],
        points: { show: false },
        paths: figure.held ? held : lines,
      })),
    ],
    cursor: {
      y: false,
      drag: { x: true, y: false, setScale: true },
      sync: { key: group.syncKey, scales: ["x", null], setSeries: false },
      points: { size: 6 },
    },
    hooks: {
      drawClear: [(plot) => drawSpans(plot, marks.spans, currentTheme())],
      draw: [
        (plot) => {
          const theme = currentTheme();
          drawGuides(plot, guides, theme);
          drawEvents(plot, marks.events, theme);
          drawUnit(plot, unit.name, theme);
          if (!hasDataInView(plot)) drawWords(plot, "no value in this stretch of time", theme);
        },
      ],
      setCursor: [(plot) => group.cursorAt(plot.cursor.idx ?? null)],
      setScale: [
        (plot, key) => {
          const { min, max } = plot.scales.x!;
          if (key === "x" && min != null && max != null) group.show({ from: min, to: max });
        },
      ],
    },
  };
  const data = [Array.from(group.time), ...drawn.map((curve) => gapped(curve.values))];
  const plot = new uPlot(options, data as uPlot.AlignedData, canvasHost);
  const { from, to } = group.visible;
  plot.setScale("x", { min: from, max: to });
  plot.over.addEventListener(
    "touchmove",
    (event) => {
      const touch = event.touches[0];
      if (touch === undefined || event.touches.length > 1) return;
      const box = plot.over.getBoundingClientRect();
      plot.setCursor({ left: touch.clientX - box.left, top: touch.clientY - box.top });
    },
    { passive: true },
  );
  return plot;
}

function onKey(event: KeyboardEvent, plot: uPlot, group: TimeGroup): void {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const actions: Record<string, () => void> = {
    ArrowLeft: () => group.stepCursor(plot, event.shiftKey ? -20 : -1),
    ArrowRight: () => group.stepCursor(plot, event.shiftKey ? 20 : 1),
    PageUp: () => group.pan(-0.5),
    PageDown: () => group.pan(0.5),
    "+": () => group.zoom(0.5),
    "=": () => group.zoom(0.5),
    "-": () => group.zoom(2),
    "0": () => group.reset(),
    Escape: () => group.reset(),
  };
  const action = actions[event.key];
  if (action === undefined) return;
  event.preventDefault();
  action();
}
