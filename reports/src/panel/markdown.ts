// The little of Markdown that the bench's own reports use: headings, tables, paragraphs, links.
import { element } from "../dom";

// `resolve` turns a link's target into an address, or into nothing.
export type Resolve = (target: string) => string | null;

function inline(host: HTMLElement, text: string, resolve: Resolve): void {
  const pattern = /\[([^\]]+)\]\(([^)]+)\)|`([^`]+)`|\*\*([^*]+)\*\*/g;
  let from = 0;
  for (const match of text.matchAll(pattern)) {
    host.append(text.slice(from, match.index));
    from = match.index! + match[0].length;
    if (match[1] !== undefined) {
      const address = resolve(match[2]!);
      const link = element(address === null ? "span" : "a", "", match[1]);
      if (address !== null) (link as HTMLAnchorElement).href = address;
      host.append(link);
    } else {
      host.append(match[3] !== undefined ? element("code", "", match[3]) : element("strong", "", match[4]));
    }
  }
  host.append(text.slice(from));
}

function cells(line: string): string[] {
  return line.trim().replace(/^\||\|$/g, "").split("|").map((cell) => cell.trim());
}

function table(lines: string[], resolve: Resolve): HTMLElement {
  const made = element("table");
  lines.forEach((line, i) => {
    if (i === 1) return; // the rule under the heads
    const row = element("tr");
    for (const cell of cells(line)) {
      const box = element(i === 0 ? "th" : "td");
      inline(box, cell, resolve);
      row.append(box);
    }
    made.append(row);
  });
  const wide = element("div", "wide");
  wide.append(made);
  return wide;
}

export function rendered(text: string, resolve: Resolve): HTMLElement {
  const host = element("article");
  const lines = text.split("\n");
  for (let i = 0; i < lines.length; ) {
    const line = lines[i]!;
    const heading = /^(#{1,4}) (.*)/.exec(line);
    if (heading !== null) {
      inline(host.appendChild(element(`h${heading[1]!.length + 1}` as "h2")), heading[2]!, resolve);
      ++i;
    } else if (line.startsWith("|")) {
      let end = i;
      while (end < lines.length && lines[end]!.startsWith("|")) ++end;
      host.append(table(lines.slice(i, end), resolve));
      i = end;
    } else {
      if (line.trim() !== "") inline(host.appendChild(element("p")), line, resolve);
      ++i;
    }
  }
  return host;
}
