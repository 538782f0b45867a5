// The core as WebAssembly: one instance for all labs of a document. Answers are objects; columns
// are Float64Arrays of their own. After a trap the instance is started anew.
const wasiStub = () => 0;

const bytesOf = (base64) => {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
};

// A number beyond the doubles is written 1e999; what JSON.parse makes of it is Infinity.
class Engine {
  constructor(module) {
    this.module = module;
    this.start();
    this.catalogue = this.answer("lab_catalogue");
  }

  start() {
    const imports = {};
    for (const one of WebAssembly.Module.imports(this.module)) {
      (imports[one.module] ??= {})[one.name] = wasiStub;
    }
    this.core = new WebAssembly.Instance(this.module, imports).exports;
    this.core._initialize();
    this.scene = null;
  }

  text(at) {
    const memory = new Uint8Array(this.core.memory.buffer);
    return new TextDecoder().decode(memory.slice(at, memory.indexOf(0, at)));
  }

  put(text) {
    const bytes = new TextEncoder().encode(text), at = this.core.lab_input(bytes.length);
    if (at) new Uint8Array(this.core.memory.buffer).set(bytes, at);
    return at !== 0;
  }

  answer(name, ...numbers) {
    const at = this.core[name](...numbers);
    return at ? JSON.parse(this.text(at)) : null;
  }

  // A call that may trap: the instance is lost then, and the answer says so.
  guarded(call) {
    try {
      return call();
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError) && !(error instanceof RangeError)) throw error;
      this.start();
      return { status: 12, input: null, reason: "the core stopped; it was started anew" };
    }
  }

  // The scene of this text, unless it is there; => what the core says of it.
  read(text) {
    if (this.scene === text) return this.said;
    return this.guarded(() => {
      this.scene = null;
      if (text.includes("\0") || !this.put(text)) {
        return { status: 2, input: null, reason: "the text is no JSON" };
      }
      this.said = this.answer("lab_read");
      if (this.said.status === 0) this.scene = text;
      return this.said;
    });
  }

  // => { said, report, time, columns: { name: numbers } }; without a report where it was refused.
  run(text, { start, end, rows, accuracy, steps, model = "" }) {
    const said = this.read(text);
    if (said.status !== 0) return { said };
    const report = this.guarded(() => {
      this.put(model);
      return this.answer("lab_run", start, end, rows, accuracy, steps) ??
        { status: 2, input: null, reason: "" };
    });
    if (report.status === 12 || !report.rows_done && report.status !== 0) return { said, report };
    const memory = this.core.memory.buffer, columns = {};
    const take = (at, n) => new Float64Array(memory, at, n).slice();
    said.columns.forEach((one, i) => {
      columns[one.name] = take(this.core.lab_column(i), rows * said.rows_per_time);
    });
    return { said, report, time: take(this.core.lab_times(), rows), columns };
  }

  // Of the last run.
  models() { return this.guarded(() => this.answer("lab_models")) ?? []; }
  audit() { return this.guarded(() => this.answer("lab_audit")) ?? []; }

  // The R code of the scene of this text; empty where it needs read_scene().
  code(text) {
    if (this.read(text).status !== 0) return "";
    return this.guarded(() => this.text(this.core.lab_code()));
  }
}

// Base64 of the gzipped core => engine.
async function openEngine(base64) {
  const gzip = new Blob([bytesOf(base64)]).stream();
  const core = new Response(gzip.pipeThrough(new DecompressionStream("gzip")));
  return new Engine(await WebAssembly.compile(await core.arrayBuffer()));
}

const canCompute = () =>
  typeof WebAssembly === "object" && typeof DecompressionStream === "function";

export { Engine, canCompute, openEngine };
