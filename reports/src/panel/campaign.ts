// A campaign: every kind of fault at every moment as a table of cells, from a cell to its cases, from
// a case to its run; the bench's own report below.
import { element, missingNote } from "../dom";
import { readable } from "../units";
import { type Folder, loadText } from "./catalogue";
import { button } from "./form";
import { rendered } from "./markdown";

interface Case {
  case: string;
  of: string;
  part: string;
  kind: string;
  moment: string;
  verdict: "PASS" | "FAIL" | "INVALID";
  faults: string[];
  to_zero_drive_s?: number;
  broken?: { rule: string; reason: string }[];
}

interface Kept {
  of: string;
  runs: Record<string, string>;
}

const mostListed = 200;

// A link of the bench's own report: to a kept run's folder, or to a file.
function addressIn(folder: string, target: string): string | null {
  if (!/^[\w./-]+$/.test(target) || target.includes("..")) return null;
  const path = target.replace(/\/$/, "");
  return `/runs/${folder}/${path}${/\.\w+$/.test(path) ? "" : "/report.html"}`;
}

// A last line that a kill has torn is left out, and of a case that stands there twice the first counts.
function casesIn(texts: string[], of: string | null): Case[] {
  const found = new Map<string, Case>();
  for (const line of texts.flatMap((text) => text.split("\n"))) {
    try {
      const one = JSON.parse(line) as Case;
      if ((of === null || one.of === of) && !found.has(one.case)) found.set(one.case, one);
    } catch {
      continue;
    }
  }
  return [...found.values()];
}

// Words and a sign; colour only repeats them.
function summary(cases: Case[]): { text: string; tone: string } {
  const failed = cases.filter((one) => one.verdict === "FAIL").length;
  const invalid = cases.filter((one) => one.verdict === "INVALID").length;
  if (failed > 0) return { text: `✗ ${failed} of ${cases.length} failed`, tone: "fail" };
  if (invalid > 0) return { text: `? ${invalid} of ${cases.length} invalid`, tone: "invalid" };
  return { text: `✓ ${cases.length}`, tone: "pass" };
}

const order = { FAIL: 0, INVALID: 1, PASS: 2 };

class CampaignView {
  readonly box = element("section", "campaign");
  private readonly chosen = element("section", "cases");

  constructor(
    private readonly folder: string,
    private readonly cases: Case[],
    private readonly kept: Record<string, string>,
    private readonly again: string,
  ) {
    this.chosen.setAttribute("aria-live", "polite");
    this.box.append(element("h2", "", `Campaign ${folder}: a cell opens its cases`), this.grid(), this.chosen);
  }

  private grid(): HTMLElement {
    const kinds = [...new Set(this.cases.map((one) => `${one.part} ${one.kind}`))].sort();
    const moments = [...new Set(this.cases.map((one) => one.moment))].sort();
    const table = element("table", "cells");
    const head = element("tr");
    head.append(...["", ...moments].map((text) => element("th", "", text)));
    table.append(head);
    for (const kind of kinds) {
      const row = element("tr");
      row.append(element("th", "", kind));
      for (const moment of moments) row.append(this.cell(kind, moment));
      table.append(row);
    }
    const wide = element("div", "wide");
    wide.append(table);
    return wide;
  }

  private cell(kind: string, moment: string): HTMLTableCellElement {
    const cell = element("td");
    const cases = this.cases.filter((one) => `${one.part} ${one.kind}` === kind && one.moment === moment);
    if (cases.length === 0) return cell;
    const { text, tone } = summary(cases);
    const open = button(text, () => this.list(kind, moment, cases), `cell ${tone}`);
    open.setAttribute("aria-label", `${kind}, ${moment}: ${text}`);
    cell.append(open);
    return cell;
  }

  private list(kind: string, moment: string, cases: Case[]): void {
    const table = element("table");
    const head = element("tr");
    head.append(...["Case", "Verdict", "Broken", "To zero drive", "Run"].map((text) => element("th", "", text)));
    const ordered = [...cases].sort((a, b) => order[a.verdict] - order[b.verdict]);
    table.append(head, ...ordered.slice(0, mostListed).map((one) => this.entry(one)));
    const wide = element("div", "wide");
    wide.append(table);
    this.chosen.replaceChildren(element("h3", "", `${kind}, ${moment}: ${cases.length} cases`), wide);
    if (cases.length > mostListed) this.chosen.append(missingNote(`The first ${mostListed} are shown, failed ones first.`));
    this.chosen.scrollIntoView({ block: "nearest" });
  }

  private entry(one: Case): HTMLTableRowElement {
    const row = element("tr");
    const run = this.kept[one.case];
    const address = run === undefined ? null : addressIn(this.folder, run);
    const link = element(address === null ? "code" : "a", "", address === null ? this.again.replace("CASE", one.case) : "report of the run");
    if (address !== null) (link as HTMLAnchorElement).href = address;
    const drive = one.to_zero_drive_s === undefined ? "" : `${readable(one.to_zero_drive_s * 1e3)} ms`;
    const broken = (one.broken ?? []).map((rule) => `${rule.rule}: ${rule.reason}`).join("; ");
    const name = element("span", "", one.case);
    name.title = one.faults.join("; ");
    for (const content of [name, one.verdict, broken, drive, link]) {
      const cell = element("td");
      cell.append(content);
      row.append(cell);
    }
    return row;
  }
}

export async function showCampaign(host: HTMLElement, folder: Folder): Promise<void> {
  const report = await loadText(`/runs/${folder.name}/matrix.md`);
  const texts = await Promise.all((folder.results ?? []).map((name) => loadText(`/runs/${folder.name}/${name}`)));
  const kept = folder.kept ? (JSON.parse(await loadText(`/runs/${folder.name}/kept.json`)) as Kept) : null;
  const again = /`([^`]* --keep CASE)`/.exec(report)?.[1] ?? "";
  const view = new CampaignView(folder.name, casesIn(texts, kept?.of ?? null), kept?.runs ?? {}, again);
  host.append(view.box, rendered(report, (target) => addressIn(folder.name, target)));
}
