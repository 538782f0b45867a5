// The page in Firefox and WebKit beside Chromium: every scene, a control by the keyboard, a narrow
// page, large text, reduced motion, no WebGL. The numbers are those of Chromium, to the last digit.
// CHROMIUM, FIREFOX, WEBKIT (the driver), MINIBROWSER, WEB: as tools/check-browsers.sh finds them;
// SHOTS: a folder for pictures. Closes with `browsers: N passed, N failed, N skipped`.
import { spawn } from "node:child_process";
import { createRequire } from "node:module";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { setTimeout as wait } from "node:timers/promises";
import { fileURLToPath } from "node:url";

const { CHROMIUM, FIREFOX, WEBKIT, MINIBROWSER, WEB, SHOTS } = process.env;
const file = fileURLToPath(new URL("../../inst/lab/lab.html", import.meta.url));
const scenes = JSON.parse(readFileSync(new URL("../scenes/list.json", import.meta.url), "utf8"));
const puppeteer = createRequire(join(WEB, "x.js"))("puppeteer-core");

let passed = 0, failed = 0, skipped = 0;
function check(what, fine, more = "") {
  if (fine) passed++; else failed++;
  console.log(`${fine ? "ok" : "not ok"} - ${what}${fine ? "" : ` (${more})`}`);
}

// ---- a page of a browser: open, ask (a function body), press, size, shot, heard, close -----------

const flags = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--disable-background-networking"];

async function byPuppeteer(options) {
  const browser = await puppeteer.launch({ headless: true, ...options });
  const page = await browser.newPage();
  const heard = [];
  page.on("console", (message) => heard.push(message.text()));
  page.on("pageerror", (error) => heard.push(error.message));
  return {
    version: await browser.version(), heard,
    open: async (url) => { await page.goto("about:blank"); await page.goto(url); },
    ask: (body) => page.evaluate(`(() => { ${body} })()`),
    press: (key) => page.keyboard.press(key),
    size: (width, height) => page.setViewport({ width, height }),
    shot: (path) => page.screenshot({ path }),
    close: () => browser.close()
  };
}

// WebKit by W3C WebDriver, on a display of its own.
async function byWebKit(port = 4477) {
  const driver = spawn("xvfb-run", ["-a", "-s", "-screen 0 1400x1000x24", WEBKIT,
    `--port=${port}`], {
    stdio: "ignore", detached: true,
    env: { ...process.env, WEBKIT_DISABLE_COMPOSITING_MODE: "1", LIBGL_ALWAYS_SOFTWARE: "1" }
  });
  const call = async (method, path, body) => {
    const answer = await fetch(`http://127.0.0.1:${port}${path}`,
      { method, body: body && JSON.stringify(body) });
    const { value } = await answer.json();
    if (!answer.ok) throw new Error(value?.message ?? answer.statusText);
    return value;
  };
  const options = { binary: MINIBROWSER, args: ["--automation"] };
  let session;
  for (let k = 0; !session; k++) {
    try {
      session = await call("POST", "/session",
        { capabilities: { alwaysMatch: { "webkitgtk:browserOptions": options } } });
    } catch (error) {
      if (k === 40) throw error;
      await wait(250);
    }
  }
  const base = `/session/${session.sessionId}`;
  const keys = { End: "\uE010", Home: "\uE011", Enter: "\uE007" };
  return {
    version: `WebKitGTK/${session.capabilities.browserVersion}`, heard: [],
    open: async (url) => {
      await call("POST", `${base}/url`, { url: "about:blank" });
      await call("POST", `${base}/url`, { url });
    },
    ask: (body) => call("POST", `${base}/execute/sync`, { script: body, args: [] }),
    press: (key) => call("POST", `${base}/actions`, { actions: [{ type: "key", id: "keyboard",
      actions: [{ type: "keyDown", value: keys[key] }, { type: "keyUp", value: keys[key] }] }] }),
    size: (width, height) => call("POST", `${base}/window/rect`, { width, height }),
    shot: async (path) =>
      writeFileSync(path, Buffer.from(await call("GET", `${base}/screenshot`), "base64")),
    close: async () => {
      await call("DELETE", base).catch(() => null);
      process.kill(-driver.pid);
    }
  };
}

// ---- what is looked at ---------------------------------------------------------------------------

const lab = "const lab = document.querySelector('rotdyn-lab'), root = lab?.shadowRoot;";

async function openScene(page, id) {
  await page.open(`file://${file}#scene=${id}`);
  for (let k = 0; k < 300; k++) {
    if (await page.ask(`${lab} return root?.querySelector(".summary")?.textContent ?? "";`)) return;
    await wait(100);
  }
  throw new Error(`${id} does not open`);
}
const csv = (page) => page.ask(`${lab} return lab.csv();`);
const ink = (page) => page.ask(`${lab}
  return [...root.querySelectorAll("svg.picture, svg.plot")].every((one) =>
    [...one.querySelectorAll("path, circle")].some((mark) => {
      const box = mark.getBBox();
      return box.width + box.height > 4;
    }));`);
const wide = (page) => page.ask("return [document.documentElement.scrollWidth, innerWidth];");

async function look(name, page, known) {
  console.log(`# ${name}: ${page.version}`);
  const shot = (what) => SHOTS && page.shot(join(SHOTS, `${name}-${what}.png`));
  const numbers = {};
  await page.size(1280, 900);
  for (const id of scenes) {
    try {
      await openScene(page, id);
      numbers[id] = await csv(page);
      check(`${name}, ${id}: each panel has ink`, await ink(page));
      if (known) {
        check(`${name}, ${id}: Chromium's numbers, to the last digit`, numbers[id] === known[id]);
      }
      await shot(id);
    } catch (error) {
      check(`${name}, ${id}: opens`, false, error.message);
    }
  }

  await openScene(page, "spin-up");
  await page.ask(`${lab} root.querySelector(".inputs input[type=range]").focus();`);
  await page.press("End");
  await wait(700);
  numbers.end = await csv(page);
  check(`${name}: End moves a slider and the numbers`, numbers.end !== numbers["spin-up"] &&
    (!known || numbers.end === known.end));

  await page.size(320, 700);
  await wait(300);
  for (const [text, id] of [["100 %", "spin-up"], ["200 %", "free"]]) {
    await openScene(page, id);
    if (text === "200 %") {
      await page.ask("document.documentElement.style.fontSize = '200%';");
      await wait(300);
    }
    const [all, inner] = await wide(page);
    // The window of WebKit's small browser is no narrower than its tool bar.
    check(`${name}: ${inner} px, text ${text}: no sideways scrolling`, all <= inner + 10,
      `${all} px`);
    await shot(`narrow-${id}`);
  }
  await page.size(1280, 900);
  check(`${name}: no message`, page.heard.length === 0, page.heard.join("; "));
  return numbers;
}

async function reduced(name, page) {
  await openScene(page, "spin-up");
  check(`${name}: reduced motion and no WebGL are seen`, await page.ask(`
    return matchMedia("(prefers-reduced-motion: reduce)").matches &&
      !document.createElement("canvas").getContext("webgl");`));
  await page.ask(`${lab} [...root.querySelectorAll("button")].find((one) =>
    /Play/.test(one.textContent + one.getAttribute("aria-label"))).click();`);
  const seen = new Set();
  for (let k = 0; k < 15; k++) {
    seen.add(await page.ask(`${lab} return root.querySelector(".clock").textContent;`));
    await wait(100);
  }
  check(`${name}: two pictures a second`, seen.size > 1 && seen.size <= 5, [...seen].join("; "));
  await openScene(page, "free");
  check(`${name}: a body in space has ink`, await ink(page));
}

if (SHOTS) mkdirSync(SHOTS, { recursive: true });
let known;
const contenders = [
  ["chromium", CHROMIUM, () => byPuppeteer({ executablePath: CHROMIUM, args: flags })],
  ["firefox", FIREFOX, () => byPuppeteer({ browser: "firefox", executablePath: FIREFOX })],
  ["webkit", WEBKIT && MINIBROWSER, byWebKit]
];
for (const [name, there, start] of contenders) {
  if (!there) {
    skipped++;
    console.log(`skip - ${name} is not installed`);
    continue;
  }
  const page = await start();
  try {
    const found = await look(name, page, known);
    known ??= found;
  } finally {
    await page.close();
  }
}
if (FIREFOX) {
  const page = await byPuppeteer({ browser: "firefox", executablePath: FIREFOX,
    extraPrefsFirefox: { "webgl.disabled": true, "ui.prefersReducedMotion": 1 } });
  try { await reduced("firefox", page); } finally { await page.close(); }
}
console.log(`browsers: ${passed} passed, ${failed} failed, ${skipped} skipped`);
process.exit(failed ? 1 : 0);
