// The core as WebAssembly beside the native one: random scenes of every constraint, the scenes of
// the page, motions of the help pages' examples, damaged texts. LAB_WASM, LAB_NATIVE, LAB_FEW,
// LAB_EXAMPLES: what tools/check-lab.sh made.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import { after, test } from "node:test";
import { Engine } from "../src/engine.js";
import { controlsOf, sceneOf } from "../src/inputs.js";
import { linkOf, stateOf } from "../src/link.js";
import { endFrom, settingsFrom, startFrom } from "../src/settings.js";
import { Words } from "../src/words.js";
import { openNative } from "./native.mjs";
import { constructors, generator, mutated, randomScene } from "./random.mjs";

const { LAB_WASM, LAB_NATIVE, LAB_FEW, LAB_EXAMPLES } = process.env;
const { SCENES = "60", SEED = "1", MUTANTS = "20000" } = process.env;
const engine = new Engine(new WebAssembly.Module(readFileSync(LAB_WASM)));
const native = openNative(LAB_NATIVE);
after(() => native.close());

const times = { start: 0, end: 4, rows: 41, accuracy: 1e-9, steps: 2e5 };
const here = (text, more = times) => {
  const run = engine.run(text, more);
  return run.columns ?
    { ...run, models: engine.models(), audit: engine.audit(), code: engine.code(text) } : run;
};
const same = (a, b) => {
  const x = new BigUint64Array(a.buffer), y = new BigUint64Array(b.buffer);
  return x.length === y.length && x.every((bits, i) => bits === y[i]);
};

test("the stand-ins for GSL are GSL to the last bit", () => {
  const said = execFileSync(LAB_FEW, { encoding: "utf8" });
  assert.match(said, /^ok - 10000 random steps.*\nok - nodes and weights/);
});

test("the catalogue is the native one", async () => {
  assert.deepEqual(engine.catalogue, await native.catalogue);
});

// Largest difference of a measure over the sum of both errors; events and verdicts must be equal.
const compare = (a, b, text, { end } = times) => {
  const found = { ratio: 0, bits: true };
  assert.deepEqual(a.said, b.said, text);
  if (!b.report) return found;
  assert.equal(a.report.status, b.report.status, text);
  assert.equal(a.report.model, b.report.model, text);
  assert.equal(a.report.reason, b.report.reason, text);
  if (b.report.status !== 0) return found;
  // An event at the end itself falls before it or after it by rounding.
  const events = (run) => run.report.events
    .filter((one) => Math.abs(one.time_s - end) > 1e-12 * Math.abs(end))
    .map((one) => [one.name, one.place]);
  assert.deepEqual(events(a), events(b), text);
  const { measures } = b.report;
  const differs = measures.map(() => 0);
  for (const { name, measure, flag } of b.said.columns) {
    const [x, y] = [a.columns[name], b.columns[name]];
    if (!same(x, y)) found.bits = false;
    if (flag || measure < 0) continue;
    x.forEach((value, i) => {
      const off = Math.abs(value - y[i]);
      if (!(Number.isNaN(value) && Number.isNaN(y[i]))) differs[measure] = Math.max(differs[measure], off);
    });
  }
  differs.forEach((off, m) => {
    const sum = measures[m].error + a.report.measures[m].error;
    if (off > 0) found.ratio = Math.max(found.ratio, off / sum);
  });
  return found;
};

// The choice: the same models in the same order for the same reasons; code and verdicts.
const compareAnswers = (a, b, text) => {
  assert.deepEqual(a.models.map((one) => [one.model, one.applies, one.reason]),
    b.models.map((one) => [one.model, one.applies, one.reason]), text);
  assert.equal(a.code, b.code, text);
  assert.deepEqual(a.audit.map((one) => [one.quantity, one.balanced]),
    b.audit.map((one) => [one.quantity, one.balanced]), text);
};

for (const constructor of constructors) {
  test(`${constructor}: random scenes are the native ones`, async (t) => {
    const r = generator(Number(SEED) + constructors.indexOf(constructor));
    const seen = { scenes: 0, run: 0, bits: 0, bound: 0, worst_bound: 0, beyond: 0, worst: 0 };
    for (let k = 0; k < Number(SCENES); k++) {
      const text = JSON.stringify(randomScene(r, constructor));
      const [a, b] = [here(text), await native.run(text, times)];
      seen.scenes++;
      const found = compare(a, b, text);
      if (!b.report || b.report.status !== 0) continue;
      seen.run++;
      seen.bits += found.bits;
      compareAnswers(a, b, text);
      if (b.report.error_is_bound) {
        seen.bound++;
        seen.worst_bound = Math.max(seen.worst_bound, found.ratio);
        assert.ok(found.ratio <= 1, `${found.ratio} of both bounds: ${text}`);
      } else {
        seen.beyond += found.ratio > 1;
        seen.worst = Math.max(seen.worst, found.ratio);
      }
    }
    t.diagnostic(JSON.stringify(seen));
    assert.ok(seen.run >= 0.8 * seen.scenes, `only ${seen.run} of ${seen.scenes} scenes ran`);
    // Both estimates hold in 98 %.
    assert.ok(seen.beyond <= Math.max(1, 0.02 * seen.run), JSON.stringify(seen));
  });
}

test("the scenes of the page are the native ones", async () => {
  const scenes = new URL("../scenes/", import.meta.url);
  const read = (name) => JSON.parse(readFileSync(new URL(name, scenes), "utf8"));
  const seen = new Set();
  for (const id of read("list.json")) {
    const { scene, settings } = read(`${id}.json`), text = JSON.stringify(scene);
    const more = { ...times, end: settings.end, rows: 401 };
    const [a, b] = [here(text, more), await native.run(text, more)];
    assert.equal(a.report?.status, 0, `${id}: ${a.said.reason}`);
    const found = compare(a, b, id, more);
    assert.ok(found.ratio <= 1, `${id}: ${found.ratio}`);
    assert.ok(a.audit.every((one) => one.balanced === 1), id);
    seen.add(a.said.constraint);
  }
  // One of each constraint that needs no R function.
  const all = new Set(constructors.map((one) =>
    engine.read(JSON.stringify(randomScene(generator(3), one))).constraint));
  assert.deepEqual([...seen].sort(), [...all].sort());
});

test("the motions of the help pages' examples are the native ones", {
  skip: LAB_EXAMPLES ? false : "LAB_R=yes collects them"
}, async (t) => {
  const lines = readFileSync(LAB_EXAMPLES, "utf8").trim().split("\n");
  const seen = { motions: lines.length, run: 0, bits: 0, worst: 0 };
  for (const line of lines) {
    const [, start, end, rows, accuracy, text] = /^(\S+) (\S+) (\S+) (\S+) (.*)$/.exec(line);
    const more = {
      start: Number(start), end: Number(end), rows: Number(rows), accuracy: Number(accuracy), steps: 1e6
    };
    const [a, b] = [here(text, more), await native.run(text, more)];
    const found = compare(a, b, line, more);
    assert.equal(b.said.status, 0, line);
    if (b.report.status !== 0) continue;
    compareAnswers(a, b, line);
    seen.run++;
    seen.bits += found.bits;
    seen.worst = Math.max(seen.worst, found.ratio);
    assert.ok(found.ratio <= 1, `${found.ratio} of both errors: ${line}`);
  }
  t.diagnostic(JSON.stringify(seen));
  assert.ok(seen.run >= 0.9 * seen.motions && seen.motions >= 40, JSON.stringify(seen));
});

test("the texts of the core have words in every language", (t) => {
  const folder = new URL("../words/", import.meta.url);
  const codes = readdirSync(folder).map((name) => name.replace(".json", ""));
  globalThis.rotdynParts = { words: Object.fromEntries(codes.map((code) =>
    [code, JSON.parse(readFileSync(new URL(`${code}.json`, folder), "utf8"))])) };
  const texts = new Set(Object.values(engine.catalogue.models));
  for (const constructor of constructors) {
    const r = generator(Number(SEED) + 2000 + constructors.indexOf(constructor));
    for (let k = 0; k < 40; k++) {
      const text = JSON.stringify(randomScene(r, constructor));
      const run = engine.run(text, { ...times, rows: 5, steps: 2000, accuracy: k % 2 ? 1e-9 : 1e-3 });
      if (run.report) texts.add(run.report.status_text).add(run.report.reason ?? "");
      if (run.columns) {
        for (const one of engine.models()) texts.add(one.reason ?? "");
        for (const one of engine.audit()) for (const term of one.terms) texts.add(term.words);
      }
      texts.add(engine.read(mutated(r, text)).reason ?? "");
    }
  }
  texts.delete("");
  for (const code of codes.filter((one) => one !== "en")) {
    const words = new Words(code);
    const lacking = [...texts].filter((text) => words.translated(text) === undefined);
    assert.deepEqual(lacking, [], code);
    assert.notEqual(words.core("it does not take gravity"), "it does not take gravity");
  }
  assert.equal(new Words("de").core("it does not take a spring, viscous resistance and dry friction"),
    "nicht enthalten: Feder, zäher Widerstand und trockene Reibung");
  assert.equal(new Words("de").core("its error of 1.5e-05 exceeds the accuracy asked"),
    "sein Fehler 1,5e-05 übersteigt die verlangte Genauigkeit");
  assert.equal(new Words("en").core("it is no text of the core"), "it is no text of the core");
  t.diagnostic(`${texts.size} texts`);
});

test("damaged texts end in a scene or in a refusal with a reason", async (t) => {
  const r = generator(Number(SEED) + 1000), seen = { scenes: 0, refused: 0, traps: 0 };
  for (let k = 0; k < Number(MUTANTS); k++) {
    const text = mutated(r, JSON.stringify(randomScene(r, r.of(constructors))));
    const said = engine.read(text);
    // The native program, perhaps under sanitizers, says the same.
    const { said: same } = await native.run(text, { ...times, rows: 0 });
    assert.deepEqual(said, same, text);
    if (said.status === 0) {
      seen.scenes++;
      const { report } = k % 20 ? { report: { status: 0 } } :
        engine.run(text, { ...times, end: said.start_s + 1, rows: 5, steps: 2000 });
      if (report.status === 12) seen.traps++;
    } else {
      seen.refused++;
      if (said.status === 12) seen.traps++;
      assert.ok(said.reason.length > 3, text);
    }
  }
  t.diagnostic(JSON.stringify(seen));
  assert.equal(seen.traps, 0);
  assert.ok(seen.scenes > 0 && seen.refused > seen.scenes);
});

// As the page reads a link, by its own parts, up to the controls; one of 20 is run.
test("damaged links end in a motion or in a refusal", (t) => {
  const r = generator(Number(SEED) + 3000);
  const seen = { none: 0, refused: 0, scenes: 0, run: 0, ended: 0 };
  for (let k = 0; k < Number(MUTANTS); k++) {
    const damaged = (text) => k % 3 ? text : mutated(r, text);
    const whole = linkOf("", { scene: damaged(JSON.stringify(randomScene(r, r.of(constructors)))),
      title: "a <b>", start: k % 2 ? null : "0", end: damaged("5"), rows: damaged("41"),
      accuracy: damaged("1e-6") }) ?? "#lab=1";
    const link = k % 3 ? mutated(r, whole) : whole;
    const { state, refused } = stateOf(link);
    if (refused) { seen.refused++; continue; }
    if (!state) { seen.none++; continue; }
    const said = engine.read(state.scene);
    assert.notEqual(said.status, 12, link);
    if (said.status !== 0) {
      assert.ok(said.reason.length > 3, link);
      seen.refused++;
      continue;
    }
    seen.scenes++;
    const tree = JSON.parse(state.scene), settings = settingsFrom(state);
    const start = startFrom(settings, said.start_s), end = endFrom(settings.end, start);
    assert.ok(end > start && settings.rows >= 2 && settings.accuracy >= 1e-14, link);
    assert.ok(sceneOf(tree)[0] in engine.catalogue, link);
    for (const one of controlsOf(tree, engine.catalogue)) {
      assert.ok(one.low < one.high && Number.isFinite(one.step), `${link} ${one.name}`);
    }
    if (k % 20) continue;
    const { report, columns } = engine.run(JSON.stringify(tree),
      { start, end, rows: settings.rows, accuracy: settings.accuracy, steps: 2000 });
    assert.notEqual(report.status, 12, link);
    seen.run++;
    if (columns) seen.ended++;
    else assert.ok(report.status_text.length > 3, link);
  }
  t.diagnostic(JSON.stringify(seen));
  assert.ok(seen.none && seen.refused && seen.ended > 0.5 * seen.run, JSON.stringify(seen));
});

test("a refusal names the input", () => {
  const refused = (scene) => engine.read(typeof scene === "string" ? scene : JSON.stringify(scene));
  const axle = (inputs) => refused({ scene_axle: { body: 1, ...inputs } });
  assert.equal(axle({ bodi: 1 }).input, "bodi");
  assert.equal(axle({ body: -1 }).input, "body");
  assert.equal(axle({ torque: "a" }).input, "torque");
  assert.equal(axle({ theta0_rad: [1, 2] }).input, "theta0_rad");
  // An array of one number is that number, as R reads it.
  assert.equal(axle({ theta0_rad: [5], torque: [2] }).status, 0);
  assert.equal(axle({ resistance: { viscos: 1 } }).input, "viscos");
  assert.equal(refused({ scene_axle: {} }).input, "body");
  assert.equal(refused({ scene_axel: {} }).status, 2);
  assert.equal(refused("{").status, 2);
  assert.equal(refused('{"scene_axle":{"body":1,"body":2}}').status, 2);
  assert.equal(refused('{"scene_format":2,"scene_axle":{"body":1}}').status, 2);
  assert.equal(refused('{"scene_axle":{"body":1e999}}').input, "body");
  assert.equal(refused("[".repeat(100000)).status, 2);
  assert.equal(refused('{"scene_format":1,"scene_axle":{"body":1}}').status, 0);
});

test("a run without steps left tells how far it came", () => {
  const chain = { scene_chain: { length_m: [1, 1], mass_kg: 1, theta0_rad: [2, 2.5] } };
  const { report } = engine.run(JSON.stringify(chain), { ...times, end: 50, steps: 100 });
  assert.equal(report.status, 5);
  assert.ok(report.rows_done < times.rows && report.time_s < 50);
});
