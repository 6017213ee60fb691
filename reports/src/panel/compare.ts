// Two runs of the same kind over each other: tracking error and duty of both, and what their
// metrics make of it.
import uPlot from "uplot";

import { element, missingNote } from "../dom";
import { axisFont, currentTheme, dashes, fitWidth, lineSample, type LineRole, widths } from "../theme";
import { readable, tickText } from "../units";
import { loadText } from "./catalogue";

interface Log {
  time: Float64Array;
  columns: Map<string, Float64Array>;
}

interface Metric {
  name: string;
  window: string;
  value: number | null;
  unit: string;
}

const roles: LineRole[] = ["measured", "truth"];
const mostPoints = 4000;

function parse(text: string): Log {
  const lines = text.trimEnd().split("\n");
  const names = lines[0]!.split(",");
  const stride = Math.max(1, Math.ceil((lines.length - 1) / mostPoints));
  const kept = lines.slice(1).filter((_, i) => i % stride === 0);
  const columns = new Map(names.map((name) => [name, new Float64Array(kept.length)]));
  kept.forEach((line, row) => {
    const values = line.split(",");
    names.forEach((name, i) => (columns.get(name)![row] = Number(values[i])));
  });
  return { time: columns.get("time_s")!, columns };
}

function column(log: Log, axis: string, what: "error" | "duty"): (number | null)[] {
  if (what === "duty") return Array.from(log.columns.get(`${axis}_duty_pct`) ?? []);
  const reference = log.columns.get(`${axis}_reference_m`);
  const position = log.columns.get(`${axis}_position_m`);
  if (reference === undefined || position === undefined) return [];
  return Array.from(reference, (value, i) => (value - position[i]!) * 1e3);
}

// Each log's rows at the times of the first: both are sampled at the control rate from 0.
function aligned(time: Float64Array, log: Log, values: (number | null)[]): (number | null)[] {
  let at = 0;
  return Array.from(time, (t) => {
    while (at + 1 < log.time.length && log.time[at + 1]! <= t + 1e-9) ++at;
    return t > (log.time[log.time.length - 1] ?? -1) + 1e-9 ? null : (values[at] ?? null);
  });
}

function plot(title: string, unit: string, names: string[], logs: Log[], axis: string, what: "error" | "duty"): HTMLElement {
  const box = element("figure", "plot");
  const caption = element("figcaption");
  caption.append(element("strong", "", `${title}, ${unit}`));
  names.forEach((name, i) => {
    const entry = element("span", "entry");
    entry.append(lineSample(roles[i]!), element("span", "", name));
    caption.append(entry);
  });
  const host = element("div", "canvas-host");
  box.append(caption, host);
  const longest = logs[0]!.time.length >= logs[1]!.time.length ? logs[0]! : logs[1]!;
  const style = { stroke: () => currentTheme().muted, font: axisFont, grid: { stroke: () => currentTheme().grid, width: 1 } };
  const drawn = new uPlot(
    {
      width: 700,
      height: 220,
      legend: { show: false },
      scales: { x: { time: false } },
      axes: [
        { ...style, values: (_p, splits) => splits.map((s) => `${tickText(s)} s`) },
        { ...style, size: 58, values: (_p, splits) => splits.map(tickText) },
      ],
      series: [
        {},
        ...names.map((label, i) => ({
          label,
          stroke: () => currentTheme().line[roles[i]!],
          width: widths[roles[i]!],
          dash: dashes[roles[i]!],
        })),
      ],
    },
    [Array.from(longest.time), ...logs.map((log) => aligned(longest.time, log, column(log, axis, what)))] as uPlot.AlignedData,
    host,
  );
  fitWidth(host, () => drawn.width, (width) => drawn.setSize({ width, height: 220 }));
  return box;
}

function metricTable(names: string[], lists: Metric[][]): HTMLElement {
  const made = element("table");
  const head = element("tr");
  for (const text of ["Metric", "Window", ...names, "Second over first"]) head.append(element("th", "", text));
  made.append(head);
  for (const metric of lists[0]!) {
    const other = lists[1]!.find((one) => one.name === metric.name && one.window === metric.window);
    if (other === undefined || (metric.value === null && other.value === null)) continue;
    const row = element("tr");
    const ratio = metric.value && other.value !== null ? readable(other.value / metric.value) : "";
    const shown = [metric, other].map((one) => (one.value === null ? "none" : `${readable(one.value)} ${one.unit}`));
    for (const text of [metric.name, metric.window, ...shown, ratio]) row.append(element("td", "", text));
    made.append(row);
  }
  const wide = element("div", "wide");
  wide.append(made);
  return wide;
}

export async function compare(host: HTMLElement, names: [string, string]): Promise<void> {
  host.replaceChildren(element("p", "note", "reading both logs"));
  try {
    const logs = (await Promise.all(names.map((name) => loadText(`/runs/${name}/log.csv`)))).map(parse);
    const metrics = await Promise.all(names.map(async (name) => JSON.parse(await loadText(`/runs/${name}/metrics.json`)).metrics as Metric[]));
    host.replaceChildren(element("h2", "", "Compared"));
    for (const axis of ["y", "x"]) {
      host.append(
        plot(`${axis.toUpperCase()} tracking error`, "mm", names, logs, axis, "error"),
        plot(`${axis.toUpperCase()} duty`, "%", names, logs, axis, "duty"),
      );
    }
    host.append(metricTable(names, metrics));
  } catch (error) {
    host.replaceChildren(missingNote(`These two cannot be compared: ${String(error)}`));
  }
}
