// What canvases draw with. The style sheet owns the colours; dashes tell the lines apart without them.

export type LineRole = "reference" | "measured" | "truth" | "second" | "third";

export interface Theme {
  page: string;
  text: string;
  muted: string;
  grid: string;
  shade: string;
  line: Record<LineRole, string>;
}

export const dashes: Record<LineRole, number[]> = {
  reference: [7, 4],
  measured: [],
  truth: [2, 3],
  second: [10, 3, 2, 3],
  third: [16, 5],
};

export const widths: Record<LineRole, number> = { reference: 1.25, measured: 1.5, truth: 2, second: 1.5, third: 1.5 };

export const axisFont = '12px system-ui, -apple-system, "Segoe UI", Roboto, sans-serif';

// Asked for with every line that is drawn; read from the style sheet once.
let known: Theme | null = null;

export function currentTheme(): Theme {
  return (known ??= readTheme());
}

function readTheme(): Theme {
  const style = getComputedStyle(document.documentElement);
  const colour = (name: string) => style.getPropertyValue(name).trim();
  return {
    page: colour("--page"),
    text: colour("--text"),
    muted: colour("--muted"),
    grid: colour("--grid"),
    shade: colour("--shade"),
    line: {
      reference: colour("--line-reference"),
      measured: colour("--line-measured"),
      truth: colour("--line-truth"),
      second: colour("--line-second"),
      third: colour("--line-third"),
    },
  };
}

// Before all others that react: these draw.
onThemeChange(() => (known = null));

// Also before and after printing, since paper has its own colours.
export function onThemeChange(react: () => void): void {
  for (const query of ["(prefers-color-scheme: dark)", "print"]) {
    matchMedia(query).addEventListener("change", react);
  }
}

// Keeps a plot as wide as its host. On paper the host's width is known too late, so plots take this one.
const paperWidth = 680;

export function fitWidth(host: HTMLElement, current: () => number, resize: (w: number) => void): void {
  const fit = (width: number) => {
    if (width > 0 && width !== current()) resize(width);
  };
  new ResizeObserver(() => fit(host.clientWidth)).observe(host);
  addEventListener("beforeprint", () => fit(Math.min(paperWidth, host.clientWidth)));
  addEventListener("afterprint", () => fit(host.clientWidth));
}

// The sample of a line in a legend, as it is drawn in the plot.
export function lineSample(role: LineRole): SVGSVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 28 8");
  svg.setAttribute("class", "sample");
  svg.setAttribute("aria-hidden", "true");
  const line = document.createElementNS(svg.namespaceURI, "line");
  const attributes = { x1: 0, x2: 28, y1: 4, y2: 4, "stroke-width": widths[role] + 0.5 };
  for (const [name, value] of Object.entries(attributes)) line.setAttribute(name, String(value));
  line.setAttribute("stroke", `var(--line-${role})`);
  line.setAttribute("stroke-dasharray", dashes[role].join(" "));
  svg.append(line);
  return svg;
}
