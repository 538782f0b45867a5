// One scene file for each constraint through R, the command line, the C library (a C program, and
// Python) and WebAssembly: the same model for the same reasons, natively the same bits; WebAssembly
// within both error figures. R_FACE=yes: R and `rotdyn` on the PATH; LIBRARY, PYTHONPATH: of Python;
// LAB_NATIVE, LAB_WASM: as for core.test.mjs. Closes with `faces: N passed, N failed, N skipped`.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { Engine } from "../src/engine.js";
import { openNative } from "./native.mjs";

const { LAB_NATIVE, LAB_WASM, R_FACE, PYTHON } = process.env;
const folder = new URL("../scenes/", import.meta.url);
const read = (name) => JSON.parse(readFileSync(new URL(`${name}.json`, folder), "utf8"));
const script = (name) => fileURLToPath(new URL(name, import.meta.url));
const rows = 41;
const cases = read("list").map((id) => {
  const { scene, settings } = read(id), end = settings?.end ?? 10;
  // As the page and seq() have them.
  const times = Array.from({ length: rows }, (_, i) => i === rows - 1 ? end : i * (end / (rows - 1)));
  return { id, text: JSON.stringify(scene), times, end };
});
const work = mkdtempSync(join(tmpdir(), "rotdyn-faces-"));
const input = join(work, "scenes");
writeFileSync(input, cases.map(({ times, text }) => `${times.join(" ")}\t${text}\n`).join(""));

let passed = 0, failed = 0, skipped = 0;
const check = (what, fine, more = "") => {
  if (fine) passed++; else failed++;
  console.log(`${fine ? "ok" : "not ok"} - ${what}${fine ? "" : ` (${more})`}`);
};
const skip = (what) => { skipped++; console.log(`skip - ${what}`); };
const numbers = (hex) => {
  const bytes = Buffer.from(hex.join(""), "hex");
  return Float64Array.from({ length: hex.length }, (_, i) => bytes.readDoubleBE(8 * i));
};
const lines = (program, args, env) => execFileSync(program, args, {
  encoding: "utf8", maxBuffer: 1 << 28, env: { ...process.env, ...env }, stdio: ["ignore", "pipe", "ignore"]
}).trim().split("\n").map((line) => {
  const found = JSON.parse(line);
  for (const name in found.columns) found.columns[name] = numbers(found.columns[name]);
  return found;
});

// The first value that differs; NaN is like NaN. `within`: of the largest value.
const difference = (a, b, within = () => 0) => {
  for (const name in a) {
    if (!(name in b)) continue;
    const size = a[name].reduce((most, x) => Math.max(most, Math.abs(x) || 0), 0);
    if (a[name].length !== b[name].length) return `${name}: ${b[name].length} rows`;
    for (let i = 0; i < a[name].length; i++) {
      const [x, y] = [a[name][i], b[name][i]];
      if (Object.is(x, y) || x === y || Number.isNaN(x) && Number.isNaN(y)) continue;
      if (Math.abs(x - y) <= within(name) * size) continue;
      return `${name}, row ${i + 1}: ${x} and ${y}`;
    }
  }
  return "";
};
const common = (a, b) => Object.keys(a).filter((name) => name in b && name !== "time_s").length;
const why = (models) => JSON.stringify(models.map((one) => [one[0], one[one.length - 1]]));

const native = openNative(LAB_NATIVE);
const engine = new Engine(new WebAssembly.Module(readFileSync(LAB_WASM)));
const byR = R_FACE ? lines("Rscript", [script("faces.R"), input]) : null;
const byPython = PYTHON ? lines(PYTHON, [script("faces.py"), input]) : null;
if (!byR) skip("R and the command line");
if (!byPython) skip("Python");
for (const [k, { id, text, times, end }] of cases.entries()) {
  const how = { start: 0, end, rows, accuracy: 1e-9, steps: 1e6 };
  const c = await native.run(text, how), wasm = engine.run(text, how);
  const reasons = c.models.map((one) => [one.model, one.reason]);
  check(`${id}, WebAssembly: ${c.report.model}, the same reasons`,
    wasm.report.model === c.report.model &&
    why(engine.models().map((one) => [one.model, one.reason])) === why(reasons),
    `${wasm.report.model}, ${why(reasons)}`);
  const error = wasm.report.error + c.report.error;
  const off = difference(c.columns, wasm.columns, () => 10 * error);
  check(`${id}, WebAssembly: numbers within the error figures`, !off, off);
  const face = (name, found) => {
    check(`${id}, ${name}: ${c.report.model}, the same reasons`, found.model === c.report.model &&
      (!found.models || why(found.models) === why(reasons)),
    `${found.model}, ${found.models && why(found.models)}, ${why(reasons)}`);
    const differs = difference(found.columns, c.columns);
    check(`${id}, ${name}: the same bits in ${common(found.columns, c.columns)} columns`,
      !differs && common(found.columns, c.columns) >= 2, differs);
  };
  if (byR) {
    face("R", byR[k]);
    const path = join(work, `${id}.json`);
    writeFileSync(path, text);
    const said = (verb) => JSON.parse(execFileSync("rotdyn",
      [verb, path, "--times", times.join(","), "--json"],
      { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] }));
    const choice = said("choose"), motion = said("trajectory"), columns = {};
    for (const name in motion[0]) {
      if (typeof motion[0][name] === "string") continue;
      columns[name] = Float64Array.from(motion, (row) =>
        row[name] === null ? NaN : Number(row[name]));
    }
    face("command line", { model: choice.find((one) => one.chosen).model, columns,
      models: choice.map((one) => [one.model, one.reason]) });
  }
  if (byPython) face("Python", byPython[k]);
}
native.close();
rmSync(work, { recursive: true, force: true });
console.log(`faces: ${passed} passed, ${failed} failed, ${skipped} skipped`);
process.exit(failed ? 1 : 0);
