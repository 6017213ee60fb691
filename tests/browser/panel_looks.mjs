// For every eye and every hand: dark and light, small and touched, without colours, without a mouse.
import assert from "node:assert/strict";
import { join } from "node:path";

// Of two colours as the style sheet has them (WCAG 2.1): 1 to 21.
function contrast(a, b) {
  const luminance = (hex) => {
    const channel = (at) => {
      const v = Number.parseInt(hex.slice(at, at + 2), 16) / 255;
      return v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
    };
    return 0.2126 * channel(1) + 0.7152 * channel(3) + 0.0722 * channel(5);
  };
  const [dark, light] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (light + 0.05) / (dark + 0.05);
}

const tooWide = (page) => page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);

export async function lookAtIt({ checks, person, page, context, shots }) {
  const devtools = await context.newCDPSession(page);
  await page.click('nav a[href="#run"]');

  await checks.run("text and lines stand out from the page, light and dark", async () => {
    for (const colorScheme of ["light", "dark"]) {
      await page.emulateMedia({ colorScheme });
      const colours = await page.evaluate(() => {
        const style = getComputedStyle(document.documentElement);
        return Object.fromEntries(
          ["page", "raised", "text", "muted", "accent", "fail", "pass", "line-reference", "line-measured", "line-truth", "line-second", "line-third"].map((name) => [name, style.getPropertyValue(`--${name}`).trim()]),
        );
      });
      for (const [name, colour] of Object.entries(colours)) {
        if (["page", "raised"].includes(name)) continue;
        const least = name.startsWith("line-") ? 3 : 4.5;
        for (const ground of ["page", "raised"]) {
          const ratio = contrast(colour, colours[ground]);
          assert.ok(ratio >= least, `${colorScheme}: ${name} on ${ground}: ${ratio.toFixed(2)}`);
        }
      }
    }
    await page.emulateMedia({ colorScheme: "light" });
  });

  await checks.run("no two lines of a plot differ by colour alone", async () => {
    const alike = await page.$$eval(".scope", (scopes) =>
      scopes.flatMap((scope) => {
        const looks = [...scope.querySelectorAll(".sample line")].map((line) => line.getAttribute("stroke-dasharray"));
        return new Set(looks).size === looks.length ? [] : [scope.querySelector("strong").textContent];
      }),
    );
    assert.deepEqual(alike, []);
    await devtools.send("Emulation.setEmulatedVisionDeficiency", { type: "achromatopsia" });
    await page.screenshot({ path: join(shots, "panel-without-colours.png") });
    await devtools.send("Emulation.setEmulatedVisionDeficiency", { type: "none" });
  });

  await checks.run("on a tablet nothing is too wide or too small for a finger", async () => {
    await devtools.send("Emulation.setTouchEmulationEnabled", { enabled: true });
    for (const [width, height] of [[820, 1180], [1180, 820], [600, 960]]) {
      await page.setViewportSize({ width, height });
      await page.emulateMedia({ colorScheme: "dark" });
      for (const view of ["run", "folders", "folders/campaign", "folders/diagnosis"]) {
        await page.evaluate((hash) => { location.hash = hash; }, view);
        if (view.includes("/")) await page.waitForSelector("#view-folders article table");
        assert.ok((await tooWide(page)) <= 0, `${view} at ${width}: ${await tooWide(page)} pixels too wide`);
      }
      await page.click('nav a[href="#run"]');
      const small = await page.$$eval("#view-run button, #view-run select, nav a", (all) =>
        all.filter((one) => one.getBoundingClientRect().height < 40 && one.offsetParent !== null).map((one) => `${one.textContent} ${one.getBoundingClientRect().height}`),
      );
      assert.deepEqual(small, [], `at ${width}`);
      await page.screenshot({ path: join(shots, `panel-tablet-${width}.png`) });
    }
    await devtools.send("Emulation.setTouchEmulationEnabled", { enabled: false });
    await page.setViewportSize({ width: 1440, height: 1100 });
    await page.emulateMedia({ colorScheme: "light" });
  });

  await checks.run("every control has a name", async () => {
    const nameless = await page.$$eval("button, select, input, a", (all) =>
      all.filter((one) => !(one.textContent.trim() || one.getAttribute("aria-label") || one.labels?.[0]?.textContent.trim())).map((one) => one.outerHTML),
    );
    assert.deepEqual(nameless, []);
  });

  await checks.run("a run is driven by the keyboard alone", async () => {
    await person.choose("circle", "1", { hold: true });
    await page.focus("#experiment");
    let steps = 0;
    while ((await page.evaluate(() => document.activeElement.id)) !== "start") {
      await page.keyboard.press("Tab");
      assert.ok(++steps < 12, "Start is not reached by Tab");
    }
    const outline = await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle);
    assert.notEqual(outline, "none", "where the keys go is not shown");
    await page.keyboard.press("Enter");
    await person.begun();
    await person.untilTime(1.5);
    await page.keyboard.press("Space");
    await person.until("Run", /paused/);
    const before = await person.time();
    await page.selectOption("#step-length", "10");
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press("s");
    await person.untilTime(before + 0.0099);
    await page.keyboard.press("Space");
    await person.until("Run", /^running$/);
    await page.focus("#kill");
    await page.keyboard.press("Space"); // of the button that has the focus, not of the pause
    await person.until("Kill switch", /^pressed$/);
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press("k");
    await person.until("Kill switch", /^released$/);
    await page.focus("#finish");
    await page.keyboard.press("Enter");
    assert.match(await person.over(), /^PASScircle/);
  });
}
