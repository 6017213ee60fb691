// node panel.test.mjs BENCH FIXTURES_ROOT WORK_FOLDER SCREENSHOT_FOLDER
//
// Drives the panel as a person would: start, look, kill, reset, finish, replay, compare, browse; then
// those who must not get in.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { request } from "node:http";
import { connect } from "node:net";
import { join, relative } from "node:path";

import { withBrowser } from "./browser.mjs";

const [bench, root, work, shots] = process.argv.slice(2);
if (!shots) {
  console.error("usage: node panel.test.mjs BENCH FIXTURES_ROOT WORK_FOLDER SCREENSHOT_FOLDER");
  process.exit(2);
}
rmSync(work, { recursive: true, force: true });
mkdirSync(work, { recursive: true });
mkdirSync(shots, { recursive: true });
const runs = join(work, "runs");

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

// The panel's process; `address` resolves with each address that it prints.
function startPanel() {
  const child = spawn(bench, ["panel", "--out", runs], { cwd: root, stdio: ["ignore", "pipe", "inherit"] });
  const waiting = [];
  const seen = [];
  let text = "";
  child.stdout.on("data", (bytes) => {
    text += bytes;
    for (let end = text.indexOf("\n"); end >= 0; end = text.indexOf("\n")) {
      const line = text.slice(0, end);
      text = text.slice(end + 1);
      if (!line.startsWith("http://")) continue;
      if (waiting.length > 0) waiting.shift()(line);
      else seen.push(line);
    }
  });
  const address = () => (seen.length > 0 ? Promise.resolve(seen.shift()) : new Promise((done) => waiting.push(done)));
  return { child, address };
}

const lamp = (page, name) => page.locator(`[data-lamp="${name}"]`).textContent();
async function until(page, name, pattern) {
  await page.waitForFunction(
    ([lampName, source]) => new RegExp(source).test(document.querySelector(`[data-lamp="${lampName}"]`)?.textContent ?? ""),
    [name, pattern.source],
  );
}
const ink = (page) =>
  page.$$eval(".scope canvas", (canvases) =>
    canvases.map((canvas) => {
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let i = 3; i < data.length; i += 4) if (data[i] > 0) ++count;
      return count;
    }),
  );
async function type(page, line) {
  await page.fill("#console-line", line);
  await page.press("#console-line", "Enter");
}
let runsSeen = "";  // number of the run whose result the page shows
const start = async (page, experiment, speed, options = {}) => {
  runsSeen = (await page.getAttribute("#result", "data-of")) ?? "";
  await page.selectOption("#experiment", experiment);
  await page.selectOption("#start-speed", speed);
  await page.getByLabel("go on after the script").setChecked(options.hold ?? false);
  await page.click("#start");
};
const over = (page) =>
  page.waitForFunction((before) => {
    const result = document.getElementById("result");
    return (result.dataset.of ?? "") !== before && /PASS|FAIL|INVALID|no verdict/.test(result.textContent);
  }, runsSeen);
const statusOf = (options, socketHeaders = false) =>
  new Promise((done, fail) => {
    const asked = request({ ...options, method: options.method ?? "GET" }, (answer) => {
      answer.resume();
      done(answer.statusCode);
    });
    asked.on("upgrade", (_answer, socket) => {
      socket.destroy();
      done(101);
    });
    asked.on("error", fail);
    if (socketHeaders) {
      asked.setHeader("Connection", "Upgrade");
      asked.setHeader("Upgrade", "websocket");
      asked.setHeader("Sec-WebSocket-Version", "13");
      asked.setHeader("Sec-WebSocket-Key", "dGhlIHNhbXBsZSBub25jZQ==");
    }
    asked.end();
  });

const panel = startPanel();
const address = await panel.address();
const { hostname, port, origin } = new URL(address);

await withBrowser(async (context) => {
  const page = await context.newPage();
  // Generous: a test that only fails on a busy machine says nothing about the page.
  page.setDefaultTimeout(Number(process.env.TOWBENCH_PATIENCE_MS ?? 90_000));
  const noise = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) noise.push(`console: ${message.text()}`);
  });
  page.on("pageerror", (error) => noise.push(`exception: ${error.message}`));
  page.on("request", (asked) => {
    if (!asked.url().startsWith(origin) && !asked.url().startsWith("data:")) noise.push(`request: ${asked.url()}`);
  });
  await page.setViewportSize({ width: 1440, height: 1100 });

  await check("a wrong ticket opens nothing, the printed one opens the page", async () => {
    assert.equal(await statusOf({ hostname, port, path: "/?ticket=0123456789abcdef0123456789abcdef" }), 403);
    await page.goto(address);
    await page.waitForFunction(() => document.documentElement.dataset.panel === "ready");
    assert.equal(new URL(page.url()).search, "");
  });

  await check("a ticket opens one browser only, and another one is printed", async () => {
    assert.equal(await statusOf({ hostname, port, path: new URL(address).search.replace("?", "/?") }), 403);
    assert.notEqual(await panel.address(), address);
  });

  let driven = "";
  await check("the circle starts, the plots move", async () => {
    await start(page, "circle", "1", { hold: true });
    await until(page, "Run", /^running/);
    await page.waitForFunction(() => Number.parseFloat(document.querySelector('[data-lamp="Virtual time"]').textContent) > 4);
    const marks = await ink(page);
    assert.ok(marks.length >= 6 && marks.every((count) => count > 300), `ink: ${marks}`);
    const first = Number.parseFloat(await lamp(page, "Virtual time"));
    await page.waitForFunction((t) => Number.parseFloat(document.querySelector('[data-lamp="Virtual time"]').textContent) > t + 1, first);
    await page.screenshot({ path: join(shots, "panel-circle.png") });
  });

  await check("paused it stands, a step of 100 ms is a step of 100 ms, and it goes on", async () => {
    await page.locator("body").press(" ");
    await until(page, "Run", /paused/);
    await page.waitForTimeout(200);
    const before = Number.parseFloat(await lamp(page, "Virtual time"));
    await page.waitForTimeout(300);
    assert.equal(Number.parseFloat(await lamp(page, "Virtual time")), before);
    await page.selectOption("#step-length", "100");
    await page.getByRole("button", { name: /^Step/ }).click();
    await page.waitForFunction((t) => Number.parseFloat(document.querySelector('[data-lamp="Virtual time"]').textContent) >= t + 0.1 - 1e-9, before);
    await page.waitForTimeout(200);
    const after = Number.parseFloat(await lamp(page, "Virtual time"));
    assert.ok(Math.abs(after - before - 0.1) < 2e-3, `${before} to ${after}`);
    await page.getByRole("button", { name: /^Go on/ }).click();
    await until(page, "Run", /^running$/);
  });

  await check("the kill switch takes the drive and latches; mended and reset it is free", async () => {
    await page.click("#kill");
    await until(page, "Kill switch", /^pressed$/);
    await until(page, "Fault", /latched/);
    await until(page, "Duty", /^0 \/ 0 %$/);
    await page.screenshot({ path: join(shots, "panel-killed.png") });
    await type(page, "reset systate");
    await page.waitForFunction(() => document.querySelector(".terminal").textContent.includes("error"));
    await page.click("#kill");
    await until(page, "Kill switch", /^released$/);
    await type(page, "reset systate");
    await until(page, "Fault", /^none$/);
    await type(page, "status");
    await page.waitForFunction(() => document.querySelector(".terminal").textContent.includes("amplifier"));
    await page.click("#finish");
    await over(page);
    const words = await page.textContent("#result");
    assert.match(words, /^circle: PASS/, words);
    driven = (await page.getAttribute("#result a", "href")).split("/")[1];
  });

  await check("what was done by hand is in events.jsonl and replays bit for bit", async () => {
    const events = readFileSync(join(runs, driven, "events.jsonl"), "utf8");
    for (const kind of ["fault", "mended", "typed", "clock", "holds", "finished"]) {
      assert.ok(events.includes(`"side":"hand","kind":"${kind}"`), `no ${kind} in events.jsonl`);
    }
    const said = execFileSync(bench, ["replay", join(runs, driven)], { cwd: root, encoding: "utf8" });
    assert.equal(said.match(/identical/g)?.length, 3, said);
  });

  await check("an end-stop that is tripped by hand stops the axis", async () => {
    await start(page, "trapezoid-400", "1", { hold: true });
    await until(page, "Y", /^position$/);
    await page.waitForFunction(() => Number.parseFloat(document.querySelector('[data-lamp="Virtual time"]').textContent) > 2);
    await page.getByRole("button", { name: "Trip y max" }).click();
    await until(page, "Fault", /latched/);
    await page.click("#finish");
    await over(page);
    assert.match(await page.textContent("#result"), /PASS/);
  });

  await check("an undisturbed run from the panel is judged like any other", async () => {
    await start(page, "circle", "0");
    await over(page);
    assert.match(await page.textContent("#result"), /^circle: PASS/);
    execFileSync(bench, ["run", "circle", "--out", runs, "--quiet"], { cwd: root });
  });

  await check("nonsense is refused in words, and a second run while one is under way", async () => {
    await page.evaluate(() => {
      window.answers = [];
      const socket = new WebSocket(`ws://${location.host}/live`);
      socket.onmessage = (event) => window.answers.push(event.data);
      socket.onopen = () => {
        for (const text of ["{", "[]", '{"do":"fly"}', '{"do":"step","ms":-1}', '{"do":"break","fault":"moon full"}', '{"do":"pause"}']) socket.send(text);
      };
    });
    await page.waitForFunction(() => window.answers.filter((text) => text.includes("refused")).length === 6);
  });

  await check("two runs are compared, a report opens in its frame", async () => {
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

  await check("a campaign's matrix is shown, and its worst case is one click away", async () => {
    const file = join(work, "one.toml");
    const motion = relative(work, join(root, "fixtures", "motions", "trapezoid-y.toml"));
    const inject = '[[inject]]\nparts = ["kill_switch"]\nkinds = ["pressed"]\nphases = ["cruise"]\nseeds = 2\n';
    writeFileSync(file, `schema = 1\nname = "one"\ntitle = "One"\nseeds = 1\nmotions = ["${motion}"]\n${inject}`);
    execFileSync(bench, ["campaign", file, "--out", join(runs, "campaign"), "--quiet"], { cwd: root });
    await page.getByRole("button", { name: "Look again" }).click();
    await page.getByRole("link", { name: "campaign", exact: true }).click();
    await page.locator("article table").first().waitFor();
    const [report] = await Promise.all([context.waitForEvent("page"), page.locator("article a").first().click({ modifiers: ["Control"] })]);
    await report.locator(".verdict").first().waitFor();
    await report.close();
  });

  await check("a small window and the dark hold the page", async () => {
    await page.click('nav a[href="#run"]');
    await page.setViewportSize({ width: 820, height: 1180 });
    await page.emulateMedia({ colorScheme: "dark" });
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
    assert.ok(wide <= 0, `${wide} pixels too wide`);
    await page.screenshot({ path: join(shots, "panel-tablet-dark.png") });
  });

  await check("strangers, other names, other origins and paths upwards get nothing", async () => {
    const cookie = (await context.cookies(origin)).map((one) => `${one.name}=${one.value}`).join("; ");
    const as = (headers, path = "/api/folders") => ({ hostname, port, path, headers });
    assert.equal(await statusOf(as({})), 403);
    assert.equal(await statusOf(as({ Cookie: "towbench=00" })), 403);
    assert.equal(await statusOf(as({ Cookie: cookie })), 200);
    assert.equal(await statusOf(as({ Cookie: cookie, Host: `evil.example:${port}` })), 421);
    assert.equal(await statusOf(as({ Cookie: cookie, Origin: "http://evil.example" })), 403);
    for (const path of ["/runs/../../etc/passwd", "/runs/%2e%2e/x.html", "/runs//etc/passwd", "/runs/.hidden/report.html", "/runs/"]) {
      assert.equal(await statusOf(as({ Cookie: cookie }, path)), 404, path);
    }
    assert.equal(await statusOf({ ...as({ Cookie: cookie }), method: "POST" }), 405);
    assert.equal(await statusOf(as({}, "/live"), true), 403);
    assert.equal(await statusOf(as({ Cookie: cookie, Origin: "http://evil.example" }, "/live"), true), 403);
    assert.equal(await statusOf(as({ Cookie: cookie, Origin: origin }, "/live"), true), 101);
  });

  await check("a flood, broken frames and half requests harm nobody", async () => {
    await page.evaluate(
      () =>
        new Promise((done) => {
          const socket = new WebSocket(`ws://${location.host}/live`);
          socket.onclose = done;
          socket.onopen = () => {
            for (let i = 0; i < 2000; ++i) socket.send('{"do":"fly"}');
          };
        }),
    );
    await page.evaluate(
      () =>
        new Promise((done) => {
          const socket = new WebSocket(`ws://${location.host}/live`);
          socket.onclose = done;
          socket.onopen = () => socket.send("x".repeat(1 << 20));
        }),
    );
    const halves = Array.from({ length: 60 }, (_, i) => {
      const socket = connect(Number(port), hostname);
      socket.on("error", () => {});
      socket.write(i % 2 ? "GET / HTT" : Buffer.from([0x81, 0xff, 0, 255, 7, 7, 7, 7, 13, 10, 13, 10]));
      return socket;
    });
    await new Promise((done) => setTimeout(done, 300));
    for (const socket of halves) socket.destroy();
    await start(page, "circle", "0");
    await over(page);
    assert.match(await page.textContent("#result"), /^circle: PASS/);
  });

  await check("nothing was said on the browser's console", () => assert.deepEqual(noise, []));
});

panel.child.kill("SIGINT");
const code = await new Promise((done) => panel.child.on("exit", done));
await check("Ctrl-C ends the panel orderly", () => assert.equal(code, 0));
console.log(`${passed} passed, ${failures} failed; pictures in ${shots}`);
process.exit(failures === 0 ? 0 : 1);
