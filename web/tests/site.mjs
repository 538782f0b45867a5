// The site that `make site` built, in Chromium: axe-core on its four kinds of page, no request to
// elsewhere, search, pictures that are not black. SITE: its folder; CHROMIUM, WEB: as tools/web.sh
// finds them. Closes with `site: N passed, N failed`.
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { existsSync, readdirSync, readFileSync, statSync } from "node:fs";
import { extname, join } from "node:path";

const { SITE, CHROMIUM, WEB } = process.env;
const require = createRequire(join(WEB, "x.js"));
const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");
const types = { ".html": "text/html", ".css": "text/css", ".js": "text/javascript",
  ".json": "application/json", ".svg": "image/svg+xml", ".png": "image/png" };

let passed = 0, failed = 0;
const check = (what, fine, more = "") => {
  if (fine) passed++; else failed++;
  console.log(`${fine ? "ok" : "not ok"} - ${what}${fine ? "" : ` (${more})`}`);
};

// Search reads a file, which a browser does from a server alone.
const server = createServer((request, answer) => {
  const path = join(SITE, decodeURIComponent(new URL(request.url, "http://x").pathname));
  const file = existsSync(path) && statSync(path).isDirectory() ? join(path, "index.html") : path;
  if (!existsSync(file)) { answer.writeHead(404); answer.end(); return; }
  answer.writeHead(200, { "Content-Type": types[extname(file)] ?? "application/octet-stream" });
  answer.end(readFileSync(file));
}).listen(0, "127.0.0.1");
await new Promise((done) => server.once("listening", done));
const here = `http://127.0.0.1:${server.address().port}`;

const browser = await require("playwright-core").chromium.launch({ executablePath: CHROMIUM,
  args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--disable-background-networking"] });
const page = await browser.newPage({ viewport: { width: 1280, height: 900 } });
const asked = [], heard = [], lost = [];
page.on("request", (request) => {
  const url = request.url();
  if (!url.startsWith(here) && !/^(data|blob):/.test(url)) asked.push(url);
});
page.on("response", (response) => { if (response.status() >= 400) lost.push(response.url()); });
page.on("pageerror", (error) => heard.push(error.message));

for (const [kind, path] of [["home", "index.html"], ["reference", "reference/trajectory.html"],
  ["index", "reference/index.html"], ["article", "articles/gyroscope.html"],
  ["lab", "lab/lab.html"]]) {
  await page.goto(`${here}/${path}`);
  await page.waitForTimeout(500);
  await page.evaluate(axe);
  const found = (await page.evaluate(() => window.axe.run(document))).violations;
  check(`${kind}: no violation of axe-core's rules`, found.length === 0, found.map((one) =>
    `${one.id}: ${one.nodes[0].html.slice(0, 120)}`).join("; "));
}

await page.goto(`${here}/index.html`);
await page.locator("#search-input").click();
await page.keyboard.type("trajectory", { delay: 40 });
await page.waitForTimeout(1500);
const hits = await page.locator(".aa-suggestion, [role=option]").allTextContents();
check("search finds trajectory", hits.some((one) => /trajectory/i.test(one)), hits.join("; "));

// Each lesson that tools/site/labs.csv lists has its lab, which has run.
const labs = readFileSync(new URL("../../tools/site/labs.csv", import.meta.url), "utf8").trim()
  .split("\n").slice(1).map((line) => line.split(","));
const without = [];
for (const [article, scene] of labs) {
  if (!existsSync(join(SITE, "articles", `${article}.html`))) continue;
  await page.goto(`${here}/articles/${article}.html`);
  const lab = page.locator("rotdyn-lab");
  const title = JSON.parse(readFileSync(
    new URL(`../scenes/${scene}.json`, import.meta.url), "utf8")).title.en;
  const model = await lab.locator(".model").textContent({ timeout: 5000 }).catch(() => "");
  const shown = (await lab.getAttribute("settings")).includes(JSON.stringify(title));
  if (!/^Model \w+_\w+: \w/.test(model) || !shown) without.push(`${article}: ${model}`);
}
check(`a lab in each of ${labs.length} lessons`, without.length === 0, without.join("; "));

// A picture without its alpha channel has a black ground.
const black = [];
let pictures = 0;
for (const name of readdirSync(join(SITE, "articles"))) {
  if (!name.endsWith(".html") || name === "index.html") continue;
  await page.goto(`${here}/articles/${name}`);
  const shares = await page.evaluate(async () => {
    const all = [...document.querySelectorAll("main img")].filter((one) => one.naturalWidth > 100);
    return all.map((one) => {
      const canvas = document.createElement("canvas"), size = 64;
      canvas.width = canvas.height = size;
      const pen = canvas.getContext("2d");
      pen.drawImage(one, 0, 0, size, size);
      const { data } = pen.getImageData(0, 0, size, size);
      let dark = 0;
      for (let i = 0; i < data.length; i += 4) {
        dark += data[i + 3] > 200 && data[i] + data[i + 1] + data[i + 2] < 60;
      }
      return dark / (size * size);
    });
  });
  pictures += shares.length;
  if (shares.some((share) => share > 0.5)) black.push(name);
}
check(`none of ${pictures} pictures is black`, pictures > 50 && black.length === 0, black.join());
check("no page asks elsewhere", asked.length === 0, [...new Set(asked)].join("; "));
check("nothing is missing", lost.length === 0, [...new Set(lost)].slice(0, 5).join("; "));
check("no script fails", heard.length === 0, [...new Set(heard)].join("; "));
await browser.close();
server.close();
console.log(`site: ${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
