// The path in the plane: reference and motor side, equal scales.
import { element } from "../dom";
import { currentTheme, dashes, type LineRole, onThemeChange } from "../theme";

const height = 220;

export class Path {
  readonly box = element("figure");
  private readonly canvas = element("canvas");

  private again = () => {};
  private width = 0; // of the canvas; asking the page for it each time would have it laid out each time

  constructor() {
    const caption = element("figcaption");
    caption.append(element("strong", "", "Path in the plane: reference dashed, motor side solid"));
    this.box.append(caption, this.canvas);
    this.canvas.style.maxWidth = "100%";
    new ResizeObserver(() => {
      this.fit();
      this.again();
    }).observe(this.box);
    onThemeChange(() => this.again());
  }

  private fit(): void {
    this.width = this.box.clientWidth || 320;
    this.canvas.width = this.width * devicePixelRatio;
    this.canvas.height = height * devicePixelRatio;
    this.canvas.style.width = `${this.width}px`;
    this.canvas.style.height = `${height}px`;
  }

  show(columns: (number | null)[][], yReference: number, yPosition: number, xReference: number, xPosition: number): void {
    this.again = () => this.draw(columns, yReference, yPosition, xReference, xPosition);
    this.again();
  }

  private draw(columns: (number | null)[][], yReference: number, yPosition: number, xReference: number, xPosition: number): void {
    if (this.width === 0) this.fit();
    const width = this.width;
    const pen = this.canvas.getContext("2d");
    if (pen === null) return;
    pen.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    pen.clearRect(0, 0, width, height);
    const pairs: [number, number, LineRole][] = [
      [yReference, xReference, "reference"],
      [yPosition, xPosition, "measured"],
    ];
    const finite = (column: number) => (columns[column] ?? []).filter((v): v is number => v !== null);
    const ys = [...finite(yReference), ...finite(yPosition)];
    const xs = [...finite(xReference), ...finite(xPosition)];
    if (ys.length === 0) return;
    const [yLow, yHigh, xLow, xHigh] = [least(ys), most(ys), least(xs), most(xs)];
    const scale = Math.min((width - 24) / (yHigh - yLow || 1e-3), (height - 24) / (xHigh - xLow || 1e-3));
    const right = (v: number) => width / 2 + (v - (yLow + yHigh) / 2) * scale;
    const down = (v: number) => height / 2 - (v - (xLow + xHigh) / 2) * scale;
    for (const [y, x, role] of pairs) {
      pen.beginPath();
      pen.strokeStyle = currentTheme().line[role];
      pen.setLineDash(dashes[role]);
      pen.lineWidth = 1.5;
      columns[y]!.forEach((value, i) => {
        const other = columns[x]![i];
        if (value !== null && other != null) pen.lineTo(right(value), down(other));
      });
      pen.stroke();
    }
  }
}

const least = (values: number[]) => values.reduce((a, b) => Math.min(a, b), Infinity);
const most = (values: number[]) => values.reduce((a, b) => Math.max(a, b), -Infinity);
