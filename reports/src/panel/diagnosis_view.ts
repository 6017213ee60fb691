// A diagnosis on disk: verdict first, then what was named and how sure, then measured against
// simulated. From its files alone; what made them need not be there.
import { element, missingNote } from "../dom";
import { readable } from "../units";
import { type Folder, loadText } from "./catalogue";
import { parseLog } from "./csv";
import { type Cause, type Diagnosis, knownSchema, type Sized } from "./diagnosis_data";
import { diagnosisPlots } from "./diagnosis_plots";

function interval(sized: Sized, unit = ""): string {
  const [ends, share] = sized.ci95 != null ? [sized.ci95, 95] : [sized.ci99 ?? null, 99];
  const range = ends === null ? "" : ` [${readable(ends[0])}, ${readable(ends[1])}], ${share} %`;
  return `${readable(sized.value)}${unit}${range}`;
}

// The first lines that `towbench diagnose` printed; of folders older than these, its words.
async function headline(folder: Folder, diagnosis: Diagnosis): Promise<HTMLElement> {
  if (!folder.headline) return element("p", "headline", diagnosis.verdict.join(", ").replace(/_/g, " "));
  const lines = (await loadText(`/runs/${folder.name}/headline.txt`)).trimEnd().split("\n");
  return element("pre", "headline", lines.filter((line) => !line.startsWith("  ")).join("\n"));
}

function table(heads: string[], rows: string[][], empty: string): HTMLElement {
  if (rows.length === 0) return missingNote(empty);
  const made = element("table");
  const head = element("tr");
  head.append(...heads.map((text) => element("th", "", text)));
  made.append(
    head,
    ...rows.map((cells) => {
      const row = element("tr");
      row.append(...cells.map((text) => element("td", "", text)));
      return row;
    }),
  );
  const wide = element("div", "wide");
  wide.append(made);
  return wide;
}

function causeRow(cause: Cause): string[] {
  const sizes = Object.entries(cause.parameters).map(([name, sized]) => `${name}: ${interval(sized)}`);
  const next = cause.separating_experiment;
  return [
    [cause.effect, ...cause.indistinguishable_from].join(" or "),
    cause.meaning,
    sizes.join("; "),
    cause.gain_heldout_pct === null ? "" : interval(cause.gain_heldout_pct, " %"),
    next === null ? "" : `${next.motion}: tells it from ${next.separates_from}`,
  ];
}

function parts(d: Diagnosis): HTMLElement[] {
  const parameters = Object.entries(d.parameters ?? {}).map(([name, one]) => [name, `${readable(one.supplied)} ${one.unit}`, `${interval(one)} ${one.unit}`]);
  const made = [
    element("h3", "", "What was named"),
    table(["Effect", "Meaning", "Size", "Gain on held-out data", "What to measure next"], (d.causes ?? []).map(causeRow), "Nothing was named."),
    element("h3", "", "Parameters that are off"),
    table(["Parameter", "Model", "Data"], parameters, "None by more than its error."),
  ];
  if (d.heldout !== undefined) {
    const { baseline, extended, gain_pct: gain, same_session: same } = d.heldout;
    const words =
      `On held-out data${same ? " of the same session" : ""}: ${readable(baseline.force_error_rms_N)} N rms ` +
      `before, ${readable(extended.force_error_rms_N)} N rms after; gain ${interval(gain, " %")}.`;
    made.push(element("p", "", words));
  }
  const left = d.unexplained;
  const words =
    left == null
      ? "Left over: nothing that the residual tests can see."
      : `Left over: ${readable(left.rms_N)} N rms along ${left.coordinate}, ${readable(left.share_of_residual_pct)} % of the residual, which no effect explains.`;
  made.push(element("p", "", words));
  return made;
}

function details(d: Diagnosis): HTMLElement {
  const made = element("details");
  const rejected = (d.rejected ?? []).map((one) => [one.effect, one.p_value.toExponential(1), interval(one.gain_heldout_pct, " %")]);
  made.append(
    element("summary", "", "What was rejected, and what this data could not show"),
    table(["Rejected", "p", "Gain on held-out data"], rejected, "Nothing came near."),
    table(["Could not be tested", "Why", "Needs"], (d.not_testable ?? []).map((one) => [one.effect, one.why, one.needs]), "Everything could be tested."),
  );
  return made;
}

export async function showDiagnosis(host: HTMLElement, folder: Folder): Promise<void> {
  const article = element("article", "diagnosis");
  host.append(article);
  try {
    const diagnosis = JSON.parse(await loadText(`/runs/${folder.name}/diagnosis.json`)) as Diagnosis;
    if (diagnosis.schema !== knownSchema) throw new Error(`diagnosis.json is of schema ${diagnosis.schema}, not ${knownSchema}`);
    article.append(element("h2", "", `Diagnosis ${folder.name}`), await headline(folder, diagnosis));
    for (const { sentence, fatal } of diagnosis.findings) article.append(element("p", fatal ? "trouble" : "note", sentence));
    if (diagnosis.causes === undefined) return; // the data cannot be used; why stands above
    article.append(...parts(diagnosis));
    const plots = element("div", "plots");
    article.append(plots, details(diagnosis));
    if (folder.report) {
      const link = element("a", "", "the whole report");
      link.href = `/runs/${folder.name}/report.html`;
      article.append(link);
    }
    plots.append(...diagnosisPlots(parseLog(await loadText(`/runs/${folder.name}/residual.csv`))));
  } catch (error) {
    article.append(missingNote(`This diagnosis cannot be shown: ${String(error)}`));
  }
}
