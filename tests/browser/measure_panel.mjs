// node measure_panel.mjs BENCH ROOT WORK_FOLDER [BLOCKS]
//
// What an open page does to a run: blocks in alternation, each a run of its own:
//
//   first    `towbench run`, nobody looks on
//   panel    started from the panel's page in Chromium, on the same processors
//   second   as the first again
//
// By the wall clock (wall-clock-window, 1.5 s at 10 kHz and 1 kHz) judged by what realtime.json says
// of the lateness of both loops; in lockstep at full speed (circles-20min) by how long the run took,
// some five seconds: of a shorter run the page's first picture is a large share. The panel is
// compared with the mean of the two blocks around it; second against first is what the host's noise
// alone makes of such a ratio. Nothing is judged here: ratios are printed.
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { join } from "node:path";

import { withBrowser } from "./browser.mjs";
import { Person, startPanel } from "./panel_support.mjs";

const [bench, root, work, count = "15"] = process.argv.slice(2);
if (!work) {
  console.error("usage: node measure_panel.mjs BENCH ROOT WORK_FOLDER [BLOCKS]");
  process.exit(2);
}
rmSync(work, { recursive: true, force: true });
const runs = join(work, "runs");
mkdirSync(runs, { recursive: true });

// What FILE says of a run, whose folder is then gone.
function taken(folder, file) {
  const said = JSON.parse(readFileSync(join(runs, folder, file), "utf8"));
  rmSync(join(runs, folder), { recursive: true });
  return said;
}

function runPlain({ experiment, file, options }) {
  let said = "";
  try {
    said = execFileSync(bench, ["run", experiment, ...options, "--out", runs, "--quiet", "--no-report"], { cwd: root, encoding: "utf8" });
  } catch (error) {
    said = error.stdout; // FAIL or INVALID: it kept time as it kept it
  }
  return taken(said.trimEnd().split("\n").pop().split("/").pop(), file);
}

const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

async function runFromPanel(person, { experiment, file, speed, clock }) {
  await person.choose(experiment, speed, { clock });
  await person.page.waitForSelector("#start:enabled");
  await pause(500); // what was just chosen is drawn by then
  await person.page.evaluate(() => document.getElementById("start").click());
  // Until the report is there nothing is asked of the page: each question costs processor time.
  while (!readdirSync(runs).some((name) => existsSync(join(runs, name, "report.html")))) {
    await pause(100);
  }
  await person.over();
  return taken(await person.folder(), file);
}

async function alternate(person, of, blocks) {
  const kinds = { first: [], panel: [], second: [] };
  for (let block = 0; block < blocks; ++block) {
    kinds.first.push(runPlain(of));
    kinds.panel.push(await runFromPanel(person, of));
    kinds.second.push(runPlain(of));
  }
  return kinds;
}

const byTheClock = { experiment: "wall-clock-window", file: "realtime.json", options: ["--clock", "real"], speed: "1", clock: "real" };
const inLockstep = { experiment: "circles-20min", file: "result.json", options: [], speed: "0" };

const sorted = (values) => [...values].sort((a, b) => a - b);
const median = (values) => sorted(values)[Math.floor(values.length / 2)];
const spread = (values) => {
  const all = sorted(values);
  return `${all[Math.floor(all.length / 4)].toFixed(1)} to ${all[Math.floor((3 * all.length) / 4)].toFixed(1)}`;
};

// Of pairs of neighbours, so that what the host does in the course of the measurement falls out:
// the median of the ratios, and where 95 % of the medians of blocks drawn again lie.
function paired(ratios) {
  let state = 1; // of a generator that says the same each time
  const drawn = () => (state = (state * 48271) % 2147483647) / 2147483647;
  const medians = Array.from({ length: 2000 }, () => median(ratios.map(() => ratios[Math.floor(drawn() * ratios.length)])));
  const all = sorted(medians);
  return `${median(ratios).toFixed(3)} [${all[50].toFixed(3)}, ${all[1949].toFixed(3)}]`;
}

function tell(name, kinds, value) {
  const of = (kind) => kinds[kind].map(value);
  const plain = [...of("first"), ...of("second")];
  const beside = of("panel").map((with_, block) => (2 * with_) / (of("first")[block] + of("second")[block]));
  const noise = of("first").map((first, block) => of("second")[block] / first);
  const shown = (values) => `${median(values).toFixed(1)} (${spread(values)})`;
  console.log(
    `${name}  without ${shown(plain)}  with panel ${shown(of("panel"))}` +
      `  ratio of neighbours ${paired(beside)}  noise (second over first) ${paired(noise)}`,
  );
}

const panel = startPanel(bench, root, runs);
let lateness;
await withBrowser(async (context) => {
  const page = await context.newPage();
  page.setDefaultTimeout(90_000);
  await page.goto(await panel.address());
  await page.waitForFunction(() => document.documentElement.dataset.panel === "ready");
  const person = new Person(page);
  const lockstep = await alternate(person, inLockstep, Math.ceil(Number(count) / 2));
  console.log(`medians over alternating blocks of each kind (middle half of them): ${lockstep.first.length} in lockstep, ${count} by the wall clock`);
  tell("twenty minutes in lockstep, ms", lockstep, (result) => result.wall_time_s * 1e3);
  lateness = await alternate(person, byTheClock, Number(count));
});
panel.child.kill("SIGINT");

for (const side of ["emulator", "controller"]) {
  for (const what of ["p50_ns", "p99_ns", "p999_ns"]) {
    tell(`${side.padEnd(10)} lateness ${what.replace("_ns", "").padEnd(4)}, us`, lateness, (both) => both[side].lateness[what] / 1e3);
  }
  const sum = (kind, what) => lateness[kind].reduce((total, both) => total + both[side][what], 0);
  console.log(`${side.padEnd(10)} overruns per block: ${["first", "panel", "second"].map((kind) => `${kind} ${(sum(kind, "overruns") / Number(count)).toFixed(1)}`).join(", ")}`);
}
process.exit(0);
