// The pictures of a diagnosis, from its residual.csv: measured against simulated, and what is left.
import type { LineRole } from "../theme";
import { readable } from "../units";
import { column, type Log } from "./csv";
import { figure, type FigureSpec } from "./figure";

const mostDots = 3000;
const gap = 5; // rows that are further apart than so many steps have standstill between them

// Rows of the first run: time begins anew with the next.
function firstRun(time: Float64Array): number {
  for (let i = 1; i < time.length; ++i) if (time[i]! <= time[i - 1]!) return i;
  return time.length;
}

// Indices of rows, and -1 where the line is to be broken.
function broken(time: Float64Array, rows: number): number[] {
  const step = median(Array.from({ length: Math.max(0, rows - 1) }, (_, i) => time[i + 1]! - time[i]!));
  const kept: number[] = [];
  for (let i = 0; i < rows; ++i) {
    if (i > 0 && time[i]! - time[i - 1]! > gap * step) kept.push(-1);
    kept.push(i);
  }
  return kept;
}

function median(values: number[]): number {
  return values.sort((a, b) => a - b)[Math.floor(values.length / 2)] ?? 0;
}

type Drawn = [label: string, role: LineRole, of: (i: number) => number];

function inTime(log: Log, title: string, curves: Drawn[], note: string): FigureSpec {
  const time = column(log, "time_s");
  const rows = broken(time, firstRun(time));
  return {
    title,
    unit: "N",
    xUnit: "s",
    x: rows.map((i, at) => (i < 0 ? time[rows[at - 1]!]! + 1e-9 : time[i]!)),
    curves: curves.map(([label, role, of]) => ({ label, role, values: rows.map((i) => (i < 0 ? null : of(i))) })),
    note,
  };
}

function along(log: Log, name: string, title: string, xUnit: string): FigureSpec {
  const x = column(log, name);
  const stride = Math.max(1, Math.ceil(x.length / mostDots));
  const order = Array.from({ length: Math.ceil(x.length / stride) }, (_, i) => i * stride).sort((a, b) => x[a]! - x[b]!);
  const take = (of: Float64Array) => order.map((i) => of[i]!);
  return {
    title: `What is left, along ${title}`,
    unit: "N",
    xUnit,
    x: take(x),
    dots: true,
    curves: [
      { label: "model, refitted", role: "truth", values: take(column(log, "residual_before_N")) },
      { label: "with what was found", role: "measured", values: take(column(log, "residual_after_N")) },
    ],
  };
}

const rms = (values: Float64Array) => Math.sqrt(values.reduce((sum, v) => sum + v * v, 0) / Math.max(1, values.length));

export function diagnosisPlots(log: Log): HTMLElement[] {
  const input = column(log, "input_N");
  const before = column(log, "residual_before_N");
  const after = column(log, "residual_after_N");
  const left = `${readable(rms(before))} N rms before, ${readable(rms(after))} N rms with what was found; all data`;
  return [
    figure(
      inTime(
        log,
        "Force, measured against simulated",
        [
          ["model, refitted", "truth", (i) => input[i]! - before[i]!],
          ["with what was found", "measured", (i) => input[i]! - after[i]!],
          ["measured", "reference", (i) => input[i]!],
        ],
        "In the band that was judged, standstill left out; drag to zoom, double-click for all.",
      ),
    ),
    figure(
      inTime(
        log,
        "Residual: measured less simulated",
        [
          ["model, refitted", "truth", (i) => before[i]!],
          ["with what was found", "measured", (i) => after[i]!],
        ],
        left,
      ),
    ),
    figure(along(log, "speed_m_per_s", "speed", "m/s")),
    figure(along(log, "position_m", "position", "m")),
  ];
}
