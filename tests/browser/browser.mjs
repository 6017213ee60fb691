// Starts headless Chromium and opens a file:// page in it, watching for whatever a report must not do.
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const candidates = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser"];

// Null when there is none.
export function findBrowser() {
  return candidates.find((path) => path && existsSync(path)) ?? null;
}

export async function withBrowser(use) {
  const profile = mkdtempSync(join(tmpdir(), "towbench-browser-"));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: findBrowser(),
    headless: true,
    viewport: { width: 1280, height: 900 },
    args: [
      "--no-sandbox",
      "--disable-gpu",
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
    ],
  });
  try {
    return await use(context);
  } finally {
    await context.close();
    rmSync(profile, { recursive: true, force: true });
  }
}

// `noise` collects console errors, exceptions and every request other than for the file itself.
export async function openPage(context, file, options = {}) {
  const page = await context.newPage();
  // Generous: a test that only fails on a busy machine says nothing about the page.
  page.setDefaultTimeout(150_000);
  const noise = [];
  const url = pathToFileURL(file).href;
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) noise.push(`console: ${message.text()}`);
  });
  page.on("pageerror", (error) => noise.push(`exception: ${error.message}`));
  page.on("request", (request) => {
    if (request.url() !== url) noise.push(`request: ${request.url()}`);
  });
  await page.setViewportSize(options.viewport ?? { width: 1280, height: 900 });
  await page.emulateMedia({ colorScheme: options.colorScheme ?? "light", media: "screen" });
  await page.goto(url);
  await page.waitForFunction(() => document.documentElement.dataset.plots === "ready");
  // Two frames: uPlot draws in a microtask, observers of sizes after layout.
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  return { page, noise };
}
