// The last stretch of rows, as columns that the plots take as they are.

export class History {
  readonly columns: (number | null)[][];

  constructor(width: number, private readonly length_s: number) {
    this.columns = Array.from({ length: width }, () => []);
  }

  get time(): number[] {
    return this.columns[0] as number[];
  }

  get last(): (number | null)[] | null {
    const at = this.time.length - 1;
    return at < 0 ? null : this.columns.map((column) => column[at] ?? null);
  }

  clear(): void {
    for (const column of this.columns) column.length = 0;
  }

  add(rows: (number | null)[][]): void {
    this.columns.forEach((column, i) => {
      for (const row of rows) column.push(row[i] ?? null);
    });
    const time = this.time;
    const newest = time[time.length - 1];
    if (newest === undefined) return;
    let old = 0;
    while (old < time.length && time[old]! < newest - this.length_s) ++old;
    // Rarely and much at once: moving an array is dear.
    if (old > 256 || old > time.length / 4) for (const column of this.columns) column.splice(0, old);
  }
}
