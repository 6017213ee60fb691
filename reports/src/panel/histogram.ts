// What exchanges cost the host: how long each took, or by the wall clock how far each was off its
// period, in bins of doubling width.
import { element } from "../dom";

const svgNs = "http://www.w3.org/2000/svg";

export class Histogram {
  readonly box = element("figure");
  private readonly svg = document.createElementNS(svgNs, "svg");
  private readonly title = element("strong");
  private readonly note = element("p", "note");

  constructor() {
    const caption = element("figcaption");
    caption.append(this.title);
    this.svg.setAttribute("class", "histogram");
    this.svg.setAttribute("viewBox", "0 0 640 120");
    this.box.append(caption, this.svg, this.note);
  }

  show(bins: number[], clock: "lockstep" | "real"): void {
    this.title.textContent =
      clock === "real" ? "Jitter: how far each exchange was off its period" : "Host time of one exchange (both sides), waiting included";
    const total = bins.reduce((a, b) => a + b, 0);
    const most = Math.max(1, ...bins);
    const wide = 640 / bins.length;
    this.svg.replaceChildren(
      ...bins.flatMap((count, i) => {
        // The root: a single late exchange among a million is still seen.
        const tall = count === 0 ? 0 : Math.max(2, 88 * Math.sqrt(count / most));
        const bar = document.createElementNS(svgNs, "rect");
        const place = { x: i * wide + 2, y: 96 - tall, width: wide - 4, height: tall };
        for (const [name, value] of Object.entries(place)) bar.setAttribute(name, String(value));
        const label = document.createElementNS(svgNs, "text");
        label.setAttribute("x", String(i * wide + 2));
        label.setAttribute("y", "114");
        label.textContent = i % 3 === 0 ? lower(i) : "";
        return [bar, label];
      }),
    );
    this.note.textContent = total === 0 ? "none yet" : `${total} exchanges; heights are square roots of counts`;
  }
}

function lower(bin: number): string {
  const us = bin === 0 ? 0 : 2 ** (bin - 1);
  return us >= 1000 ? `${(us / 1000).toPrecision(2)} ms` : `${us} µs`;
}
