// The plots of one run over one time axis: they zoom together and share one cursor.
import type uPlot from "uplot";

import { nearestRow } from "./data";

export interface TimeRange {
  from: number;
  to: number;
}

export class TimeGroup {
  readonly full: TimeRange;
  private range: TimeRange;
  private readonly plots: uPlot[] = [];
  private readonly rangeListeners: ((range: TimeRange) => void)[] = [];
  private readonly cursorListeners: ((row: number | null) => void)[] = [];
  private applying = false;
  private row: number | null = null;

  constructor(
    readonly syncKey: string,
    readonly time: Float64Array,
  ) {
    const first = time[0]!;
    const last = time[time.length - 1]!;
    this.full = { from: first, to: last > first ? last : first + 1 };
    this.range = this.full;
  }

  get visible(): TimeRange {
    return this.range;
  }

  add(plot: uPlot): void {
    this.plots.push(plot);
  }

  onRange(listener: (range: TimeRange) => void): void {
    this.rangeListeners.push(listener);
  }

  onCursor(listener: (row: number | null) => void): void {
    this.cursorListeners.push(listener);
  }

  // Kept inside the run and at least four rows wide.
  show(wanted: TimeRange): void {
    if (this.applying) return;
    const narrowest = (4 * (this.full.to - this.full.from)) / Math.max(this.time.length, 4);
    const width = Math.min(
      Math.max(wanted.to - wanted.from, narrowest),
      this.full.to - this.full.from,
    );
    const middle = (wanted.from + wanted.to) / 2;
    const from = Math.min(Math.max(middle - width / 2, this.full.from), this.full.to - width);
    this.range = { from, to: from + width };
    this.applying = true;
    for (const plot of this.plots) plot.setScale("x", { min: from, max: from + width });
    this.applying = false;
    for (const listener of this.rangeListeners) listener(this.range);
  }

  reset(): void {
    this.show(this.full);
  }

  // Below 1 zooms in, about the cursor where there is one.
  zoom(factor: number): void {
    const { from, to } = this.range;
    const at = this.row === null ? (from + to) / 2 : this.time[this.row]!;
    const centre = Math.min(Math.max(at, from), to);
    this.show({ from: centre - (centre - from) * factor, to: centre + (to - centre) * factor });
  }

  pan(share: number): void {
    const { from, to } = this.range;
    const shift = (to - from) * share;
    this.show({ from: from + shift, to: to + shift });
  }

  // Called by every plot whose cursor moved; all of them report the same row.
  cursorAt(row: number | null): void {
    if (row === this.row) return;
    this.row = row;
    for (const listener of this.cursorListeners) listener(row);
  }

  // Moves the cursor by `pixels` of `plot`, at least one row; starts in the middle.
  stepCursor(plot: uPlot, pixels: number): void {
    const { from, to } = this.range;
    const perPixel = (to - from) / Math.max(plot.over.clientWidth, 1);
    let row = nearestRow(this.time, (from + to) / 2);
    if (this.row !== null) {
      const target = nearestRow(this.time, this.time[this.row]! + pixels * perPixel);
      row = target === this.row ? this.row + Math.sign(pixels) : target;
    }
    const last = this.time.length - 1;
    const time = this.time[Math.min(Math.max(row, 0), last)]!;
    if (time < from || time > to) this.pan(Math.sign(pixels) / 4);
    plot.setCursor({ left: plot.valToPos(time, "x"), top: plot.over.clientHeight / 2 });
  }
}
