// A run driven by hand: started, looked at, paused, stepped, killed, reset, finished, replayed.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";

export async function driveRuns({ checks, person, page, bench, root, runs, shots }) {
  let driven = "";
  const replay = (folder) => execFileSync(bench, ["replay", join(runs, folder)], { cwd: root, encoding: "utf8" });

  await checks.run("the circle starts, the plots move", async () => {
    await person.start("circle", "1", { hold: true, limit_s: 3000 });
    await person.until("Run", /^running/);
    await person.untilTime(4);
    const marks = await person.ink(".scope canvas");
    assert.ok(marks.length >= 7 && marks.every((count) => count > 300), `ink: ${marks}`);
    await person.untilTime((await person.time()) + 1);
    await page.screenshot({ path: join(shots, "panel-circle.png") });
  });

  await checks.run("the speed is shown by each estimator, and a force as an arrow with its size", async () => {
    const legend = await page.locator(".scope", { hasText: "Velocity, by each estimator" }).locator(".entry").allTextContents();
    for (const name of ["reference", "frequency", "period", "hybrid (followed)"]) {
      const entry = legend.find((text) => text.startsWith(name));
      assert.match(entry ?? "", /\d/, `${name} in ${legend}`);
    }
    await page.waitForFunction(() => /[\d.]+ N/.test(document.querySelector(".plan .force text")?.textContent ?? ""));
  });

  await checks.run("paused it stands, a step of 100 ms is a step of 100 ms, and it goes on", async () => {
    await page.locator("body").press(" ");
    await person.until("Run", /paused/);
    await page.waitForTimeout(200);
    const before = await person.time();
    await page.waitForTimeout(300);
    assert.equal(await person.time(), before);
    await page.selectOption("#step-length", "100");
    await page.getByRole("button", { name: /^Step/ }).click();
    await person.untilTime(before + 0.1 - 1e-9);
    await page.waitForTimeout(200);
    const after = await person.time();
    assert.ok(Math.abs(after - before - 0.1) < 2e-3, `${before} to ${after}`);
    await page.getByRole("button", { name: /^Go on/ }).click();
    await person.until("Run", /^running$/);
  });

  await checks.run("in slow motion a second lasts a hundred", async () => {
    const speed = page.locator("#speed");
    await speed.selectOption("0.01");
    // The page may come late to its last frame at full speed.
    const rate = async () => {
      const [before, began] = [await person.time(), Date.now()];
      await page.waitForTimeout(1000);
      return ((await person.time()) - before) / ((Date.now() - began) / 1000);
    };
    let seen = await rate();
    for (let again = 0; again < 10 && seen >= 0.05; ++again) seen = await rate();
    assert.ok(seen > 0 && seen < 0.05, `${seen} s a second`);
    await speed.selectOption("1");
  });

  await checks.run("the kill switch takes the drive and latches; cleared and reset it is free", async () => {
    await page.click("#kill");
    await person.until("Kill switch", /^pressed$/);
    await person.until("Fault", /latched/);
    await person.until("Duty", /^0 \/ 0 %$/);
    await page.screenshot({ path: join(shots, "panel-killed.png") });
    await person.type("reset systate");
    await person.printed("error");
    await page.click("#kill");
    await person.until("Kill switch", /^released$/);
    await person.type("reset systate");
    await person.until("Fault", /^none$/);
    await person.type("status");
    await person.printed("amplifier");
    await page.click("#finish");
    const words = await person.over();
    assert.match(words, /^PASScircle/, words);
    driven = await person.folder();
  });

  await checks.run("the verdict is the largest text, and the working folder's own files are offered", async () => {
    const [word, largest] = await page.evaluate(() => {
      const size = (one) => Number.parseFloat(getComputedStyle(one).fontSize);
      const verdict = document.querySelector("#result .word");
      const others = [...document.querySelectorAll("#view-run *")].filter((one) => one !== verdict && one.textContent.trim() !== "");
      return [size(verdict), Math.max(...others.map(size))];
    });
    assert.ok(word > largest, `${word} px, others up to ${largest} px`);
    const names = await page.$$eval("#experiment option", (all) => all.map((one) => one.textContent));
    assert.ok(names.includes("circle"));
  });

  await checks.run("what was done by hand is in events.jsonl and replays bit for bit", async () => {
    const events = readFileSync(join(runs, driven, "events.jsonl"), "utf8");
    for (const kind of ["fault", "cleared", "typed", "clock", "holds", "finished"]) {
      assert.ok(events.includes(`"side":"operator","kind":"${kind}"`), `no ${kind} in events.jsonl`);
    }
    const said = replay(driven);
    assert.equal(said.match(/identical/g)?.length, 4, said);
  });

  await checks.run("an end-stop that is tripped by hand stops the axis", async () => {
    // Slowly: on a busy host the page comes late, and the motion of six seconds must not be over by then.
    await person.start("trapezoid-400", "0.1", { hold: true, limit_s: 600 });
    await person.until("y", /^position$/);
    await person.untilTime(0.8); // it moves from 0.5 s on
    await page.getByRole("button", { name: "Trip y max" }).click();
    await person.until("Fault", /latched/);
    await page.click("#finish");
    assert.match(await person.over(), /PASS/);
  });

  await checks.run("any fault with its parameters is injected, and one that is built in before the start", async () => {
    const faults = { hold: true, limit_s: 600, faults: "encoder.x phase" };
    await person.start("trapezoid-400", "0.1", faults);
    if (/allowed/.test((await page.textContent(".trouble")) ?? "")) assert.fail(await page.textContent(".trouble"));
    await person.until("y", /^position$/);
    await person.untilTime(0.8); // it moves from 0.5 s on
    await page.selectOption("#fault-part", "encoder.y");
    await page.selectOption("#fault-kind", "frozen");
    await page.getByRole("button", { name: "Inject", exact: true }).click();
    await person.until("Fault", /latched/);
    await page.click("#finish");
    await person.over();
    const events = readFileSync(join(runs, await person.folder(), "events.jsonl"), "utf8");
    assert.match(events, /"side":"operator","kind":"fault"[^\n]*encoder\.y frozen/);
    assert.equal(replay(await person.folder()).match(/identical/g)?.length, 4);
  });

  await checks.run("a run by the wall clock is watched, typed into and finished", async () => {
    await person.start("wall-clock-window", "1", { clock: "real", hold: true, limit_s: 60 });
    await person.until("Carrier", /wall clock/);
    await person.untilTime(1);
    assert.ok(await page.locator("#kill").isDisabled(), "a clock that does not wait cannot be disturbed");
    const marks = await person.ink(".scope canvas");
    assert.ok(marks.every((count) => count > 300), `ink: ${marks}`);
    await person.type("status");
    await person.printed("amplifier");
    await page.click("#finish");
    const words = await person.over();
    assert.match(words, /controller.*lateness/s, words);
    await page.screenshot({ path: join(shots, "panel-wall-clock.png") });
    const said = replay(await person.folder());
    assert.ok(!/differ/.test(said) && said.includes("identical"), said);
  });

  await checks.run("an undisturbed run from the panel is judged like any other", async () => {
    await person.start("circle", "0");
    assert.match(await person.over(), /^PASScircle/);
    execFileSync(bench, ["run", "circle", "--out", runs, "--quiet"], { cwd: root });
  });

  await checks.run("a page that the browser does not draw says how the run ended", async () => {
    await page.evaluate(() => {
      window.drawing = window.requestAnimationFrame;
      window.requestAnimationFrame = () => 0;
    });
    await person.start("endstop-y-max", "0");
    assert.match(await person.over(), /^PASSendstop-y-max/);
    await page.evaluate(() => (window.requestAnimationFrame = window.drawing));
  });

  await checks.run("a run at full speed is drawn once a second at most, and at once when it is over", async () => {
    await page.evaluate(() => {
      window.drawn = [];
      const lamps = document.querySelector(".lamps");
      window.drawings = new MutationObserver(() => window.drawn.push([performance.now(), lamps.textContent]));
      window.drawings.observe(lamps, { childList: true, characterData: true, subtree: true });
    });
    const began = await page.evaluate(() => performance.now());
    // Judging takes as long as the record, so the run must end soon on a host where the page comes late.
    await person.start("circles-20min", "0", { hold: true, limit_s: 600 });
    await person.untilTime(200);
    await page.waitForFunction((since) => performance.now() > since + 3000, began);
    await page.evaluate(() => document.getElementById("finish").click());
    await person.over();
    const running = await page.evaluate(() => {
      window.drawings.disconnect();
      return window.drawn.filter(([, words]) => /^Runrunning/.test(words)).map(([at]) => at);
    });
    // Single frames may come late, and two of them close together.
    const passed_s = (running.at(-1) - began) / 1000;
    assert.ok(running.length > 1 && running.length <= passed_s + 2, `drawn ${running.length} times in ${passed_s} s`);
    assert.ok((await person.time()) > 200, "the end is shown");
  });
}
