// Two runs of the same kind over each other: tracking error and duty of both, and what their
// metrics make of it.
import { element, missingNote } from "../dom";
import type { LineRole } from "../theme";
import { displayUnit, type DisplayUnit, readable, readableWithUnit } from "../units";
import { loadText } from "./catalogue";
import { column, type Log, parseLog } from "./csv";
import { figure } from "./figure";
import { axisNames } from "./wire";

interface Metric {
  name: string;
  window: string;
  value: number | null;
  unit: string;
  meaning?: string;
}

const roles: LineRole[] = ["measured", "truth"];
const mostPoints = 4000;

function curve(log: Log, axis: string, what: "error" | "duty"): (number | null)[] {
  if (what === "duty") return Array.from(column(log, `${axis}_duty_pct`));
  const position = column(log, `${axis}_position_m`);
  return Array.from(column(log, `${axis}_reference_m`), (value, i) => (value - position[i]!) * 1e3);
}

// Each log's rows at the times of the first: both are sampled at the control rate from 0.
function aligned(time: Float64Array, log: Log, values: (number | null)[]): (number | null)[] {
  const own = column(log, "time_s");
  let at = 0;
  return Array.from(time, (t) => {
    while (at + 1 < own.length && own[at + 1]! <= t + 1e-9) ++at;
    return t > (own[own.length - 1] ?? -1) + 1e-9 ? null : (values[at] ?? null);
  });
}

function plot(title: string, unit: string, names: string[], logs: Log[], axis: string, what: "error" | "duty"): HTMLElement {
  const [first, second] = logs.map((log) => column(log, "time_s")) as [Float64Array, Float64Array];
  const longest = first.length >= second.length ? first : second;
  return figure({
    title,
    unit,
    xUnit: "s",
    x: Array.from(longest),
    curves: logs.map((log, i) => ({ label: names[i]!, role: roles[i]!, values: aligned(longest, log, curve(log, axis, what)) })),
  });
}

interface Check {
  name: string;
  window: string;
}

// In a unit that leaves few digits before the point.
function shownValue(metric: Metric): string {
  if (metric.value === null) return "none";
  return readableWithUnit(...scaled(metric.value, metric.unit));
}

function scaled(value: number, unitSi: string): [number, DisplayUnit] {
  const size = Math.abs(value);
  if (unitSi === "s" && size > 0 && size < 1) {
    const unit = size < 1e-3 ? { name: "µs", perSi: 1e6 } : { name: "ms", perSi: 1e3 };
    return [value * unit.perSi, unit];
  }
  const unit = displayUnit(unitSi, size);
  return [value * unit.perSi, unit];
}

// What a budget judges first, by its meaning; the others behind a fold, open where none is judged.
function metricTables(names: string[], lists: Metric[][], checks: Check[]): HTMLElement[] {
  const isJudged = (one: Metric) => checks.some((check) => check.name === one.name && (check.window || "whole") === one.window);
  const judged = lists.map((list) => list.filter(isJudged));
  const others = lists.map((list) => list.filter((one) => !isJudged(one)));
  const rest = element("details");
  rest.append(element("summary", "", `All other metrics (${others[0]!.length})`), metricTable(names, others));
  rest.open = judged[0]!.length === 0;
  return rest.open ? [rest] : [metricTable(names, judged), rest];
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
    const shown = [metric, other].map(shownValue);
    for (const text of [metric.meaning || metric.name, metric.window, ...shown, ratio]) row.append(element("td", "", text));
    made.append(row);
  }
  const wide = element("div", "wide");
  wide.append(made);
  return wide;
}

export async function compare(host: HTMLElement, names: [string, string]): Promise<void> {
  host.replaceChildren(element("p", "note", "reading both logs"));
  try {
    const logs = (await Promise.all(names.map((name) => loadText(`/runs/${name}/log.csv`)))).map((text) => parseLog(text, mostPoints));
    const metrics = await Promise.all(names.map(async (name) => JSON.parse(await loadText(`/runs/${name}/metrics.json`)).metrics as Metric[]));
    host.replaceChildren(element("h2", "", "Compared"));
    for (const axis of axisNames.filter((one) => logs.some((log) => log.columns.has(`${one}_duty_pct`)))) {
      host.append(
        plot(`${axis} tracking error`, "mm", names, logs, axis, "error"),
        plot(`${axis} duty`, "%", names, logs, axis, "duty"),
      );
    }
    const checks = JSON.parse(await loadText(`/runs/${names[0]}/result.json`)).checks as Check[] | undefined;
    host.append(...metricTables(names, metrics, checks ?? []));
  } catch (error) {
    host.replaceChildren(missingNote(`These two cannot be compared: ${String(error)}`));
  }
}
