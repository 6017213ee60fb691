// node panel_picture.mjs PANEL ROOT EXPERIMENT CONTROLLER PNG [WIDTH HEIGHT]: machine and scopes of a run, as the guide shows them.
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { withBrowser } from "./browser.mjs";
import { listen, Person, startPanel } from "./panel_support.mjs";

const [panel, root, experiment, controller, picture, width = "1180", height = "300"] = process.argv.slice(2);
if (!picture) {
  console.error("usage: node panel_picture.mjs PANEL ROOT EXPERIMENT CONTROLLER PNG [WIDTH HEIGHT]");
  process.exit(2);
}
const runs = mkdtempSync(join(tmpdir(), "towbench-picture-"));
const { child, address } = startPanel(panel, root, runs, ["--controller", controller]);
let noise = [];
try {
  const url = await address();
  await withBrowser(async (context) => {
    const page = await context.newPage();
    noise = listen(page, new URL(url).origin);
    await page.setViewportSize({ width: Number(width), height: 900 });
    await page.goto(url);
    const person = new Person(page);
    await person.start(experiment, "1");
    await person.over();
    await page.screenshot({ path: picture, fullPage: true, clip: { ...(await page.locator(".desk").boundingBox()), height: Number(height) } });
  });
} finally {
  child.kill();
  rmSync(runs, { recursive: true, force: true });
}
for (const line of noise) console.error(line);
process.exit(noise.length > 0 ? 1 : 0);
