// What is drawn behind and over the curves: events, limits, and the times of braking and fault.
import type uPlot from "uplot";

import type { EventMark } from "./data";
import { axisFont, type Theme } from "./theme";

export interface Guide {
  value: number; // in the plot's display unit
  label: string;
}

export interface Span {
  from: number;
  to: number;
  label: string;
}

// bbmc::AxisMode, by number.
const shadedStates: Record<number, string> = { 4: "braking", 5: "faulted" };

export function stateSpans(time: Float64Array, state: Float64Array | undefined): Span[] {
  const spans: Span[] = [];
  if (state === undefined) return spans;
  for (let i = 0; i < time.length; ++i) {
    const label = shadedStates[state[i]!];
    if (label === undefined) continue;
    const last = spans[spans.length - 1];
    const next = time[Math.min(i + 1, time.length - 1)]!;
    if (last?.label === label && last.to === time[i]) last.to = next;
    else spans.push({ from: time[i]!, to: next, label });
  }
  return spans;
}

function clipped(plot: uPlot, draw: (context: CanvasRenderingContext2D) => void): void {
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  draw(ctx);
  ctx.restore();
}

function setFont(context: CanvasRenderingContext2D, size: number): void {
  context.font = axisFont.replace("12px", `${size * devicePixelRatio}px`);
}

export function drawSpans(plot: uPlot, spans: Span[], theme: Theme): void {
  clipped(plot, (context) => {
    const { top, height } = plot.bbox;
    setFont(context, 11);
    context.textBaseline = "bottom";
    context.textAlign = "left";
    for (const span of spans) {
      const left = plot.valToPos(span.from, "x", true);
      const right = plot.valToPos(span.to, "x", true);
      context.fillStyle = theme.shade;
      context.fillRect(left, top, Math.max(right - left, 1), height);
      if (right - left > context.measureText(span.label).width + 8) {
        context.fillStyle = theme.muted;
        const start = Math.max(left, plot.bbox.left);
        context.fillText(span.label, start + 4, top + height - 4);
      }
    }
  });
}

// Labels stand above their lines, but below where another line is close above.
export function drawGuides(plot: uPlot, guides: Guide[], theme: Theme): void {
  clipped(plot, (context) => {
    const { left, width } = plot.bbox;
    const ratio = devicePixelRatio;
    setFont(context, 11);
    context.textAlign = "left";
    context.textBaseline = "top";
    context.lineWidth = ratio;
    context.strokeStyle = theme.muted;
    context.setLineDash([10, 3, 2, 3].map((length) => length * ratio));
    const heights = guides.map((guide) => Math.round(plot.valToPos(guide.value, "y", true)) + 0.5);
    guides.forEach((guide, i) => {
      const y = heights[i]!;
      context.beginPath();
      context.moveTo(left, y);
      context.lineTo(left + width, y);
      context.stroke();
      const crowded = heights.some((other) => other < y && y - other < 30 * ratio);
      context.fillStyle = theme.muted;
      context.fillText(guide.label, left + 18 * ratio, crowded ? y + 3 * ratio : y - 14 * ratio);
    });
  });
}

// A thin line at each event, with its number in the table where there is room for it.
export function drawEvents(plot: uPlot, events: EventMark[], theme: Theme): void {
  clipped(plot, (context) => {
    const { left, top, width, height } = plot.bbox;
    setFont(context, 10);
    context.textBaseline = "top";
    context.textAlign = "left";
    context.strokeStyle = theme.muted;
    context.fillStyle = theme.text;
    context.lineWidth = 1;
    context.setLineDash([1, 3].map((length) => length * devicePixelRatio));
    let free = -Infinity;
    for (const event of events) {
      const x = Math.round(plot.valToPos(event.time_s, "x", true)) + 0.5;
      context.beginPath();
      context.moveTo(x, top);
      context.lineTo(x, top + height);
      context.stroke();
      const label = String(event.number);
      const size = context.measureText(label).width;
      const fitsRight = x + 3 + size < left + width;
      if (x >= free && x >= left) {
        context.fillText(label, fitsRight ? x + 3 : x - 3 - size, top + 2);
        free = x + size + 8;
      }
    }
  });
}

export function drawUnit(plot: uPlot, unit: string, theme: Theme): void {
  const { ctx, bbox } = plot;
  ctx.save();
  setFont(ctx, 12);
  ctx.fillStyle = theme.muted;
  ctx.textAlign = "right";
  ctx.textBaseline = "bottom";
  ctx.fillText(unit, bbox.left - 8 * devicePixelRatio, bbox.top - 5 * devicePixelRatio);
  ctx.restore();
}

export function drawWords(plot: uPlot, words: string, theme: Theme): void {
  const { ctx, bbox } = plot;
  ctx.save();
  setFont(ctx, 13);
  ctx.fillStyle = theme.muted;
  ctx.textAlign = "center";
  ctx.textBaseline = "middle";
  ctx.fillText(words, bbox.left + bbox.width / 2, bbox.top + bbox.height / 2);
  ctx.restore();
}
