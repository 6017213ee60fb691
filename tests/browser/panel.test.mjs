// node panel.test.mjs BENCH FIXTURES_ROOT WORK_FOLDER SCREENSHOT_FOLDER
//
// Drives the panel as a person would: runs, folders, every eye and hand; then those who must not get
// in or behave badly. Pictures of it come into SCREENSHOT_FOLDER; the README's are from there.
import assert from "node:assert/strict";
import { mkdirSync, rmSync } from "node:fs";
import { join } from "node:path";

import { withBrowser } from "./browser.mjs";
import { browseFolders } from "./panel_browse.mjs";
import { driveController } from "./panel_controller.mjs";
import { driveRuns } from "./panel_drive.mjs";
import { lookAtIt } from "./panel_looks.mjs";
import { behaveBadly, lockOut, sleepAtIt } from "./panel_strangers.mjs";
import { Checks, endRun, listen, overhear, Person, standing, startPanel, statusOf } from "./panel_support.mjs";

const [bench, root, work, shots] = process.argv.slice(2);
if (!shots) {
  console.error("usage: node panel.test.mjs BENCH FIXTURES_ROOT WORK_FOLDER SCREENSHOT_FOLDER");
  process.exit(2);
}
rmSync(work, { recursive: true, force: true });
mkdirSync(work, { recursive: true });
mkdirSync(shots, { recursive: true });

const checks = new Checks();
const runs = join(work, "runs");
const controller = `process:python3 '${join(root, "clients/python/examples/pid.py")}' {address}`;
const panel = startPanel(bench, root, runs, ["--controller", controller]);
const address = await panel.address();
const { hostname, port, origin } = new URL(address);

await withBrowser(async (context) => {
  const page = await context.newPage();
  // Generous: a test that only fails on a busy machine says nothing about the page.
  page.setDefaultTimeout(Number(process.env.TOWBENCH_PATIENCE_MS ?? 180_000));
  const sent = await overhear(page);
  checks.look = () => standing(page, sent);
  checks.recover = () => endRun(page);
  const noise = listen(page, origin);
  await page.setViewportSize({ width: 1440, height: 1100 });

  await checks.run("a wrong ticket opens nothing, the printed one opens the page", async () => {
    assert.equal(await statusOf({ hostname, port, path: "/?ticket=0123456789abcdef0123456789abcdef" }), 403);
    await page.goto(address);
    await page.waitForFunction(() => document.documentElement.dataset.panel === "ready");
    assert.equal(new URL(page.url()).search, "");
  });
  await checks.run("a ticket opens one browser only, and another one is printed", async () => {
    assert.equal(await statusOf({ hostname, port, path: new URL(address).search.replace("?", "/?") }), 403);
    assert.notEqual(await panel.address(), address);
  });

  const world = { checks, person: new Person(page), page, context, bench, root, work, runs, shots, hostname, port, origin };
  const sleeper = await sleepAtIt(world);
  await driveRuns(world);
  await driveController(world);
  await browseFolders(world);
  await lookAtIt(world);
  await lockOut(world);
  await behaveBadly({ ...world, sleeper });
  await checks.run("nothing was said on the browser's console", () => assert.deepEqual(noise, []));
});

panel.child.kill("SIGINT");
const code = await new Promise((done) => panel.child.on("exit", done));
await checks.run("Ctrl-C ends the panel in order", () => assert.equal(code, 0));
console.log(`${checks.passed} of ${checks.passed + checks.failures} checks passed; screenshots in ${shots}`);
process.exit(checks.failures === 0 ? 0 : 1);
