// node picture.mjs REPORT_HTML PNG [HEIGHT]: the top of a report, as the README shows it.
import { openPage, withBrowser } from "./browser.mjs";

const [report, picture, height = "1240"] = process.argv.slice(2);
if (!report || !picture) {
  console.error("usage: node picture.mjs REPORT_HTML PNG [HEIGHT]");
  process.exit(2);
}
await withBrowser(async (context) => {
  const { page } = await openPage(context, report, { viewport: { width: 1120, height: Number(height) } });
  await page.screenshot({ path: picture });
});
