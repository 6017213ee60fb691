// The data block that the bench writes into the page (harness/report/packed_columns.h, page.cc).

export interface Table {
  rows: number;
  sourceRows: number;
  rowsPerBucket: number;
  columns: Map<string, Float64Array>;
}

export interface EventMark {
  number: number;
  time_s: number;
  kind: string;
  axis: string;
  text: string;
}

export interface AxisLimits {
  hall_min_m?: number;
  hall_max_m?: number;
  hard_min_m?: number;
  hard_max_m?: number;
  turns?: boolean; // read rad for m
}

export interface TimeWindow {
  name: string;
  from_s: number;
  to_s: number;
}

export interface RunData {
  table: Table;
  events: EventMark[];
  limits: Record<string, AxisLimits>;
  windows: TimeWindow[];
}

interface PackedColumn {
  name: string;
  bits: 8 | 16 | 32;
  offset: number;
  scale: number;
  data: string;
}

interface PackedTable {
  rows: number;
  source_rows: number;
  rows_per_bucket: number;
  columns: PackedColumn[];
}

export function readRunData(text: string): RunData {
  const raw = JSON.parse(text) as {
    table: PackedTable;
    events: EventMark[];
    limits: Record<string, AxisLimits> | null;
    windows: TimeWindow[] | null;
  };
  const columns = new Map<string, Float64Array>();
  for (const column of raw.table.columns) {
    columns.set(column.name, unpacked(column));
  }
  return {
    table: {
      rows: raw.table.rows,
      sourceRows: raw.table.source_rows,
      rowsPerBucket: raw.table.rows_per_bucket,
      columns,
    },
    events: raw.events,
    limits: raw.limits ?? {},
    windows: (raw.windows ?? []).filter((w) => Number.isFinite(w.from_s) && w.to_s > w.from_s),
  };
}

// value = offset + scale x integer; all bits set: missing, which becomes NaN.
function unpacked(column: PackedColumn): Float64Array {
  const bytes = Uint8Array.from(atob(column.data), (character) => character.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  const width = column.bits / 8;
  const missing = 2 ** column.bits - 1;
  const values = new Float64Array(bytes.length / width);
  for (let i = 0; i < values.length; ++i) {
    const code =
      width === 1
        ? view.getUint8(i)
        : width === 2
          ? view.getUint16(2 * i, true)
          : view.getUint32(4 * i, true);
    values[i] = code === missing ? NaN : column.offset + column.scale * code;
  }
  return values;
}

export interface Extent {
  min: number;
  max: number;
}

// Null when there is no value at all.
export function extentOf(values: Float64Array): Extent | null {
  let min = Infinity;
  let max = -Infinity;
  for (const value of values) {
    if (value < min) min = value;
    if (value > max) max = value;
  }
  return min <= max ? { min, max } : null;
}

// The row whose time is nearest; `time` increases strictly and is not empty.
export function nearestRow(time: Float64Array, at: number): number {
  let low = 0;
  let high = time.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (time[middle]! <= at) low = middle;
    else high = middle;
  }
  return at - time[low]! <= time[high]! - at ? low : high;
}
