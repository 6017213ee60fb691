// node measure_panel.mjs BENCH ROOT WORK_FOLDER [BLOCKS]
//
// Whether an open panel makes a run by the wall clock late: blocks in alternation, each a run of
// wall-clock-window (1.5 s at 10 kHz and 1 kHz), judged by what realtime.json says of both loops:
//
//   first    `towbench run --clock real`, nobody looks on
//   panel    started from the panel's page in Chromium, which draws all the while
//   second   as the first again
//
// The panel is compared with all blocks without it; second against first is what the host's noise
// alone makes of such a ratio. Nothing is judged here: the ratios are printed.
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync } from "node:fs";
import { join } from "node:path";

import { withBrowser } from "./browser.mjs";
import { Person, startPanel } from "./panel_support.mjs";

const [bench, root, work, count = "15"] = process.argv.slice(2);
if (!work) {
  console.error("usage: node measure_panel.mjs BENCH ROOT WORK_FOLDER [BLOCKS]");
  process.exit(2);
}
rmSync(work, { recursive: true, force: true });
mkdirSync(work, { recursive: true });
const runs = join(work, "runs");
const kinds = { first: [], panel: [], second: [] };

function lateness(folder) {
  const both = JSON.parse(readFileSync(join(runs, folder, "realtime.json"), "utf8"));
  rmSync(join(runs, folder), { recursive: true });
  return both;
}

function runPlain() {
  let said = "";
  try {
    said = execFileSync(bench, ["run", "wall-clock-window", "--clock", "real", "--out", runs, "--quiet", "--no-report"], { cwd: root, encoding: "utf8" });
  } catch (error) {
    said = error.stdout; // FAIL or INVALID: it kept time as it kept it
  }
  return lateness(said.trimEnd().split("\n").pop().split("/").pop());
}

async function runFromPanel(person) {
  await person.start("wall-clock-window", "1", { clock: "real" });
  await person.over();
  return lateness(await person.folder());
}

const panel = startPanel(bench, root, runs);
await withBrowser(async (context) => {
  const page = await context.newPage();
  page.setDefaultTimeout(90_000);
  await page.goto(await panel.address());
  await page.waitForFunction(() => document.documentElement.dataset.panel === "ready");
  const person = new Person(page);
  for (let block = 0; block < Number(count); ++block) {
    kinds.first.push(runPlain());
    kinds.panel.push(await runFromPanel(person));
    kinds.second.push(runPlain());
  }
});
panel.child.kill("SIGINT");

const sorted = (values) => [...values].sort((a, b) => a - b);
const median = (values) => sorted(values)[Math.floor(values.length / 2)];
const spread = (values) => {
  const all = sorted(values);
  return `${(all[Math.floor(all.length / 4)] / 1e3).toFixed(1)} to ${(all[Math.floor((3 * all.length) / 4)] / 1e3).toFixed(1)}`;
};
console.log(`lateness, medians over ${count} alternating blocks of each kind (middle half of the blocks), us`);
for (const side of ["emulator", "controller"]) {
  for (const what of ["p50_ns", "p99_ns", "p999_ns"]) {
    const of = (kind) => kinds[kind].map((both) => both[side].lateness[what]);
    const plain = [...of("first"), ...of("second")];
    const shown = (values) => `${(median(values) / 1e3).toFixed(1)} (${spread(values)})`;
    console.log(
      `${side.padEnd(10)} ${what.replace("_ns", "").padEnd(4)}  without ${shown(plain)}  with panel ${shown(of("panel"))}` +
        `  ratio ${(median(of("panel")) / median(plain)).toFixed(3)}  noise (second over first) ${(median(of("second")) / median(of("first"))).toFixed(3)}`,
    );
  }
  const sum = (kind, what) => kinds[kind].reduce((total, both) => total + both[side][what], 0);
  console.log(`${side.padEnd(10)} overruns per block: ${["first", "panel", "second"].map((kind) => `${kind} ${(sum(kind, "overruns") / Number(count)).toFixed(1)}`).join(", ")}`);
}
process.exit(0);
