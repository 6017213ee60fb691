// Those who must not get in, and those who are in and behave badly.
import assert from "node:assert/strict";
import { connect } from "node:net";

import { Person, sleepingClient, statusOf } from "./panel_support.mjs";

export async function lockOut({ checks, context, hostname, port, origin }) {
  await checks.run("strangers, other names, other origins and paths upwards get nothing", async () => {
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
}

export async function sleepAtIt({ context, hostname, port, origin }) {
  const cookie = (await context.cookies(origin)).map((one) => `${one.name}=${one.value}`).join("; ");
  return sleepingClient({ hostname, port, origin, cookie });
}

export async function behaveBadly({ checks, person, page, context, origin, hostname, port, sleeper }) {
  await checks.run("a second page sees the same run, steers it too, and goes without a trace", async () => {
    await person.start("circle", "1", { hold: true });
    await person.untilTime(0.5);
    const other = await context.newPage();
    await other.goto(origin);
    await other.waitForFunction(() => document.documentElement.dataset.panel === "ready");
    const second = new Person(other);
    await second.until("Run", /^running$/);
    await other.getByRole("button", { name: /^Pause/ }).click();
    await person.until("Run", /paused/);
    await other.close();
    await page.getByRole("button", { name: /^Go on/ }).click();
    await person.untilTime((await person.time()) + 0.5);
    await page.click("#finish");
    assert.match(await person.over(), /circle/);
  });

  await checks.run("nonsense is refused in words, and a command to a run that is not there", async () => {
    await page.evaluate(() => {
      window.answers = [];
      const socket = new WebSocket(`ws://${location.host}/live`);
      socket.onmessage = (event) => window.answers.push(event.data);
      socket.onopen = () => {
        const deep = "[".repeat(30_000);
        for (const text of ["{", "[]", deep, '{"do":"fly"}', '{"do":"step","ms":-1}', '{"do":"inject","fault":"moon full"}', '{"do":"pause"}', '{"do":"start","experiment":"circle","speed":1,"clock":"sun"}']) socket.send(text);
        socket.send(new Uint8Array([0, 255, 254, 7]));
      };
    });
    await page.waitForFunction(() => window.answers.filter((text) => text.includes("refused")).length === 9);
  });

  await checks.run("a command that is carried out is answered, and one that no answer came to is told", async () => {
    await person.start("circle", "0.1", { hold: true, limit_s: 600 });
    await page.evaluate(() => {
      window.answers = [];
      const socket = new WebSocket(`ws://${location.host}/live`);
      socket.onmessage = (event) => window.answers.push(event.data);
      socket.onopen = () => socket.send('{"do":"pause"}');
    });
    await page.waitForFunction(() => window.answers.includes('{"kind":"heard"}'));
    await page.click("#finish");
    await person.over();
    const other = await context.newPage();
    await other.routeWebSocket(/live/, (socket) => {
      const bench = socket.connectToServer();
      socket.onMessage(() => socket.close()); // and the bench never hears it
      bench.onMessage((text) => socket.send(text));
    });
    await other.goto(origin);
    await other.waitForFunction(() => document.documentElement.dataset.panel === "ready" && document.getElementById("connection").textContent === "connected");
    await other.click("#start");
    await other.waitForFunction(() => /may not have heard: start/.test(document.querySelector(".trouble[role=alert]").textContent));
    await other.close();
  });

  await checks.run("one that reads nothing, a closed laptop, is let go; the others see on", async () => {
    // Longer than the laptop stays closed, at ten times the wall clock's speed.
    await person.start("circle", "10", { hold: true, limit_s: 3000 });
    await person.untilTime(20);
    const left = 31_000 - (Date.now() - sleeper.since);
    if (left > 0) await page.waitForTimeout(left);
    const text = await sleeper.wake();
    assert.ok(text.startsWith("HTTP/1.1 101"), text.slice(0, 80));
    await person.untilTime((await person.time()) + 1);
    await page.click("#finish");
    await person.over();
    assert.equal(await page.textContent("#connection"), "connected");
  });

  await checks.run("one that could not keep up is told how many frames it missed, and how things stand", async () => {
    const slow = await sleepAtIt({ context, hostname, port, origin });
    await person.start("wall-clock-60s", "10");
    await person.over();
    const impatience = new Promise((_, fail) => setTimeout(() => fail(new Error("it was not told")), 20_000));
    await Promise.race([slow.hear(/"kind":"missed".*"phase":"over"/s), impatience]);
  });

  await checks.run("a flood, broken frames and half requests harm nobody", async () => {
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
    await person.start("circle", "0");
    assert.match(await person.over(), /^PASScircle/);
  });
}
