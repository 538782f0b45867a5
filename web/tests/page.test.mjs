// The page in Chromium: each scene, each control by the keyboard, links, files, languages, narrow
// pages, damaged links, data. CHROMIUM, WEB: as tools/web.sh finds them; without a browser all is
// skipped. LAB_R=yes: the R code of each scene is run by Rscript, and compared with the CSV.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { generator, mutated } from "./random.mjs";

const { CHROMIUM, WEB, LAB_R, LINKS = "400" } = process.env;
const skip = CHROMIUM && WEB ? false : "no browser";
const file = fileURLToPath(new URL("../../inst/lab/lab.html", import.meta.url));
const scenes = new URL("../scenes/", import.meta.url);
const read = (name) => JSON.parse(readFileSync(new URL(name, scenes), "utf8"));
const folder = mkdtempSync(join(tmpdir(), "rotdyn-lab-"));
let browser, axe;

before(async () => {
  if (skip) return;
  const require = createRequire(join(WEB, "x.js"));
  axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");
  browser = await require("playwright-core").chromium.launch({
    executablePath: CHROMIUM,
    args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--disable-background-networking"]
  });
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

// A page that keeps what it said and whom it asked.
async function open(hash = "", { path = file, ...options } = {}) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 }, locale: "en-GB",
    acceptDownloads: true, ...options });
  page.setDefaultTimeout(30000);
  page.heard = [];
  page.asked = [];
  page.on("console", (message) => page.heard.push(message.text()));
  page.on("pageerror", (error) => page.heard.push(error.message));
  page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) page.asked.push(request.url());
  });
  await page.goto(`file://${path}${hash}`);
  await page.locator("rotdyn-lab .summary:not(:empty)").first().waitFor();
  return page;
}

const quiet = (page) => {
  assert.deepEqual(page.heard, []);
  assert.deepEqual(page.asked, []);
};
const violations = async (page) => {
  if (!(await page.evaluate(() => "axe" in window))) await page.evaluate(axe);
  const found = await page.evaluate(() => window.axe.run(document));
  return found.violations.map((one) => `${one.id}: ${one.nodes[0].html.slice(0, 120)}`);
};
// Every picture and every panel has a path with points.
const ink = (page) => page.locator("rotdyn-lab").evaluate((lab) =>
  [...lab.shadowRoot.querySelectorAll("svg.picture, svg.plot")].map((one) =>
    [...one.querySelectorAll("path, circle")].some((mark) => {
      const box = mark.getBBox();
      return box.width + box.height > 4;
    })));
const settled = (page) => page.waitForTimeout(700);
const csvOf = (page) => page.locator("rotdyn-lab").evaluate((lab) => lab.csv());

for (const id of read("list.json")) {
  test(`${id}: each control by the keyboard, ink, no message, axe-core`, { skip }, async () => {
    const page = await open(`#scene=${id}`);
    assert.deepEqual(await violations(page), []);
    assert.ok((await ink(page)).every(Boolean), "ink at the start");
    const lab = page.locator("rotdyn-lab");
    await lab.locator(".inputs details").evaluateAll((all) => all.forEach((one) => {
      one.open = true;
    }));
    const names = await lab.locator(".inputs input[type=range]").evaluateAll((all) =>
      all.map((one) => one.labels[0].textContent));
    assert.equal(new Set(names).size, names.length, names.join("; "));
    for (const name of names) {
      const slider = page.getByRole("slider", { name, exact: true });
      await slider.focus();
      const value = () => slider.inputValue().then(Number);
      const begin = await value();
      for (const key of ["End", "Home"]) {
        await page.keyboard.press(key);
        const end = Number(await slider.getAttribute(key === "End" ? "max" : "min"));
        assert.ok(Math.abs(await value() - end) <= Number(await slider.getAttribute("step")),
          `${name}: ${key}`);
        assert.match(await slider.getAttribute("aria-valuetext"), /^-?[0-9.e-]+/);
        assert.ok((await ink(page)).every(Boolean), `${name}: ink after ${key}`);
      }
      const low = await value(), step = Number(await slider.getAttribute("step"));
      await page.keyboard.press("ArrowRight");
      assert.ok(await value() > low, `${name}: an arrow is a step`);
      await page.keyboard.press("PageUp");
      assert.ok(await value() >= low + 10.5 * step || await value() ===
        Number(await slider.getAttribute("max")), `${name}: Page up is ten`);
      // Back to where it was, by the field.
      const field = lab.locator(`[id="${await slider.getAttribute("id")}-n"]`);
      await field.fill(String(begin));
      await field.press("Enter");
    }
    await settled(page);
    assert.deepEqual(await violations(page), []);
    quiet(page);
    await page.close();
  });

  test(`${id}: the R code gives the numbers of the page`, { skip: skip || !LAB_R }, async () => {
    const page = await open(`#scene=${id}`);
    await settled(page);
    const code = await page.locator("#code").inputValue();
    const path = join(folder, "page.csv");
    writeFileSync(path, await csvOf(page));
    const script = join(folder, "code.R");
    writeFileSync(script, `${code.replace("\nmotion\naudit(motion)\n", "\n")}
page <- utils::read.csv(${JSON.stringify(path)})
run <- attr(motion, "run")
stopifnot(all(audit(motion)$verdict == "balanced"), nrow(page) == nrow(motion))
worst <- 0
for (name in setdiff(names(page), "time_s")) {
  x <- motion[[name]]
  if (is.null(x) || !is.double(x)) next
  size <- max(abs(x), 1e-300)
  # Columns that derive from measures lose digits where they cancel: of the largest row.
  worst <- max(worst, abs(x - page[[name]]) / size / (2 * run$info$error + 1e-12), na.rm = TRUE)
}
stopifnot(identical(page$time_s, motion$time_s))
cat(run$model, worst)
`);
    const [model, worst] = execFileSync("Rscript", [script], { encoding: "utf8" }).split(" ");
    assert.ok((await page.locator(".model").textContent()).includes(`Model ${model}:`));
    assert.ok(Number(worst) <= 1, worst);
    await page.close();
  });
}

test("time: play, pause, step, scrub, events, end", { skip }, async () => {
  const page = await open("#scene=clutch");
  const slider = page.getByRole("slider", { name: "time" });
  const at = () => slider.inputValue().then(Number);
  await page.getByRole("button", { name: "Step", exact: true }).press("Enter");
  assert.equal(await at(), 1);
  await page.getByRole("button", { name: "Step back" }).press("Enter");
  assert.equal(await at(), 0);
  await slider.focus();
  await page.keyboard.press("PageUp");
  assert.equal(await at(), 10);
  await page.keyboard.press("End");
  assert.equal(await at(), Number(await slider.getAttribute("max")));
  await page.keyboard.press("Home");
  await page.getByRole("button", { name: "Next event" }).press("Enter");
  const clock = await page.locator(".clock").textContent();
  const said = await page.locator(".events li").first().textContent();
  assert.match(said, /locks at [0-9.]+ s/);
  assert.ok(Math.abs(parseFloat(clock) - parseFloat(said.match(/[0-9.]+/)[0])) < 0.01, clock);
  await page.getByRole("button", { name: "Play" }).press("Enter");
  await page.waitForTimeout(600);
  await page.getByRole("button", { name: "Pause" }).press("Enter");
  const there = await at();
  assert.ok(there > 0);
  await page.waitForTimeout(200);
  assert.equal(await at(), there);
  quiet(page);
  await page.close();
});

test("reduced motion: two pictures a second", { skip }, async () => {
  const page = await open("#scene=spin-up", { reducedMotion: "reduce" });
  await page.getByRole("button", { name: "Play" }).press("Enter");
  const seen = new Set();
  for (let k = 0; k < 30; k++) {
    seen.add(await page.getByRole("slider", { name: "time" }).inputValue());
    await page.waitForTimeout(50);
  }
  assert.ok(seen.size <= 5, [...seen].join());
  await page.close();
});

test("the view turns by keys and buttons", { skip }, async () => {
  const page = await open("#scene=free");
  const shape = () => page.locator(".picture").evaluate((one) => one.innerHTML);
  const first = await shape();
  await page.locator(".stage").focus();
  await page.keyboard.press("ArrowLeft");
  const second = await shape();
  assert.notEqual(second, first);
  await page.getByRole("button", { name: "From above" }).press("Enter");
  assert.notEqual(await shape(), second);
  await page.close();
});

test("a model that changes with the inputs, said once it changed", { skip }, async () => {
  const page = await open("#scene=spin-up");
  const model = () => page.locator(".model").textContent();
  assert.match(await model(), /axle_linear/);
  const field = page.getByLabel("dry friction, resistance, N m");
  await field.fill("0.1");
  await field.press("Enter");
  assert.doesNotMatch(await model(), /axle_linear/);
  await settled(page);
  assert.match(await page.locator(".live").textContent(), /axle_drag/);
  await field.fill("-1");
  await field.press("Enter");
  assert.match(await page.locator(".inputs [role=alert]").textContent(), /coulomb_n_m/);
  await field.fill("much");
  await field.press("Enter");
  assert.match(await page.locator(".inputs [role=alert]").textContent(), /no number/);
  quiet(page);
  await page.close();
});

test("a link, and a file, bring the lab back", { skip }, async () => {
  const page = await open("#scene=pendulum");
  const field = page.getByLabel("angle at the start, rad");
  await field.fill("1.25");
  await field.press("Enter");
  await settled(page);
  const link = await page.locator("#link").inputValue(), csv = await csvOf(page);
  assert.ok(link.length < 2000);
  const again = await open(link.slice(link.indexOf("#")));
  assert.equal(await csvOf(again), csv);
  const waiting = page.waitForEvent("download");
  await page.getByRole("button", { name: "Save this lab" }).press("Enter");
  const path = join(folder, "saved.html");
  await (await waiting).saveAs(path);
  const saved = await open("", { path });
  assert.equal(await csvOf(saved), csv);
  for (const one of [page, again, saved]) {
    quiet(one);
    await one.close();
  }
});

test("two languages, decimal comma", { skip }, async () => {
  const page = await open("#scene=spin-up", { locale: "de-DE" });
  assert.equal(await page.locator("html").getAttribute("lang"), "de");
  assert.equal(await page.getByLabel("Radius, Scheibe, m").inputValue(), "0,25");
  const field = page.getByLabel("Drehmoment, N m");
  await field.fill("0,5");
  await field.press("Enter");
  assert.match(await csvOf(page), /^time_s;theta_rad/);
  assert.deepEqual(await violations(page), []);
  await page.getByLabel("Sprache").selectOption("en");
  await page.getByLabel("radius, disk, m").waitFor();
  const [en, de] = ["en", "de"].map((code) =>
    JSON.parse(readFileSync(new URL(`../words/${code}.json`, import.meta.url))));
  // Texts of the core are English; core.test.mjs looks for their translations.
  assert.deepEqual(Object.keys(de).filter((one) => !one.startsWith("core.")).sort(),
    Object.keys(en).sort());
  quiet(page);
  await page.close();
});

test("another language leaves what was set; a link's language can be changed", { skip }, async () => {
  const page = await open("#scene=pendulum");
  const field = page.getByLabel("angle at the start, rad");
  await field.fill("1.25");
  await field.press("Enter");
  await page.locator("#end").fill("7");
  await page.locator("#end").press("Enter");
  const state = () => page.locator("rotdyn-lab").evaluate((lab) => [lab.text, lab.end]);
  const set = await state();
  assert.match(set[0], /"theta0_rad":1.25/);
  await page.getByLabel("Language").selectOption("de");
  await page.locator(".title", { hasText: "Pendel beliebiger Amplitude" }).waitFor();
  assert.deepEqual(await state(), set);
  assert.equal(await page.locator("#lab-scene").inputValue(), "pendulum");
  await page.getByRole("button", { name: "Neu beginnen" }).press("Enter");
  assert.match((await state())[0], /"theta0_rad":2.8/);
  quiet(page);
  await page.close();
  const scene = encodeURIComponent('{"scene_axle":{"body":0.5,"torque":1}}');
  for (const hash of [`#lab=1&lang=de&scene=${scene}`, "#lab=1&lang=de&scene=x"]) {
    const link = await open(hash);
    assert.equal(await link.locator("html").getAttribute("lang"), "de");
    const note = await link.locator("#note").textContent();
    await link.getByLabel("Sprache").selectOption("en");
    await link.getByRole("button", { name: "Start again" }).waitFor();
    assert.equal(await link.locator("html").getAttribute("lang"), "en");
    const english = await link.locator("#note").textContent();
    assert.ok(note === "" ? english === "" : /refused/.test(english), english);
    quiet(link);
    await link.close();
  }
});

test("fields: what is no number, and what was understood", { skip }, async () => {
  const page = await open("#scene=spin-up");
  const field = page.getByLabel("radius, disk, m"), end = page.locator("#end");
  const wrong = () => page.locator("rotdyn-lab").evaluate((lab) =>
    lab.wrong.hidden ? "" : lab.wrong.textContent);
  const type = async (into, text) => {
    await into.fill(text);
    await into.press("Enter");
    return [await into.inputValue(), await wrong()];
  };
  const no = "radius, disk: this is no number.";
  for (const text of ["0x10", "1e400", "", "NaN", "1.2.3"]) {
    assert.deepEqual(await type(field, text), [text, no]);
  }
  assert.deepEqual(await type(field, "0,3"), ["0.3", ""]);
  assert.deepEqual(await type(field, "3e-1"), ["0.3", ""]);
  assert.match((await type(field, "-Inf"))[1], /must be finite/);
  assert.match((await type(end, "0"))[1], /must end after it begins/);
  assert.deepEqual(await type(end, "5"), ["5", ""]);
  quiet(page);
  await page.close();
});

test("two labs of different scenes share the core: each paints its own", { skip }, async () => {
  const page = await open("#scene=spin-up");
  const [first, second] = await page.evaluate(async () => {
    const one = document.querySelector("rotdyn-lab"), two = document.createElement("rotdyn-lab");
    two.setAttribute("scene", JSON.stringify({ scene_free: { body: [1, 2, 2.6],
      omega0_rad_per_s: [0.05, 6, 0.05] } }));
    document.body.append(two);
    await new Promise((done) => two.addEventListener("rotdyn-settled", done));
    one.goto(3);
    return [one, two].map((lab) => lab.constraint());
  });
  assert.deepEqual([first, second], ["axle", "free"]);
  // One that was removed paints no more.
  await page.evaluate(() => {
    const one = document.querySelector("rotdyn-lab");
    one.remove();
    document.body.append(one);
    document.body.style.width = "700px";
  });
  await settled(page);
  quiet(page);
  await page.close();
});

test("start again stops the motion that plays", { skip }, async () => {
  const page = await open("#scene=free");
  await page.getByRole("button", { name: "Play", exact: true }).press("Enter");
  await page.waitForTimeout(200);
  await page.getByRole("button", { name: "Start again" }).press("Enter");
  const now = () => page.locator("rotdyn-lab").evaluate((lab) => lab.t);
  const begin = await now();
  await page.waitForTimeout(300);
  assert.deepEqual([begin, await now()], [0, 0]);
  await page.close();
});

test("320 px and 200 % text: no sideways scrolling", { skip }, async () => {
  for (const id of ["spin-up", "free", "drive"]) {
    const page = await open(`#scene=${id}`, { viewport: { width: 320, height: 700 } });
    const wide = () => page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(await wide() <= 320, `${id}: ${await wide()}`);
    assert.deepEqual(await violations(page), []);
    await page.addStyleTag({ content: "html { font-size: 200% }" });
    await page.waitForTimeout(200);
    assert.ok(await wide() <= 330, `${id}, 200 %: ${await wide()}`);
    await page.close();
  }
});

test("dark mode and forced colours keep contrast", { skip }, async () => {
  const page = await open("#scene=incline", { colorScheme: "dark" });
  assert.deepEqual(await violations(page), []);
  await page.close();
});

test("a CSV of one's own: points and differences", { skip }, async () => {
  const page = await open("#scene=spin-up");
  const [head, ...rows] = (await csvOf(page)).trim().split("\n");
  const at = head.split(",").indexOf("omega_rad_per_s");
  const own = rows.filter((_, i) => i % 40 === 0).map((row) => {
    const cells = row.split(",");
    return `${cells[0]},${Number(cells[at]) + 0.5}`;
  });
  await page.locator("#data").setInputFiles({ name: "own.csv", mimeType: "text/csv",
    buffer: Buffer.from(["time_s,omega_rad_per_s", ...own].join("\n")) });
  await page.locator(".dot").first().waitFor();
  assert.match(await page.locator(".take").textContent(), /11 points, off by at most 0\.5 rad/);
  await page.locator("#data").setInputFiles({ name: "bad.csv", mimeType: "text/csv",
    buffer: Buffer.from("<b>t</b>,x\n1,2\n") });
  await page.getByText("The file has no column time_s.").waitFor();
  quiet(page);
  await page.close();
});

test("predict: curves are hidden, guesses are compared", { skip }, async () => {
  const page = await open("#scene=spin-up");
  await page.getByText("Predict before you see").press("Enter");
  await settled(page);
  const seen = () => page.locator(".plot .curve").first().evaluate((one) =>
    getComputedStyle(one).visibility);
  assert.equal(await seen(), "hidden");
  assert.doesNotMatch(await page.locator(".summary").textContent(), /211/);
  await page.getByLabel("at 10 s").fill("200");
  await page.getByRole("button", { name: "Show and compare" }).press("Enter");
  assert.equal(await seen(), "visible");
  assert.match(await page.locator(".predict").textContent(),
    /At 10 s: guessed 200, computed 211\.568, off by −11\.57\./);
  assert.deepEqual(await violations(page), []);
  quiet(page);
  await page.close();
});

test("pictures: SVG with the code in it, PNG", { skip }, async () => {
  const page = await open("#scene=hoop");
  const saved = async (name) => {
    const waiting = page.waitForEvent("download");
    await page.getByRole("button", { name }).press("Enter");
    const path = join(folder, "picture");
    await (await waiting).saveAs(path);
    return readFileSync(path);
  };
  assert.match(String(await saved("Save picture (SVG)")), /<desc>library\(rotdyn\)/);
  const png = await saved("Save picture (PNG)");
  assert.equal(png.subarray(1, 4).toString(), "PNG");
  assert.ok(png.length > 4000);
  // A film of ten seconds at ten times the speed, then the picture where it was.
  await page.locator("#time").press("Home");
  await page.locator("#speed").selectOption("10");
  const film = await saved("Save film (video)");
  assert.equal(film.subarray(0, 4).toString("hex"), "1a45dfa3");
  assert.ok(film.length > 5000, `${film.length} bytes`);
  await page.getByRole("button", { name: "Save film (video)" }).waitFor();
  assert.equal(await page.locator("#time").inputValue(), "0");
  quiet(page);
  await page.close();
});

test("links of strangers end in a scene or a sentence", { skip }, async () => {
  const page = await open();
  const r = generator(7), good = new URLSearchParams({ lab: "1", end: "5",
    title: "<img src=x onerror=alert(1)>", scene: JSON.stringify(read("free.json").scene) });
  const seen = await page.evaluate(async (links) => {
    const seen = { shown: 0, noted: 0, empty: [] };
    for (const link of links) {
      const ended = new Promise((done) => {
        const end = () => { removeEventListener("rotdyn-ready", end); setTimeout(done, 0); };
        addEventListener("rotdyn-ready", end);
        setTimeout(done, 3000);
      });
      location.hash = link;
      await ended;
      const lab = document.querySelector("rotdyn-lab");
      const note = document.getElementById("note").textContent;
      if (note) seen.noted++; else seen.shown++;
      const refusal = lab?.shadowRoot?.querySelector(".refused:not([hidden])")?.textContent ?? "";
      if (!lab?.shadowRoot?.querySelector(".plot path") && !/: .+[.]$/.test(refusal)) {
        seen.empty.push(link);
      }
    }
    return seen;
  }, Array.from({ length: Number(LINKS) }, (_, k) => k % 3 ? mutated(r, String(good)) :
    new URLSearchParams({ lab: "1", end: mutated(r, "5"),
      scene: mutated(r, good.get("scene")) }).toString()));
  assert.deepEqual(seen.empty, []);
  assert.ok(seen.noted > 0 && seen.shown > 0, JSON.stringify(seen));
  assert.equal(await page.locator("img").count(), 0);
  assert.deepEqual(page.asked, []);
  await page.close();
});

test("a motion beyond doubles: a sentence, the inputs, and no button without a motion", { skip },
  async () => {
    const page = await open();
    const scene = { scene_free: { body: [1, 2, 2.6], omega0_rad_per_s: [0.05, 6, 5e306] } };
    await page.evaluate((hash) => { location.hash = hash; },
      new URLSearchParams({ lab: "1", scene: JSON.stringify(scene) }).toString());
    const refusal = page.locator("rotdyn-lab .refused:not([hidden])");
    await refusal.first().waitFor();
    assert.deepEqual(await refusal.allTextContents(),
      ["This scene cannot be computed: the motion leaves the range of double precision."]);
    const buttons = await page.locator("rotdyn-lab").getByRole("button").all();
    assert.deepEqual(await Promise.all(buttons.map((one) => one.textContent())), ["Start again"]);
    await page.getByLabel("rate at the start z, rad/s").fill("3");
    await page.keyboard.press("Enter");
    await settled(page);
    assert.equal(await refusal.count(), 0);
    assert.ok(await page.locator("rotdyn-lab .plot path").count() > 0);
    assert.ok((await page.locator("rotdyn-lab").getByRole("button").all()).length > 5);
    quiet(page);
    await page.close();
  });

test("two labs of a document, self-contained and split", { skip: skip || !LAB_R }, async () => {
  writeFileSync(join(folder, "two.Rmd"), `---
title: two
---
\`\`\`{r}
library(rotdyn)
lab(scene_hoop(1, 1, 3, theta0_rad = 0.5))
lab(scene_rotors(c(1, 2), 100, omega0_rad_per_s = c(1, 0)))
\`\`\`
`);
  for (const whole of ["TRUE", "FALSE"]) {
    execFileSync("Rscript", ["-e", `rmarkdown::render(${JSON.stringify(join(folder, "two.Rmd"))},
      rmarkdown::html_document(theme = NULL, highlight = NULL, mathjax = NULL,
        self_contained = ${whole}), quiet = TRUE)`]);
    const page = await open("", { path: join(folder, "two.html") });
    await page.locator("rotdyn-lab .summary:not(:empty)").nth(1).waitFor();
    await settled(page);
    const titles = await page.locator("rotdyn-lab .title").allTextContents();
    assert.deepEqual(titles, ["A bead on a turning hoop", "Rotors on a shaft"]);
    const models = await page.locator("rotdyn-lab .model").allTextContents();
    assert.match(models[0], /hoop_/);
    assert.match(models[1], /rotors_/);
    // A change of the one leaves the other.
    const second = await page.locator("rotdyn-lab").nth(1).evaluate((lab) => lab.csv());
    const field = page.locator("rotdyn-lab").first().getByLabel("angle at the start, rad");
    await field.fill("1");
    await field.press("Enter");
    await settled(page);
    assert.equal(await page.locator("rotdyn-lab").nth(1).evaluate((lab) => lab.csv()), second);
    assert.match(await page.locator("rotdyn-lab").first().locator(".audit").textContent(),
      /hoop turning/);
    assert.deepEqual((await violations(page)).filter((one) => !/landmark|region|html-has-lang/
      .test(one)), []);
    quiet(page);
    await page.close();
  }
});

test("without WebAssembly: a sentence", { skip }, async () => {
  const page = await browser.newPage();
  await page.addInitScript(() => { delete window.WebAssembly; });
  await page.goto(`file://${file}`);
  await page.locator("rotdyn-lab .refused").waitFor();
  assert.match(await page.locator("rotdyn-lab .refused").textContent(), /WebAssembly/);
  await page.close();
});

test("the cost of a slider step and of a frame", { skip }, async (t) => {
  const page = await browser.newPage();
  const client = await page.context().newCDPSession(page);
  await client.send("Performance.enable", { timeDomain: "threadTicks" });
  await page.goto(`file://${file}#scene=spin-up`);
  await page.locator("rotdyn-lab .summary:not(:empty)").waitFor();
  const cost = async () => {
    const { metrics } = await client.send("Performance.getMetrics");
    const of = (name) => 1000 * metrics.find((one) => one.name === name).value;
    return { task: of("TaskDuration"), script: of("ScriptDuration") };
  };
  const start = await cost();
  await page.getByRole("slider", { name: "torque", exact: true }).focus();
  const before = await cost();
  for (let k = 0; k < 30; k++) await page.keyboard.press(k % 2 ? "ArrowLeft" : "ArrowRight");
  const now = await cost();
  const step = (name) => ((now[name] - before[name]) / 30).toFixed(1);
  t.diagnostic(`ready ${start.task.toFixed(0)} ms of main thread; a step ${step("task")} ms, ${
    step("script")} ms of it script`);
  assert.ok(now.script > before.script);
  await page.close();
});
