// What exchanges cost the host: how long each took, or by the wall clock how far each was off its
// period, in bins of doubling width.
import { readable } from "../units";
import { element, setText } from "../dom";

const svgNs = "http://www.w3.org/2000/svg";

const width = 640;
const floor = 96; // of the bars; labels stand below
const tallest = 88;

export class Histogram {
  readonly box = element("figure");
  private readonly svg = document.createElementNS(svgNs, "svg");
  private readonly title = element("strong");
  private readonly note = element("p", "note");
  private bars: SVGRectElement[] = [];

  constructor() {
    const caption = element("figcaption");
    caption.append(this.title);
    this.svg.setAttribute("class", "histogram");
    this.svg.setAttribute("viewBox", `0 0 ${width} 120`);
    this.box.append(caption, this.svg, this.note);
  }

  show(bins: number[], clock: "lockstep" | "real"): void {
    setText(
      this.title,
      clock === "real" ? "Jitter: how far each exchange was off its period" : "Host time of one exchange (both sides), waiting included",
    );
    if (bins.length !== this.bars.length) this.make(bins.length);
    const total = bins.reduce((a, b) => a + b, 0);
    const most = Math.max(1, ...bins);
    bins.forEach((count, i) => {
      // The root: a single late exchange among a million is still seen.
      const tall = count === 0 ? 0 : Math.max(2, tallest * Math.sqrt(count / most));
      this.bars[i]!.setAttribute("y", (floor - tall).toFixed(1));
      this.bars[i]!.setAttribute("height", tall.toFixed(1));
    });
    setText(this.note, total === 0 ? "none yet" : `${total} exchanges; heights are square roots of counts`);
  }

  private make(count: number): void {
    const wide = width / count;
    this.bars = Array.from({ length: count }, (_, i) => {
      const bar = document.createElementNS(svgNs, "rect");
      bar.setAttribute("x", String(i * wide + 2));
      bar.setAttribute("width", String(wide - 4));
      return bar;
    });
    const labels = this.bars.map((_, i) => {
      const label = document.createElementNS(svgNs, "text");
      label.setAttribute("x", String(i * wide + 2));
      label.setAttribute("y", "114");
      label.textContent = i % 3 === 0 ? lower(i) : "";
      return label;
    });
    this.svg.replaceChildren(...this.bars, ...labels);
  }
}

function lower(bin: number): string {
  const us = bin === 0 ? 0 : 2 ** (bin - 1);
  return us >= 1000 ? `${readable(us / 1000)} ms` : `${us} µs`;
}
