// Fills every plot host of the page from the data block of its run.
import "./licence";
import plotStyle from "uplot/dist/uPlot.min.css";

import { readRunData, type RunData } from "./data";
import { element, missingNote } from "./dom";
import { axisFigures, type Figure, otherFigures, stoodStill } from "./figures";
import { stateSpans } from "./marks";
import { TimeGroup } from "./time_group";
import { addTimePlot } from "./time_plot";
import { addToolbar } from "./toolbar";
import { addPath, hasPath } from "./xy_path";

const axisNames = ["y", "x", "z", "a", "b", "c"];

function addHeading(host: HTMLElement, text: string): void {
  const level = Math.min(Number(host.dataset.level) || 3, 6);
  host.append(element(`h${level}` as "h3", "", text));
}

function addFigures(host: HTMLElement, run: RunData, group: TimeGroup, figures: Figure[]): void {
  for (const figure of figures) {
    const events = run.events.filter(
      (event) => event.axis === "" || figure.axis === "" || event.axis === figure.axis,
    );
    const state = run.table.columns.get(`${figure.axis}_state`);
    addTimePlot(host, figure, group, { events, spans: stateSpans(group.time, state) });
  }
}

function addRun(host: HTMLElement, run: RunData): void {
  const time = run.table.columns.get("time_s");
  if (time === undefined || time.length === 0) {
    host.append(missingNote("The log has no row: nothing can be plotted."));
    return;
  }
  if (run.table.rowsPerBucket > 1) {
    host.append(
      element(
        "p",
        "note",
        `The log has ${run.table.sourceRows} rows. To keep this page small, each stretch of ` +
          `${run.table.rowsPerBucket} rows is shown by its smallest and largest values; log.csv has all.`,
      ),
    );
  }
  const group = new TimeGroup(`run-${host.dataset.run}`, time);
  const isPlane = !run.limits.y?.turns && !run.limits.x?.turns;
  if (isPlane && hasPath(run.table)) addPath(host, run.table, group);
  addToolbar(host, group, run.windows);
  for (const axis of axisNames) {
    const figures = axisFigures(run, axis);
    if (figures.length === 0) continue;
    addHeading(host, run.limits[axis]?.turns ? `Axis ${axis}, in radians` : `Axis ${axis}`);
    if (stoodStill(run.table, axis)) {
      host.append(
        missingNote("This axis neither moved nor was driven in this run, so it has no plots."),
      );
    } else {
      addFigures(host, run, group, figures);
    }
  }
  const others = otherFigures(run);
  if (others.length > 0) {
    addHeading(host, "Other channels");
    addFigures(host, run, group, others);
  }
}

function fill(host: HTMLElement): void {
  const block = document.getElementById(`run-data-${host.dataset.run}`);
  try {
    addRun(host, readRunData(block?.textContent ?? ""));
  } catch (error) {
    host.append(missingNote(`The plots could not be drawn: ${String(error)}`));
    throw error;
  }
}

// A plot needs the width of what it stands in, which a closed fold has not.
function fillWhenOpen(host: HTMLElement): void {
  const fold = host.closest<HTMLDetailsElement>("details.run");
  if (fold === null || fold.open) {
    fill(host);
    return;
  }
  fold.addEventListener("toggle", () => fill(host), { once: true });
}

function openNamedFold(): void {
  const named = document.getElementById(location.hash.slice(1));
  if (named instanceof HTMLDetailsElement) {
    named.open = true;
    named.scrollIntoView();
  }
}

document.head.append(element("style", "", plotStyle));
for (const host of document.querySelectorAll<HTMLElement>(".plot-host")) fillWhenOpen(host);
window.addEventListener("hashchange", openNamedFold);
openNamedFold();
document.documentElement.dataset.plots = "ready";
