// node report.test.mjs REPORT_HTML RUN_FOLDER SCREENSHOT_FOLDER
//
// Opens a report as a person would and compares what it shows with the files of its run.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";

import { openPage, withBrowser } from "./browser.mjs";

const [report, folder, shots] = process.argv.slice(2);
if (!report || !folder || !shots) {
  console.error("usage: node report.test.mjs REPORT_HTML RUN_FOLDER SCREENSHOT_FOLDER");
  process.exit(2);
}
mkdirSync(shots, { recursive: true });
const readJson = (name) => JSON.parse(readFileSync(join(folder, name), "utf8"));
const result = readJson("result.json");
const metrics = readJson("metrics.json").metrics;
const log = readFileSync(join(folder, "log.csv"), "utf8").trimEnd().split("\n");
const columns = log[0].split(",");

let failures = 0;
let passed = 0;
async function check(name, body) {
  try {
    await body();
    ++passed;
    console.log(`ok   ${name}`);
  } catch (error) {
    ++failures;
    console.log(`FAIL ${name}\n     ${String(error.message ?? error).replace(/\n/g, "\n     ")}`);
  }
}

// Pixels that differ from the canvas's transparent ground, in every plot.
const inkOf = (page) =>
  page.$$eval("figure.plot canvas", (canvases) =>
    canvases.map((canvas) => {
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      let ink = 0;
      for (let i = 3; i < data.length; i += 4) if (data[i] > 0) ++ink;
      return { plot: canvas.closest("figure").dataset.plot, ink, pixels: canvas.width * canvas.height };
    }),
  );

const plain = (text) => text.replace(/\u2212/g, "-").replace(/\u00a0/g, " ");
const perSi = { m: 1, mm: 1e3, "µm": 1e6, "m/s": 1, "mm/s": 1e3, "µm/s": 1e6, s: 1, ms: 1e3, "µs": 1e6, mJ: 1e3 };

function shownInSi(text) {
  const [number, ...unit] = plain(text).trim().split(" ");
  return Number(number) / (perSi[unit.join(" ")] ?? 1);
}

// Four significant digits are shown.
function assertShown(text, value, what) {
  const shown = shownInSi(text);
  assert.ok(
    Math.abs(shown - value) <= 6e-4 * Math.abs(value) + 1e-300,
    `${what}: the page shows "${text}", the file says ${value}`,
  );
}

async function checkNumbers(page) {
  await check("the verdict is that of result.json", async () => {
    const word = await page.textContent(".verdict .word");
    assert.equal(word, result.status === "complete" ? result.verdict : "INCOMPLETE");
  });
  await check("every check of result.json stands in the table with its value", async () => {
    const rows = await page.$$eval(".checks tbody tr", (all) =>
      all.map((row) => ({ ...row.dataset, shown: row.querySelector(".value").textContent })),
    );
    assert.equal(rows.length, result.checks.length);
    result.checks.forEach((expected, i) => {
      assert.equal(rows[i].metric, expected.name);
      if (expected.value === null) return;
      assert.equal(Number(rows[i].value), expected.value);
      assertShown(rows[i].shown, expected.value, expected.name);
    });
  });
  await check("every metric of metrics.json stands in the list with its value", async () => {
    await page.$$eval("details", (all) => all.forEach((d) => (d.open = true)));
    const rows = await page.$$eval(".metrics tbody tr", (all) =>
      all.map((row) => ({ ...row.dataset, shown: row.children[2].textContent })),
    );
    assert.equal(rows.length, metrics.length);
    metrics.forEach((expected, i) => {
      assert.equal(rows[i].metric, expected.name);
      if (expected.value !== null) assertShown(rows[i].shown, expected.value, expected.name);
    });
  });
}

async function checkPlots(page) {
  await check("every plot has a canvas with ink on it, or says why not", async () => {
    const figures = await page.$$eval("figure.plot", (all) =>
      all.map((f) => ({ plot: f.dataset.plot, canvas: !!f.querySelector("canvas"), said: f.querySelector(".missing")?.textContent ?? "" })),
    );
    assert.ok(figures.length >= 4, `only ${figures.length} plots`);
    for (const f of figures) assert.ok(f.canvas || f.said !== "", `${f.plot} is neither drawn nor explained`);
    for (const { plot, ink, pixels } of await inkOf(page)) {
      assert.ok(ink > pixels / 500, `${plot}: ${ink} of ${pixels} pixels`);
    }
  });
  await check("the cursor reads out the value of log.csv", async () => {
    const figure = page.locator('figure[data-plot="y-position"]');
    await figure.scrollIntoViewIfNeeded();
    const box = await figure.locator(".u-over").boundingBox();
    await page.mouse.move(box.x + box.width * 0.6, box.y + box.height / 2);
    const time = parseFloat((await page.textContent(".toolbar .cursor")).replace("at ", ""));
    const row = log.slice(1).map((line) => line.split(",").map(Number)).find((r) => Math.abs(r[0] - time) < 6e-5);
    assert.ok(row, `no row at ${time} s`);
    const entries = await figure.locator(".entry").allTextContents();
    const shown = entries.find((text) => text.startsWith("motor side")).replace("motor side", "");
    const value = row[columns.indexOf("y_position_m")];
    assert.ok(Math.abs(shownInSi(shown) - value) < 6e-4 * Math.abs(value) + 1e-7, `${shown} against ${value}`);
  });
  await check("a drag zooms all plots of the run, and reset shows all again", async () => {
    const range = () => page.textContent(".toolbar .range");
    const whole = await range();
    const box = await page.locator('figure[data-plot="y-position"] .u-over').boundingBox();
    await page.mouse.move(box.x + box.width * 0.3, box.y + 40);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width * 0.5, box.y + 40, { steps: 4 });
    await page.mouse.up();
    const zoomed = await range();
    assert.notEqual(zoomed, whole);
    await page.getByRole("button", { name: "Show the whole run" }).first().click();
    assert.equal(await range(), whole);
  });
  await check("the keyboard zooms and moves the cursor", async () => {
    const figure = page.locator('figure[data-plot="y-position"]');
    await figure.focus();
    const whole = await page.textContent(".toolbar .range");
    await page.keyboard.press("+");
    assert.notEqual(await page.textContent(".toolbar .range"), whole);
    await page.keyboard.press("ArrowRight");
    assert.match(await page.textContent(".toolbar .cursor"), /^at /);
    await page.keyboard.press("0");
    assert.equal(await page.textContent(".toolbar .range"), whole);
  });
}

async function checkInert(page) {
  await check("nothing that the run wrote has run as a script", async () => {
    const trace = await page.evaluate(() => document.documentElement.dataset.hostile ?? "");
    assert.equal(trace, "");
    assert.equal(await page.locator("main script, main img, main [onmouseover]").count(), 0);
  });
}

await withBrowser(async (context) => {
  const { page, noise } = await openPage(context, report);
  await page.screenshot({ path: join(shots, "light.png"), fullPage: true });
  await checkNumbers(page);
  await checkPlots(page);
  await checkInert(page);

  const dark = await openPage(context, report, { colorScheme: "dark" });
  await dark.page.screenshot({ path: join(shots, "dark.png"), fullPage: true });

  const phone = await openPage(context, report, { viewport: { width: 360, height: 740 } });
  await phone.page.screenshot({ path: join(shots, "phone.png"), fullPage: true });
  await check("a phone of 360 pixels shows the page without sideways scrolling", async () => {
    await phone.page.$$eval("details", (all) => all.forEach((d) => (d.open = true)));
    const width = await phone.page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(width <= 360, `${width} pixels wide`);
  });

  const paper = await openPage(context, report, { colorScheme: "dark" });
  await paper.page.emulateMedia({ media: null, colorScheme: "dark" });
  await paper.page.pdf({ path: join(shots, "print.pdf"), format: "A4", margin: { top: "15mm", bottom: "15mm", left: "15mm", right: "15mm" } });
  await paper.page.emulateMedia({ media: "print" });
  await paper.page.setViewportSize({ width: 720, height: 1000 });
  await paper.page.addStyleTag({ content: "html { filter: grayscale(1); }" }).catch(() => {});
  await paper.page.screenshot({ path: join(shots, "print.png"), fullPage: true });

  await check("the console stays clean and nothing but the file is fetched", async () => {
    assert.deepEqual([...noise, ...dark.noise, ...phone.noise, ...paper.noise], []);
  });
});
console.log(`\n${passed} passed, ${failures} failed`);
process.exit(failures > 0 ? 1 : 0);
