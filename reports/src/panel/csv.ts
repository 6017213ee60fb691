// A log of numbers: a head of names, then rows.

export interface Log {
  columns: Map<string, Float64Array>;
  rows: number;
}

// No more than `most` rows, every so many-th.
export function parseLog(text: string, most = Infinity): Log {
  const lines = text.trimEnd().split("\n");
  const names = lines[0]!.split(",");
  const stride = Math.max(1, Math.ceil((lines.length - 1) / most));
  const kept = lines.slice(1).filter((_, i) => i % stride === 0);
  const columns = new Map(names.map((name) => [name, new Float64Array(kept.length)]));
  kept.forEach((line, row) => {
    const values = line.split(",");
    names.forEach((name, i) => (columns.get(name)![row] = Number(values[i])));
  });
  return { columns, rows: kept.length };
}

export function column(log: Log, name: string): Float64Array {
  const found = log.columns.get(name);
  if (found === undefined) throw new Error(`the log has no column ${name}`);
  return found;
}
