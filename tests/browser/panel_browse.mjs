// What is on disk: runs over each other, reports, a campaign's cells, a diagnosis.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, writeFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));

export async function browseFolders({ checks, person, page, context, bench, root, work, runs, shots }) {
  await checks.run("two runs are compared, a report opens in its frame", async () => {
    await page.click('nav a[href="#folders"]');
    await page.waitForSelector(".folder-list td input");
    const boxes = page.locator(".folder-list td input:not([disabled])");
    await boxes.nth(0).check();
    await boxes.nth(1).check();
    await page.click("#compare");
    await page.waitForSelector("#view-folders figure.plot canvas");
    await page.waitForSelector("#view-folders .wide table");
    await page.screenshot({ path: join(shots, "panel-compare.png") });
    await page.locator(".folder-list a").first().click();
    const frame = page.frameLocator("iframe.viewer");
    await frame.locator(".verdict").first().waitFor();
  });

  await checks.run("from a cell of a campaign's matrix to its cases, and to the report of a run", async () => {
    const file = join(work, "one.toml");
    const motion = relative(work, join(root, "fixtures", "motions", "trapezoid-y.toml"));
    const inject = '[[inject]]\nparts = ["kill_switch"]\nkinds = ["pressed"]\nphases = ["cruise"]\nseeds = 2\n';
    writeFileSync(file, `schema = 1\nname = "one"\ntitle = "One"\nseeds = 1\nmotions = ["${motion}"]\n${inject}`);
    execFileSync(bench, ["campaign", file, "--out", join(runs, "campaign"), "--quiet"], { cwd: root });
    await page.getByRole("button", { name: "Look again" }).click();
    await page.getByRole("link", { name: "campaign", exact: true }).click();
    await page.getByRole("button", { name: "kill_switch pressed, cruise: ✓ 2" }).click();
    assert.equal(await page.locator(".cases td a").count(), 2);
    await page.screenshot({ path: join(shots, "panel-campaign.png") });
    const [report] = await Promise.all([context.waitForEvent("page"), page.locator(".cases td a").first().click({ modifiers: ["Control"] })]);
    await report.locator(".verdict").first().waitFor();
    await report.close();
    assert.ok((await page.locator("article table").count()) > 3, "the bench's own report stands below");
  });

  await checks.run("a diagnosis opens: verdict first, what was named, measured against simulated", async () => {
    cpSync(join(here, "diagnosis"), join(runs, "diagnosis"), { recursive: true });
    await page.getByRole("button", { name: "Look again" }).click();
    await page.getByRole("link", { name: "diagnosis", exact: true }).click();
    await page.waitForSelector(".diagnosis .plots canvas");
    assert.match(await page.textContent(".diagnosis .headline"), /^What is wrong: .*\nHow sure:/);
    const named = await page.locator(".diagnosis table").first().textContent();
    assert.match(named, /\[[^\]]+\], 95 %/, named);
    assert.match(await page.textContent(".diagnosis"), /On held-out data.*gain .* %/s);
    const titles = await page.locator(".diagnosis figcaption strong").allTextContents();
    assert.match(titles.join(), /Force, measured against simulated.*Residual/);
    const marks = await person.ink(".diagnosis canvas");
    assert.ok(marks.length === 4 && marks.every((count) => count > 2000), `ink: ${marks}`);
    await page.screenshot({ path: join(shots, "panel-diagnosis.png") });
  });

  const study = join(dirname(bench), "towbench-study");
  if (existsSync(study)) {
    await checks.run("a diagnosis that is made now opens as well", async () => {
      const quietly = { cwd: root, encoding: "utf8" };
      const said = execFileSync(bench, ["run", "fixtures/diagnosis/exercise-y.toml", "--out", work, "--quiet", "--no-report"], quietly);
      execFileSync(study, ["diagnose", "--data", said.trim(), "--out", join(runs, "fresh"), "--quiet"], quietly);
      await page.getByRole("button", { name: "Look again" }).click();
      await page.getByRole("link", { name: "fresh", exact: true }).click();
      await page.waitForSelector(".diagnosis .plots canvas");
      await page.getByRole("heading", { name: "Diagnosis fresh" }).waitFor();
      assert.match(await page.textContent(".diagnosis .headline"), /^What is wrong: nothing/);
    });
  }

  await checks.run("folders that are damaged or hostile are said to be so, and nothing runs", async () => {
    mkdirSync(join(runs, "broken"), { recursive: true });
    writeFileSync(join(runs, "broken", "diagnosis.json"), '{"schema":"towbench/diagnosis/1","verdict":["<img src=x onerror=alert(1)>"],"findings":[]');
    await page.getByRole("button", { name: "Look again" }).click();
    await page.getByRole("link", { name: "broken", exact: true }).click();
    await page.getByText("This diagnosis cannot be shown").waitFor();
    mkdirSync(join(runs, "hostile"), { recursive: true });
    writeFileSync(join(runs, "hostile", "matrix.md"), "# <script>alert(1)</script>\n\n[out](../../etc/passwd) [js](javascript:alert(1))\n");
    writeFileSync(join(runs, "hostile", "results.jsonl"), '{"case":"a<b>","part":"p","kind":"k","moment":"m","verdict":"FAIL","faults":[]}\n{"case":');
    await page.getByRole("button", { name: "Look again" }).click();
    await page.getByRole("link", { name: "hostile", exact: true }).click();
    await page.getByRole("button", { name: /1 of 1 failed/ }).click();
    assert.equal(await page.locator("article a").count(), 0, "no link leads out");
    await page.locator('nav a[href="#folders"]').click();
  });

  await checks.run("what was asked for last is shown alone, though an earlier answer comes later", async () => {
    let letGo;
    const held = new Promise((resolve) => { letGo = resolve; });
    await page.route("**/runs/campaign/results.jsonl", async (route) => { await held; await route.continue(); });
    const asked = page.waitForRequest("**/runs/campaign/results.jsonl");
    await page.getByRole("link", { name: "campaign", exact: true }).click();
    await asked;
    await page.getByRole("link", { name: "diagnosis", exact: true }).click();
    await page.getByRole("heading", { name: "Diagnosis diagnosis" }).waitFor();
    const answered = page.waitForResponse("**/runs/campaign/results.jsonl");
    letGo();
    await (await answered).finished();
    await page.unroute("**/runs/campaign/results.jsonl");
    assert.equal(await page.locator("#view-folders article").count(), 1, "one page at a time");
    await page.locator('nav a[href="#folders"]').click();
  });
}
