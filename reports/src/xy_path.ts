// The path in the plane, with equal scales, and the same path with its error magnified.
import uPlot from "uplot";

import { extentOf, type Table } from "./data";
import { element } from "./dom";
import { drawUnit } from "./marks";
import {
  axisFont,
  currentTheme,
  dashes,
  fitWidth,
  lineSample,
  type LineRole,
  onThemeChange,
  widths,
} from "./theme";
import type { TimeGroup } from "./time_group";
import { tickText } from "./units";

const perMetre = 1e3; // shown in mm

interface Path {
  label: string;
  role: LineRole;
  x: Float64Array;
  y: Float64Array;
}

interface Bounds {
  x: [number, number];
  y: [number, number];
}

// A column of both axes in mm, where both follow a reference: before that the controller's zero may
// still be set, after that nobody follows a path. A log without references shows all of it.
function pathOf(table: Table, column: string): Omit<Path, "label" | "role"> | null {
  const x = table.columns.get(`x_${column}`);
  const y = table.columns.get(`y_${column}`);
  if (x === undefined || y === undefined) return null;
  const errorX = table.columns.get("x_error_m");
  const errorY = table.columns.get("y_error_m");
  const follows = (row: number) =>
    !errorX || !errorY || !(Number.isNaN(errorX[row]!) || Number.isNaN(errorY[row]!));
  const chosen = (values: Float64Array) =>
    values.map((value, row) => (follows(row) ? value * perMetre : NaN));
  return { x: chosen(x), y: chosen(y) };
}

function pathsOf(table: Table): Path[] {
  const wanted: [string, string, LineRole][] = [
    ["carriage_m", "carriage (truth)", "truth"],
    ["position_m", "motor side", "measured"],
    ["reference_m", "reference", "reference"],
  ];
  return wanted.flatMap(([column, label, role]) => {
    const path = pathOf(table, column);
    return path && extentOf(path.x) && extentOf(path.y) ? [{ label, role, ...path }] : [];
  });
}

// True when both axes move by more than a millimetre: otherwise there is no path to look at.
export function hasPath(table: Table): boolean {
  const path = pathOf(table, "position_m");
  if (path === null) return false;
  return [path.x, path.y].every((values) => {
    const extent = extentOf(values);
    return extent !== null && extent.max - extent.min > 1e-3 * perMetre;
  });
}

// reference + factor x (actual - reference).
function magnified(paths: Path[], factor: number): Path[] {
  const reference = paths.find((path) => path.role === "reference");
  if (reference === undefined || factor === 1) return paths;
  const stretch = (values: Float64Array, base: Float64Array) =>
    values.map((value, i) => base[i]! + factor * (value - base[i]!));
  return paths.map((path) => ({
    ...path,
    x: stretch(path.x, reference.x),
    y: stretch(path.y, reference.y),
  }));
}

// The power of ten (or five of it) that makes the largest error a tenth of the path's size, about.
function usefulFactor(paths: Path[]): number {
  const reference = paths.find((path) => path.role === "reference");
  if (reference === undefined) return 1;
  let error = 0;
  for (const path of paths) {
    path.x.forEach((value, i) => {
      const distance = Math.hypot(value - reference.x[i]!, path.y[i]! - reference.y[i]!);
      if (distance > error) error = distance;
    });
  }
  const extent = extentOf(reference.x)!;
  const wanted = error > 0 ? (extent.max - extent.min) / 10 / error : 1;
  const power = 10 ** Math.floor(Math.log10(Math.max(wanted, 1)));
  return wanted >= 5 * power ? 5 * power : power;
}

function boundsOf(paths: Path[]): Bounds {
  const along = (pick: (path: Path) => Float64Array): [number, number] => {
    const extents = paths.map((path) => extentOf(pick(path))!);
    return [Math.min(...extents.map((e) => e.min)), Math.max(...extents.map((e) => e.max))];
  };
  return { x: along((path) => path.x), y: along((path) => path.y) };
}

// The smallest bounds around `wanted` at which a millimetre is as long across as along.
function equalScales(plot: uPlot, wanted: Bounds, pad: number): Bounds {
  const middle = ([low, high]: [number, number]) => (low + high) / 2;
  const span = ([low, high]: [number, number]) => Math.max(high - low, 1e-6) * (1 + pad);
  const perPixel = Math.max(
    span(wanted.x) / plot.bbox.width,
    span(wanted.y) / plot.bbox.height,
  );
  const around = (range: [number, number], pixels: number): [number, number] => [
    middle(range) - (perPixel * pixels) / 2,
    middle(range) + (perPixel * pixels) / 2,
  ];
  return { x: around(wanted.x, plot.bbox.width), y: around(wanted.y, plot.bbox.height) };
}

function drawPath(plot: uPlot, path: Path): void {
  const { ctx, bbox } = plot;
  const ratio = devicePixelRatio;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.beginPath();
  ctx.strokeStyle = currentTheme().line[path.role];
  ctx.lineWidth = widths[path.role] * ratio;
  ctx.setLineDash(dashes[path.role].map((length) => length * ratio));
  let lastX = NaN;
  let lastY = NaN;
  for (let i = 0; i < path.x.length; ++i) {
    const x = plot.valToPos(path.x[i]!, "x", true);
    const y = plot.valToPos(path.y[i]!, "y", true);
    if (Number.isNaN(x + y)) {
      lastX = NaN;
    } else if (Number.isNaN(lastX)) {
      ctx.moveTo(x, y);
      [lastX, lastY] = [x, y];
    } else if (Math.abs(x - lastX) + Math.abs(y - lastY) > 0.3) {
      ctx.lineTo(x, y);
      [lastX, lastY] = [x, y];
    }
  }
  ctx.stroke();
  ctx.restore();
}

function heightFor(width: number): number {
  return Math.min(width, 560);
}

function makePlot(canvasHost: HTMLElement, current: () => Path[]): uPlot {
  let shown: Bounds | null = null; // null: everything
  const fit = (plot: uPlot) => {
    const bounds = equalScales(plot, shown ?? boundsOf(current()), shown ? 0 : 0.1);
    plot.batch(() => {
      plot.setScale("x", { min: bounds.x[0], max: bounds.x[1] });
      plot.setScale("y", { min: bounds.y[0], max: bounds.y[1] });
    });
  };
  const axis = {
    stroke: () => currentTheme().muted,
    font: axisFont,
    grid: { stroke: () => currentTheme().grid, width: 1 },
    ticks: { stroke: () => currentTheme().grid, width: 1, size: 4 },
  };
  const width = canvasHost.clientWidth || 640;
  const plot = new uPlot(
    {
      mode: 2,
      width,
      height: heightFor(width),
      padding: [24, 32, 0, 0],
      legend: { show: false },
      scales: { x: { time: false, auto: false, range: [0, 1] }, y: { auto: false, range: [0, 1] } },
      axes: [
        { ...axis, size: 28, space: 64, values: (_p, splits) => splits.map((s) => `${tickText(s)} mm`) },
        { ...axis, size: 58, space: 40, values: (_p, splits) => splits.map(tickText) },
      ],
      series: [{}, { facets: [{ scale: "x" }, { scale: "y" }], paths: () => null }],
      cursor: { points: { show: false }, drag: { x: true, y: true, uni: 8, setScale: false } },
      hooks: {
        draw: [
          (drawnPlot) => {
            for (const path of current()) drawPath(drawnPlot, path);
            drawUnit(drawnPlot, "mm", currentTheme());
          },
        ],
        setSelect: [
          (selected) => {
            const { left, top, width: w, height: h } = selected.select;
            if (w < 4 || h < 4) return;
            shown = {
              x: [selected.posToVal(left, "x"), selected.posToVal(left + w, "x")],
              y: [selected.posToVal(top + h, "y"), selected.posToVal(top, "y")],
            };
            selected.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
            fit(selected);
          },
        ],
      },
    },
    // One point, so that uPlot has a series; the paths draw themselves.
    [null, [[0], [0]]] as unknown as uPlot.AlignedData,
    canvasHost,
  );
  const showAll = () => {
    shown = null;
    fit(plot);
  };
  plot.over.addEventListener("dblclick", showAll);
  canvasHost.addEventListener("reset", showAll);
  const resize = (available: number) => {
    plot.setSize({ width: available, height: heightFor(available) });
    fit(plot);
  };
  fitWidth(canvasHost, () => plot.width, resize);
  fit(plot);
  return plot;
}

export function addPath(host: HTMLElement, table: Table, group: TimeGroup): void {
  const plain = pathsOf(table);
  const factor = usefulFactor(plain);
  let paths = plain;
  const box = element("figure", "plot path");
  box.dataset.plot = "path";
  const caption = element("figcaption");
  const legend = element("span", "legend");
  for (const path of plain) {
    const entry = element("span", "entry");
    entry.append(lineSample(path.role), element("span", "", path.label));
    legend.append(entry);
  }
  caption.append(element("strong", "", "Path in the plane of x (right) and y (up)"), legend);
  const canvasHost = element("div", "canvas-host");
  const buttons = element("div", "buttons");
  box.append(caption, canvasHost, buttons);
  box.setAttribute("role", "group");
  box.setAttribute("aria-label", "Path of both axes in the plane, equal scales. Drag to zoom.");
  host.append(box);

  const plot = makePlot(canvasHost, () => paths);
  const reset = element("button", "", "Reset zoom");
  reset.type = "button";
  reset.addEventListener("click", () => canvasHost.dispatchEvent(new Event("reset")));
  buttons.append(reset);
  if (factor > 1) {
    const magnify = element("button", "", `Error × ${factor}`);
    magnify.type = "button";
    magnify.setAttribute("aria-pressed", "false");
    magnify.addEventListener("click", () => {
      const on = paths === plain;
      paths = on ? magnified(plain, factor) : plain;
      magnify.setAttribute("aria-pressed", String(on));
      canvasHost.dispatchEvent(new Event("reset"));
      plot.redraw(false, true);
    });
    buttons.append(magnify);
  }

  // Where the cursor of the time plots stands.
  const spot = element("div", "spot");
  plot.over.append(spot);
  const measured = () => paths.find((path) => path.role === "measured") ?? paths[0]!;
  group.onCursor((row) => {
    const x = row === null ? NaN : plot.valToPos(measured().x[row]!, "x");
    const y = row === null ? NaN : plot.valToPos(measured().y[row]!, "y");
    spot.style.display = Number.isNaN(x + y) ? "none" : "block";
    spot.style.transform = `translate(${x}px, ${y}px)`;
  });
  onThemeChange(() => plot.redraw(false, true));
}
