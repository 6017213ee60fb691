// A force in the plane, from where it acts.
import { setText } from "../dom";

const svgNs = "http://www.w3.org/2000/svg";
const pixelsPerNewton = 4;
const longest = 150;
const head = 8;
const clear = 12; // of the ring about the end-effector
const leastShown_N = 0.25;

export class Arrow {
  readonly group = document.createElementNS(svgNs, "g");
  private readonly path = document.createElementNS(svgNs, "path");
  private readonly text = document.createElementNS(svgNs, "text");

  // Its size stands beside the point it acts on, `below` the one of another arrow.
  constructor(className: string, private readonly below = 0) {
    this.group.setAttribute("class", className);
    this.group.append(this.path, this.text);
  }

  // `y_N` to the right, `x_N` up.
  show(x: number, y: number, y_N: number, x_N: number): void {
    const size_N = Math.hypot(y_N, x_N);
    this.group.setAttribute("visibility", size_N < leastShown_N ? "hidden" : "visible");
    if (size_N < leastShown_N) return;
    const length = Math.min(longest, Math.max(2 * head, size_N * pixelsPerNewton));
    const [right, down] = [y_N / size_N, -x_N / size_N];
    const [startX, startY] = [x + right * clear, y + down * clear];
    const [tipX, tipY] = [startX + right * length, startY + down * length];
    const barb = (side: number) => {
      const bx = tipX - head * right + side * head * 0.6 * -down;
      const by = tipY - head * down + side * head * 0.6 * right;
      return `M${tipX.toFixed(1)} ${tipY.toFixed(1)}L${bx.toFixed(1)} ${by.toFixed(1)}`;
    };
    this.path.setAttribute("d", `M${startX.toFixed(1)} ${startY.toFixed(1)}L${tipX.toFixed(1)} ${tipY.toFixed(1)}${barb(1)}${barb(-1)}`);
    this.text.setAttribute("x", (x + 18).toFixed(1));
    this.text.setAttribute("y", (y - 10 + this.below).toFixed(1));
    setText(this.text, `${size_N.toFixed(1)} N`);
  }
}
