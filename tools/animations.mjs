// Drives the pages of tools/animations.R in headless Chromium by the keyboard alone: play, step,
// scrub, the last frame against the last row, the rules of axe-core. Prints a line for each check,
// then `animations: N passed, N failed`.
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { check, close, open, report, violations } from "./browser.mjs";

const { PAGES, SHOTS } = process.env;
const frame = (page, at = 0) => page.locator(".rotdyn-film").nth(at)
  .evaluate((root) => Number(root.dataset.frame));
// What is seen: the paths that are not hidden.
const shape = (page, at = 0) => page.locator(".stage").nth(at).evaluate((svg) =>
  [...svg.querySelectorAll("path[d]:not([display])")].map((one) => one.getAttribute("d"))
    .sort().join(" "));
const names = ["race", "collision", "pendulum", "chain", "gyroscope"];
for (const name of names) {
  const page = await open(name);
  const press = (key) => page.keyboard.press(key);
  const last = Number(await page.getByRole("slider", { name: "time" }).getAttribute("max"));
  check(`${name}: something is drawn`, (await page.locator(".stage path[d]").count()) > 2);
  check(`${name}: begins at rest, at its first frame`, (await frame(page)) === 0);
  const before = await shape(page);

  // Step, from the page itself and from the controls.
  await press("ArrowRight");
  await press("ArrowRight");
  await press("ArrowLeft");
  check(`${name}: the arrows step`, (await frame(page)) === 1, await frame(page));
  check(`${name}: the picture changes`, (await shape(page)) !== before);
  await press("PageUp");
  check(`${name}: Page up is ten frames`, (await frame(page)) === Math.min(11, last));
  await press("Home");
  check(`${name}: Home is the start`, (await frame(page)) === 0 && (await shape(page)) === before);

  // Every control by Tab, focus visible.
  const seen = [];
  for (let k = 0; k < 12; k++) {
    await press("Tab");
    seen.push(await page.evaluate(() => {
      const at = document.activeElement, look = getComputedStyle(at);
      return [at.getAttribute("aria-label") || at.textContent.trim().slice(0, 8) || at.id,
        look.outlineStyle !== "none" && parseFloat(look.outlineWidth) >= 3];
    }));
    if (seen[k][0] === "time") break;
  }
  check(`${name}: Tab goes through the buttons to the slider`, seen.length === 6, seen.join("; "));
  check(`${name}: focus is visible`, seen.every((one) => one[1]), seen.join("; "));

  // Scrub on the slider.
  await press("ArrowRight");
  await press("ArrowRight");
  const text = await page.getByRole("slider", { name: "time" }).getAttribute("aria-valuetext");
  check(`${name}: the slider scrubs and says the time`,
    (await frame(page)) === 2 && /^-?[0-9.]+ seconds$/.test(text), text);
  await page.getByRole("slider", { name: "time" }).fill(String(Math.floor(last / 2)));
  check(`${name}: any frame by the slider`, (await frame(page)) === Math.floor(last / 2));
  await page.waitForTimeout(700);
  const live = await page.locator("[aria-live=polite]").textContent();
  check(`${name}: the live text has the time and numbers`, /Time -?[0-9.]+ seconds.*[0-9]/.test(live), live);

  // Play and pause, from the slider by space.
  await press("Home");
  await press(" ");
  await page.waitForFunction(() => Number(document.querySelector(".rotdyn-film").dataset.frame) > 2,
    null, { timeout: 60000 });
  check(`${name}: space plays`, true);
  check(`${name}: the button says Pause`,
    (await page.locator(".play").textContent()) === "Pause");
  const wrong = await violations(page);
  check(`${name}: axe finds nothing while it plays`, wrong.length === 0, wrong.join("; "));
  if ((await page.locator(".play").textContent()) === "Pause") await press(" ");
  const held = await frame(page);
  await page.waitForTimeout(300);
  check(`${name}: space pauses`, (await frame(page)) === held);

  // To the end: played, then by its key.
  await press("End");
  for (let k = 0; k < 5; k++) await press("ArrowLeft");
  await press(" ");
  await page.waitForFunction((n) => {
    const root = document.querySelector(".rotdyn-film");
    return root.dataset.playing === "0" && Number(root.dataset.frame) === n;
  }, last, { timeout: 60000 });
  check(`${name}: it stops at the last frame`, (await frame(page)) === last);
  const want = readFileSync(join(PAGES, name + ".csv"), "utf8").trim().split(/\s+/).map(Number);
  const got = (await page.locator(".values .x").allTextContents()).map(Number);
  check(`${name}: the last frame shows the last row`, want.every((x, k) =>
    Math.abs(got[k] - x) <= 1e-3 * Math.abs(x) + 1e-12), `${got} for ${want}`);

  const left = await violations(page);
  check(`${name}: axe finds nothing`, left.length === 0, left.join("; "));
  await page.setViewportSize({ width: 320, height: 640 });
  await page.waitForTimeout(100);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  check(`${name}: no sideways scrolling at 320 px`, wide <= 320, wide);
  const narrow = await violations(page);
  check(`${name}: axe finds nothing at 320 px`, narrow.length === 0, narrow.join("; "));
  if (SHOTS) await page.screenshot({ path: join(SHOTS, name + "-320.png"), fullPage: true });
  check(`${name}: no request`, page.asked.length === 0, page.asked.join("; "));
  check(`${name}: no message`, page.heard.length === 0, page.heard.join("; "));
  await page.close();
}

// In space the view turns.
{
  const page = await open("gyroscope");
  const before = await shape(page);
  await page.getByLabel("turn the view").focus();
  for (let k = 0; k < 4; k++) await page.keyboard.press("ArrowRight");
  check("view: turned by the arrows", (await shape(page)) !== before && (await frame(page)) === 0);
  await page.close();
}

// Reduced motion: nothing moves before play, then two pictures a second.
{
  const page = await open("pendulum");
  await page.emulateMedia({ reducedMotion: "reduce" });
  await page.reload();
  const pictures = await page.evaluate(() => new Promise((done) => {
    const root = document.querySelector(".rotdyn-film"), met = new Set();
    new MutationObserver(() => met.add(root.dataset.frame))
      .observe(root, { attributes: true, attributeFilter: ["data-frame"] });
    root.querySelector(".play").click();
    const wait = () => root.dataset.playing === "0" ? done(met.size) : setTimeout(wait, 50);
    wait();
  }));
  check("reduced motion: few pictures, and the last one", pictures <= 6 && pictures >= 2, pictures);
  await page.close();
}

// Two in one document know nothing of each other.
if (existsSync(join(PAGES, "both.html"))) {
  const page = await open("both");
  const sliders = page.getByRole("slider", { name: "time" });
  check("document: two animations", (await sliders.count()) === 2);
  await sliders.nth(1).focus();
  await page.keyboard.press("ArrowRight");
  check("document: the second steps, the first does not",
    (await frame(page, 0)) === 0 && (await frame(page, 1)) === 1);
  await sliders.nth(0).focus();
  await page.keyboard.press("End");
  check("document: the first goes to its end, the second does not",
    (await frame(page, 0)) > 10 && (await frame(page, 1)) === 1);
  const wrong = await violations(page);
  check("document: axe finds nothing", wrong.length === 0, wrong.join("; "));
  check("document: no request", page.asked.length === 0, page.asked.join("; "));
  check("document: no message", page.heard.length === 0, page.heard.join("; "));
  await page.close();
}

await close();
report("animations");
