// A controller of one's own in the panel, which was started with --controller.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";

export async function driveController({ checks, person, page, bench, root, runs }) {
  await checks.run("a controller of one's own follows a stated reference", async () => {
    await person.start("any-controller/trapezoid-y", "0");
    assert.match(await page.textContent("#view-run"), /Controller: process:python3/);
    assert.match(await person.over(), /^PASSany-trapezoid-y/);
  });

  await checks.run("held, killed and reset by hand it waits, stops and is told; the run replays", async () => {
    await person.start("any-controller/slow-y", "1", { hold: true, limit_s: 3000 });
    await person.untilTime(1);
    await page.locator("body").press(" ");
    await person.until("Run", /paused/);
    await page.waitForTimeout(2500); // longer than it bears silence
    await page.getByRole("button", { name: /^Go on/ }).click();
    await person.until("Run", /^running$/);
    await person.untilTime((await person.time()) + 0.3);
    await page.click("#kill");
    await person.until("Kill switch", /^pressed$/);
    await person.until("Duty", /^0 \/ 0 %$/);
    await page.click("#kill");
    await person.until("Kill switch", /^released$/);
    await person.type("reset");
    await person.untilTime((await person.time()) + 0.3);
    await page.click("#finish");
    assert.match(await person.over(), /^PASSany-slow-y/);
    const folder = await person.folder();
    assert.match(readFileSync(join(runs, folder, "events.jsonl"), "utf8"), /"operator_reset","axis":"y","lines":0,"value":1/);
    const said = execFileSync(bench, ["replay", join(runs, folder)], { cwd: root, encoding: "utf8" });
    assert.equal(said.match(/identical/g)?.length, 4, said);
  });
}
