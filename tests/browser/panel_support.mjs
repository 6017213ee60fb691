// What the panel's checks share: the panel's process, counting checks, and a person's hands.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { createHash } from "node:crypto";
import { request } from "node:http";
import { connect } from "node:net";

// How waiting for a page asks: with each picture it would keep the page drawing.
const seldom = { polling: 100 };

export class Checks {
  failures = 0;
  passed = 0;
  look = async () => ""; // what there is to see where a check fails
  recover = async () => {}; // so that the next check finds an idle panel

  async run(name, body) {
    const began = Date.now();
    try {
      await body();
      ++this.passed;
      console.log(`ok   ${name} (${((Date.now() - began) / 1000).toFixed(1)} s)`);
    } catch (error) {
      ++this.failures;
      const where = (error.stack ?? "").match(/panel_\w+\.mjs:\d+/g)?.join(" < ") ?? "";
      console.log(`FAIL ${name}\n     ${where} ${String(error.message ?? error).replace(/\n/g, "\n     ")}`);
      console.log(`     ${await this.look().catch(String)}`);
      await this.recover().catch(() => {});
    }
  }
}

// The panel's process; `address` resolves with each address that it prints.
export function startPanel(bench, root, runs, options = []) {
  const child = spawn(bench, ["panel", "--out", runs, ...options], { cwd: root, stdio: ["ignore", "pipe", "inherit"] });
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

// The last commands that the page has sent, and what was clicked last: listened to from before the page opens.
export async function overhear(page) {
  const sent = [];
  page.on("websocket", (socket) =>
    socket.on("framesent", ({ payload }) => {
      sent.push(String(payload));
      sent.splice(0, sent.length - 3);
    }),
  );
  await page.addInitScript(() => {
    window.clicked = [];
    addEventListener("click", ({ target }) => window.clicked.push(target.id || target.textContent), true);
  });
  return sent;
}

// How things stand with the page, in a line.
export const standing = async (page, sent) =>
  `${await stands(page)}; sent: ${sent.join(" ")}; clicked: ${await page.evaluate(() => window.clicked.slice(-3).join(", "))}`;

const stands = (page) =>
  page.evaluate(async () => {
    const drawn = await new Promise((done) => {
      requestAnimationFrame(() => done("it draws"));
      setTimeout(() => done("it does not draw"), 2000);
    });
    const { run, of } = document.getElementById("result").dataset;
    const said = [...document.querySelectorAll("#connection, .trouble")].map((one) => one.textContent);
    return `${drawn}; ${document.visibilityState}; run ${run}, verdict of ${of}; ${said.join("; ")}`;
  });

// Ends the run under way, if there is one.
export async function endRun(page) {
  await page.evaluate(() => document.getElementById("finish").click());
  await page.waitForFunction(() => /PASS|FAIL|INVALID|no verdict/.test(document.getElementById("result").textContent), null, { ...seldom, timeout: 60_000 });
}

// A page and what a person does with it.
export class Person {
  runsSeen = ""; // number of the run whose result the page shows
  runBefore = ""; // number of the run that the page shows

  constructor(page) {
    this.page = page;
  }
  lamp(name) {
    return this.page.locator(`[data-lamp="${name}"]`).textContent();
  }
  async time() {
    return Number.parseFloat(await this.lamp("Virtual time"));
  }
  async until(name, pattern) {
    await this.page.waitForFunction(
      ([lampName, source]) => new RegExp(source).test(document.querySelector(`[data-lamp="${lampName}"]`)?.textContent ?? ""),
      [name, pattern.source],
      seldom,
    );
  }
  async untilTime(t) {
    await this.page.waitForFunction((s) => Number.parseFloat(document.querySelector('[data-lamp="Virtual time"]').textContent) > s, t, seldom);
  }
  async type(line) {
    await this.page.fill("#console-line", line);
    await this.page.press("#console-line", "Enter");
  }
  async printed(words) {
    await this.page.waitForFunction((text) => document.querySelector(".terminal").textContent.includes(text), words, seldom);
  }
  // speed: as the page's choices have it; options: hold, clock, limit_s, faults.
  async start(experiment, speed, options = {}) {
    await this.choose(experiment, speed, options);
    // By the keyboard: where the page moves between a press of the mouse and its release, nothing is clicked.
    await this.page.waitForFunction(() => !document.getElementById("start").disabled, null, seldom);
    await this.page.press("#start", "Enter");
    await this.begun();
  }
  // What is shown is the run's that was started last, no longer the one's before.
  async begun() {
    await this.page.waitForFunction((before) => (document.getElementById("result").dataset.run ?? "") !== before, this.runBefore, seldom);
  }
  async choose(experiment, speed, options = {}) {
    await this.page.click('nav a[href="#run"]');
    this.runsSeen = (await this.page.getAttribute("#result", "data-of")) ?? "";
    this.runBefore = (await this.page.getAttribute("#result", "data-run")) ?? "";
    await this.page.selectOption("#experiment", experiment);
    await this.page.selectOption("#start-clock", options.clock ?? "lockstep");
    if (options.clock !== "real") await this.page.selectOption("#start-speed", speed);
    await this.tick("go on after the script", options.hold ?? false);
    const set = (label, value) => this.page.getByLabel(label).evaluate((field, words) => (field.value = words), String(value));
    await set("Faults, separated", options.faults ?? "");
    if (options.limit_s) await set("Time limit", options.limit_s);
  }
  // By the keyboard, as a start.
  async tick(label, wanted) {
    const box = this.page.getByLabel(label);
    if ((await box.isChecked()) !== wanted) await box.press("Space");
    assert.equal(await box.isChecked(), wanted, label);
  }
  async over() {
    await this.page.waitForFunction((before) => {
      const result = document.getElementById("result");
      return (result.dataset.of ?? "") !== before && /PASS|FAIL|INVALID|no verdict/.test(result.textContent);
    }, this.runsSeen, seldom);
    return this.page.textContent("#result");
  }
  async folder() {
    return (await this.page.getAttribute("#result a", "href")).split("/")[1];
  }
  // Pixels drawn on each plot.
  ink(selector) {
    return this.page.$$eval(selector, (canvases) =>
      canvases.map((canvas) => {
        const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true });
        copy.drawImage(canvas, 0, 0);
        const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
        let count = 0;
        for (let i = 3; i < data.length; i += 4) if (data[i] > 0) ++count;
        return count;
      }),
    );
  }
}

// Whatever the page must not do is collected in the list returned.
export function listen(page, origin) {
  const noise = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) noise.push(`console: ${message.text()} ${message.location().url}`);
  });
  page.on("pageerror", (error) => noise.push(`exception: ${error.message}`));
  page.on("request", (asked) => {
    if (!asked.url().startsWith(origin) && !asked.url().startsWith("data:")) noise.push(`request: ${asked.url()}`);
  });
  return noise;
}

export const statusOf = (options, socketHeaders = false) =>
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

// A client that was let in and then reads nothing until wake() is called: a closed laptop, or a slow
// one. wake() resolves with all that had come when the bench let it go.
export function sleepingClient({ hostname, port, origin, cookie }) {
  const key = createHash("md5").update("sleeper").digest("base64");
  const socket = connect(Number(port), hostname);
  let text = "";
  const ended = new Promise((done) => socket.on("close", () => done(text)));
  socket.on("error", () => {});
  socket.on("data", (bytes) => {
    text += bytes.toString("latin1");
    if (!text.includes("\r\n\r\n") || socket.fellAsleep) return;
    socket.fellAsleep = true;
    socket.pause();
  });
  socket.write(
    `GET /live HTTP/1.1\r\nHost: ${hostname}:${port}\r\nOrigin: ${origin}\r\nCookie: ${cookie}\r\n` +
      `Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: ${key}\r\n\r\n`,
  );
  return {
    since: Date.now(),
    // Reads on; resolves with what it heard once that matches.
    hear(pattern) {
      socket.resume();
      return new Promise((done) => {
        const look = () => {
          if (!pattern.test(text)) return;
          socket.off("data", look);
          socket.destroy();
          done(text);
        };
        socket.on("data", look);
      });
    },
    wake() {
      socket.resume();
      return ended;
    },
  };
}
