// Chromium for the checks of pages: opens a page of the folder PAGES, counts checks, asks axe-core.
import { createRequire } from "node:module";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { join } from "node:path";
import { tmpdir } from "node:os";

const { CHROMIUM, WEB, PAGES } = process.env;
const require = createRequire(join(WEB, "x.js"));
const { chromium } = require("playwright-core");
const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");

let passed = 0, failed = 0;
export function check(what, fine, more = "") {
  if (fine) passed++; else failed++;
  console.log(`${fine ? "ok" : "not ok"} - ${what}${fine ? "" : ` (${more})`}`);
}

const profile = mkdtempSync(join(tmpdir(), "rotdyn-chromium-"));
const context = await chromium.launchPersistentContext(profile, {
  executablePath: CHROMIUM, headless: true, viewport: { width: 760, height: 900 },
  args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync"]
});

// A page that keeps what it said and whom it asked.
export async function open(name) {
  const page = await context.newPage();
  page.heard = [];
  page.asked = [];
  page.on("console", (message) => page.heard.push(message.text()));
  page.on("pageerror", (error) => page.heard.push(error.message));
  page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) page.asked.push(request.url());
  });
  await page.goto("file://" + join(PAGES, name + ".html"));
  return page;
}

export async function violations(page) {
  if (!(await page.evaluate(() => "axe" in window))) await page.evaluate(axe);
  const found = await page.evaluate(() => window.axe.run(document));
  return found.violations.map((one) =>
    `${one.id}, ${one.nodes.length} times: ${one.nodes[0].html.slice(0, 100)}`);
}

export async function close() {
  await context.close();
  rmSync(profile, { recursive: true, force: true });
}

// The closing line; ends the process.
export function report(title) {
  console.log(`${title}: ${passed} passed, ${failed} failed`);
  process.exit(failed ? 1 : 0);
}
