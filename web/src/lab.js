// The element <rotdyn-lab scene='{...}' settings='{...}'>: a scene with its controls, its motion,
// its model, error, audit, and what can be taken away.
import { openEngine } from "./engine.js";
import { el, svg } from "./dom.js";
import { controlsOf, sceneOf, withNumber } from "./inputs.js";
import { linkOf } from "./link.js";
import { Look } from "./look.js";
import { Numbers, shownUnits, splitName, unitText } from "./numbers.js";
import { inSpace, paint, pictures } from "./draw.js";
import { Plot } from "./plot.js";
import { defaults, endFrom, settingsFrom, startFrom } from "./settings.js";
import { csvOf, readCsv, valueAt } from "./table.js";
import { Words } from "./words.js";

// Faster turns are not followed by the eye, and may not flash.
const fastestTurn = 2 * Math.PI * 3;
const idleMs = 500;
const maxPanels = 4;

// The kind of film that the browser records; undefined: none.
const filmType = () => globalThis.MediaRecorder && HTMLCanvasElement.prototype.captureStream &&
  ["video/webm;codecs=vp9", "video/webm", "video/mp4"]
    .find((one) => MediaRecorder.isTypeSupported(one));

let opening = null;
const sharedEngine = () => opening ??= openEngine(rotdynParts.core);

// Columns that belong on one axis: the same name but for an axis or a number; all energies.
const panelOf = (name) => {
  const { stem, unit } = splitName(name);
  if (unit === "J" && /energy$/.test(stem)) return "energy";
  return stem.replace(/^rotor_\d+_/, "rotor_").replace(/^(mass|tension|height|theta|omega)_\d+/, "$1")
    .replace(/^q[wxyz]$/, "attitude").replace(/^omega_[xyz]$/, "omega_body")
    .replace(/^v[xy]$/, "v_xy").replace(/^[xy]$/, (one) => one === "y" ? "x" : one)
    .replace(/_[xyz]$/, "") + (unit ? ` (${unit})` : "");
};

class Lab extends HTMLElement {
  static observedAttributes = ["scene", "settings", "lang"];

  // Another language leaves what was set, and the time.
  attributeChangedCallback(name) {
    if (!this.root) return;
    const { tree, end, t, data } = this;
    this.open(name === "lang" && this.run ? { tree, end, t, data } : {});
  }

  connectedCallback() {
    if (this.root) return this.watch.observe(this.box);
    this.root = this.attachShadow({ mode: "open" });
    const style = el("style");
    style.textContent = rotdynParts.css;
    this.box = el("div", { class: "lab" });
    this.root.append(style, this.box);
    this.view = { beside: -Math.PI / 5, above: Math.PI / 8 };
    this.shown = { rad: "rad", "rad/s": "rad/s" };
    this.watch = new ResizeObserver(() => this.resize());
    this.watch.observe(this.box);
    this.open();
  }

  disconnectedCallback() {
    this.stop();
    clearTimeout(this.timer);
    this.watch.disconnect();
  }

  // The core, then the first picture. Without the core: what the recording has.
  async open(now = {}) {
    const turn = this.turn = (this.turn ?? 0) + 1;
    this.words = new Words(this.getAttribute("lang") || this.closest("[lang]")?.lang ||
      document.documentElement.lang || navigator.language);
    this.numbers = new Numbers(this.words.language);
    let settings = {};
    try {
      settings = JSON.parse(this.getAttribute("settings") || "{}") ?? {};
    } catch { /* as without settings */ }
    this.settings = settingsFrom(settings);
    this.recording = this.settings.recording ?? null;
    if (!this.recording) {
      try {
        this.engine = await sharedEngine();
      } catch {
        this.box.replaceChildren(el("p", { class: "refused" }, this.words.say("no_core")));
        return;
      }
    }
    if (turn !== this.turn) return;
    this.build(now);
    this.dispatchEvent(new CustomEvent("rotdyn-ready", { bubbles: true }));
  }

  say(key, values, other) { return this.words.say(key, values, other); }

  // ---- the parts of the page ----

  // `now`: what was set since, of { tree, end, t, data }.
  build(now = {}) {
    this.stop();
    const text = this.getAttribute("scene") ?? "";
    this.refusal = el("p", { class: "refused", role: "status", hidden: true });
    this.tree = this.run = this.text = null;
    this.controls = [];
    this.undo = null;
    let tree = null;
    try { tree = JSON.parse(text); } catch { /* the core says it */ }
    if (!this.recording) {
      const said = this.engine.read(text);
      if (said.status !== 0) {
        this.box.replaceChildren(this.refusal);
        this.refuse(said);
        this.dispatchEvent(new CustomEvent("rotdyn-refused", { bubbles: true, detail: said }));
        return;
      }
      this.about = said;
      this.start = startFrom(this.settings, said.start_s);
    } else {
      this.about = this.recording.said;
      this.start = this.recording.time[0];
    }
    this.end = endFrom(now.end ?? this.settings.end, this.start);
    this.tree = now.tree ?? tree;
    if (!this.recording) this.controls = this.findControls();
    this.t = now.t ?? this.start;
    this.plots = new Map();
    this.data = now.data ?? null;
    this.hidden = false;
    const heading = el(this.hasAttribute("page") ? "h2" : "p", { class: "title", id: "title" },
      this.settings.title || this.sceneTitle());
    this.summary = el("p", { class: "summary" });
    this.live = el("p", { class: "live", role: "status" });
    this.box.replaceChildren(
      el("section", { class: "layout", "aria-labelledby": "title" },
        el("div", { class: "head" }, heading, this.summary, this.refusal,
          this.recording ? el("p", { class: "note" }, this.say("recording")) : null),
        this.buildInputs(),
        this.buildPicture(), this.buildCurves(), this.buildModel(), this.buildTake()),
      this.live);
    this.box.classList.add("void");
    this.solve();
    this.later();
  }

  // What the core takes: of the inputs that are not set, those that it accepts another value of.
  findControls() {
    const takes = (one) => one.set || this.engine.read(JSON.stringify(
      withNumber(this.tree, one.path, (one.low + 3 * one.high) / 4))).status === 0;
    const controls = controlsOf(this.tree, this.engine.catalogue).filter(takes);
    this.engine.read(JSON.stringify(this.tree));
    return controls;
  }

  sceneTitle() {
    const name = this.recording?.said.constructor ?? sceneOf(this.tree)[0] ?? "";
    return this.say(`scene.${name}`, {}, name.replaceAll("_", " "));
  }

  // "omega0_rad_per_s" in words, with what it belongs to.
  nameOf(control) {
    const { stem } = splitName(control.name);
    const plain = this.say(`name.${control.name}`, {},
      this.say(`name.${stem}`, {}, stem.replaceAll("_", " ")));
    const item = control.item === null ? "" :
      control.item < 3 && control.path.at(-2) === "omega0_rad_per_s" && this.vectors() ?
        ` ${"xyz"[control.item]}` : ` ${control.item + 1}`;
    // "resistance 2": its words, and which.
    const [, part, which] = /^(.*?)( \d+)?$/.exec(control.group);
    const group = part ? `, ${this.say(`part.${part}`, {}, part.replaceAll("_", " "))}${
      which ?? ""}` : "";
    return plain + item + group;
  }

  vectors() { return inSpace(this.constraint()); }

  buildInputs() {
    if (this.recording) return null;
    const wanted = this.settings.inputs;
    const main = this.controls.filter((one) =>
      wanted ? wanted.includes(one.path.slice(1).join(".")) : one.set);
    const more = this.controls.filter((one) => !main.includes(one));
    const rows = (list) => list.map((one) => this.buildControl(one));
    const duration = { name: "end_s", words: "", unit: "s", path: null, group: "", item: null,
      value: this.end, low: this.start, high: null, step: null, end: true };
    return el("form", { class: "inputs", onsubmit: (event) => event.preventDefault() },
      el("fieldset", {}, el("legend", {}, this.say("inputs")), ...rows(main),
        this.buildEnd(duration),
        this.wrong = el("p", { class: "refused", role: "alert", hidden: true })),
      more.length ? el("details", {}, el("summary", {}, this.say("more_inputs")), ...rows(more))
        : null,
      el("div", { class: "bar" },
        el("button", { type: "button", onclick: () => this.build() }, this.say("reset")),
        this.buildUnits("rad", "angle_unit"), this.buildUnits("rad/s", "rate_unit")));
  }

  buildUnits(unit, key) {
    const choice = el("select", { id: `unit-${key}`, onchange: () => {
      this.shown[unit] = choice.value;
      this.show();
      this.later();
    } }, ...Object.keys(shownUnits[unit]).map((one) =>
      el("option", { value: one, selected: one === this.shown[unit] },
        one === "turns" ? this.say("turns") : one)));
    return el("span", { class: "pair" }, el("label", { for: choice.id }, this.say(key)), choice);
  }

  buildControl(control) {
    const id = `c-${control.path.join("-")}`, name = this.nameOf(control);
    const own = this.settings.ranges?.[control.path.slice(1).join(".")];
    if (own) [control.low, control.high, control.step] = own;
    const slider = el("input", { type: "range", id, min: control.low, max: control.high,
      step: control.step, value: Number.isFinite(control.value) ? control.value : control.high });
    const field = el("input", { type: "text", inputmode: "decimal", id: `${id}-n`, size: 8,
      "aria-label": `${name}${control.unit ? `, ${control.unit}` : ""}`,
      value: this.plain(control.value), title: control.words });
    control.slider = slider;
    control.field = field;
    const set = (value, from) => {
      field.value = this.plain(value);
      if (from !== slider && Number.isFinite(value)) slider.value = value;
      this.said(control, value);
      this.change(control, value);
    };
    slider.addEventListener("input", () => set(Number(slider.value), slider));
    slider.addEventListener("keydown", (event) => {
      const by = { PageUp: 10, PageDown: -10 }[event.key];
      if (!by) return;
      event.preventDefault();
      const value = Number(slider.value) + by * control.step;
      slider.value = value;
      set(Number(slider.value), slider);
    });
    field.addEventListener("change", () => {
      const value = this.parse(field.value);
      if (value === null) {
        this.wrongInput(this.say("no_number", { name }));
        field.setAttribute("aria-invalid", "true");
      } else {
        set(value, field);
      }
    });
    this.said(control, control.value);
    return el("div", { class: "control" },
      el("label", { for: id, title: control.words }, name), slider, field,
      el("span", { class: "unit" }, control.unit));
  }

  buildEnd(duration) {
    const field = el("input", { type: "text", inputmode: "decimal", id: "end", size: 8,
      value: this.plain(duration.value) });
    field.addEventListener("change", () => {
      const value = this.parse(field.value);
      if (value === null || !(value > this.start) || !Number.isFinite(value)) {
        this.wrongInput(this.say("no_end"));
        return;
      }
      const before = this.end;
      this.end = value;
      if (this.solve()) this.wrongInput("");
      else this.end = before;
      this.later();
    });
    return el("div", { class: "control" }, el("label", { for: "end" }, this.say("end")),
      el("span"), field, el("span", { class: "unit" }, "s"));
  }

  plain(value) {
    if (!Number.isFinite(value)) return value > 0 ? "Inf" : "-Inf";
    const text = String(value);
    return this.words.comma ? text.replace(".", ",") : text;
  }

  parse(text) {
    const plain = text.trim().replace(",", ".").replaceAll("−", "-");
    const limit = /^([-+]?)(inf|infinity|∞)$/i.exec(plain);
    if (limit) return limit[1] === "-" ? -Infinity : Infinity;
    // Neither hexadecimal digits nor what exceeds a double.
    const value = /^[-+.\de]+$/i.test(plain) ? Number(plain) : NaN;
    return Number.isFinite(value) ? value : null;
  }

  // The value of a slider with its unit in words.
  said(control, value) {
    const unit = this.say(`unit.${control.unit}`, {}, control.unit);
    control.slider.setAttribute("aria-valuetext", `${this.plain(value)} ${unit}`.trim());
    control.field.removeAttribute("aria-invalid");
  }

  change(control, value) {
    const before = this.tree;
    this.tree = withNumber(this.tree, control.path, value);
    if (this.solve()) {
      this.wrongInput("");
    } else {
      this.tree = before;
      control.field.setAttribute("aria-invalid", "true");
    }
    this.later();
  }

  wrongInput(text) {
    if (!this.wrong) return;
    this.wrong.hidden = text === "";
    this.wrong.textContent = text;
  }

  // ---- the picture and its time ----

  buildPicture() {
    const draws = pictures[this.constraint()];
    this.picture = svg("svg", { role: "img", class: "picture", "aria-labelledby": "alt" });
    this.clock = el("output", { class: "clock", "aria-live": "off" });
    this.slow = el("span", { class: "slow" });
    const button = (key, act, more = {}) =>
      el("button", { type: "button", onclick: act, ...more }, this.say(key));
    this.playing = button("play", () => this.toggle());
    this.scrub = el("input", { type: "range", id: "time", min: 0, max: 1, step: 1, value: 0,
      oninput: () => this.goto(this.time(Number(this.scrub.value))) });
    this.scrub.addEventListener("keydown", (event) => {
      const by = { PageUp: 10, PageDown: -10 }[event.key];
      if (!by) return;
      event.preventDefault();
      this.step(by);
    });
    this.speed = el("select", { id: "speed" }, ...[0.1, 0.2, 0.5, 1, 2, 5, 10].map((one) =>
      el("option", { value: one, selected: one === 1 }, `× ${this.plain(one)}`)));
    this.nextEvent = button("next_event", () => this.toEvent());
    const turn = (beside, above) => () => {
      if (beside === null) Object.assign(this.view, { beside: 0, above });
      else {
        this.view.beside += beside;
        this.view.above = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, this.view.above + above));
      }
      this.paint();
    };
    const space = inSpace(this.constraint());
    const views = space ? el("div", { class: "bar", role: "group", "aria-label": this.say("view") },
      button("turn_left", turn(-0.2, 0)), button("turn_right", turn(0.2, 0)),
      button("turn_up", turn(0, 0.15)), button("turn_down", turn(0, -0.15)),
      button("from_side", turn(null, 0)), button("from_above", turn(null, Math.PI / 2))) : null;
    this.drawn = Boolean(draws);
    const stage = el("div", { class: "stage", tabindex: space ? "0" : false,
      role: space ? "group" : false, "aria-label": space ? this.say("view_keys") : false },
      this.picture);
    if (space) {
      stage.addEventListener("keydown", (event) => {
        const by = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1],
          ArrowDown: [0, -0.1] }[event.key];
        if (!by || event.target !== stage) return;
        event.preventDefault();
        turn(...by)();
      });
    }
    return el("div", { class: "motion", role: "group", "aria-label": this.say("motion") },
      this.drawn ? stage : null,
      el("p", { class: "alt", id: "alt" }, this.say(`picture.${this.constraint()}`, {}, "")),
      views,
      el("div", { class: "bar" }, this.playing, button("back", () => this.step(-1)),
        button("forward", () => this.step(1)), this.nextEvent,
        el("span", { class: "pair" }, el("label", { for: "speed" }, this.say("speed")),
          this.speed)),
      el("div", { class: "control time" }, el("label", { for: "time" }, this.say("time")),
        this.scrub, this.clock),
      this.slow,
      el("p", { class: "now" }));
  }

  // Not of the engine, which other labs use, too.
  constraint() { return this.about.constraint; }

  time(i) { return this.run.time[Math.max(0, Math.min(this.run.time.length - 1, i))]; }

  // The row next to the time.
  at() {
    const n = this.run.time.length, [from, to] = [this.run.time[0], this.run.time[n - 1]];
    const near = Math.round((this.t - from) / (to - from || 1) * (n - 1));
    return Math.max(0, Math.min(n - 1, near));
  }

  goto(t) {
    const [from, to] = [this.run.time[0], this.run.time.at(-1)];
    this.t = Math.max(from, Math.min(to, t));
    this.paint();
  }

  step(by) {
    this.stop();
    this.goto(this.time(this.at() + by));
  }

  toEvent() {
    this.stop();
    const next = this.run.report.events.find((one) => one.time_s > this.t * (1 + 1e-12) + 1e-12);
    this.goto(next ? next.time_s : this.run.time.at(-1));
    if (next) this.announce(this.eventText(next));
  }

  eventText(event) {
    const place = event.place > 0 ? ` ${event.place}` : "";
    return this.say("event", {
      name: this.say(`event.${event.name}`, {}, event.name) + place,
      time: this.numbers.show(event.time_s, this.run.report.error * Math.abs(event.time_s))
    });
  }

  // Seconds of the motion in a second of the film.
  rate() {
    const length = this.run.time.at(-1) - this.run.time[0];
    let rate = length >= 2 && length <= 30 ? 1 : length / 8;
    const rates = Object.keys(this.run.columns).filter((name) => splitName(name).unit === "rad/s");
    const largest = this.look.largest(rates);
    rate *= Number(this.speed.value);
    return largest * rate > fastestTurn ? fastestTurn / largest : rate;
  }

  rateText() {
    const rate = this.rate();
    if (Math.abs(rate - 1) < 1e-9) return "";
    const factor = rate < 1 ? 1 / rate : rate;
    return this.say(rate < 1 ? "slower" : "faster", { factor: this.numbers.show(factor,
      factor / 200) });
  }

  toggle() { if (this.frame) this.stop(); else this.play(); }

  play() {
    if (this.t >= this.run.time.at(-1)) this.goto(this.run.time[0]);
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.playing.textContent = this.say("pause");
    let last = null, since = 0;
    const tick = (now) => {
      const by = last === null ? 0 : Math.min(now - last, 250) / 1000;
      last = now;
      since += by;
      // Reduced motion: two pictures a second.
      if (!still || since >= 0.5) {
        this.t += since * this.rate();
        since = 0;
        if (this.t >= this.run.time.at(-1)) {
          this.goto(this.run.time.at(-1));
          this.stop();
          return;
        }
        this.paint();
      }
      this.frame = requestAnimationFrame(tick);
    };
    this.frame = requestAnimationFrame(tick);
  }

  stop() {
    if (this.frame) cancelAnimationFrame(this.frame);
    this.frame = null;
    if (this.playing) this.playing.textContent = this.say("play");
  }

  paint() {
    if (!this.run) return;
    const i = this.at(), t = this.t;
    this.scrub.max = this.run.time.length - 1;
    this.scrub.value = i;
    const time = `${this.numbers.show(t, (this.run.time.at(-1) - this.run.time[0]) / 2000)} s`;
    this.clock.textContent = time;
    this.scrub.setAttribute("aria-valuetext", `${time.slice(0, -2)} ${this.say("unit.s")}`);
    for (const plot of this.plots.values()) plot.move(t);
    const draw = pictures[this.constraint()]?.(this.look);
    if (draw) {
      const width = Math.max(160, Math.min(this.stageWidth ?? 320, 460));
      const drawn = draw(this.look, this.look.row(i));
      const [x0, x1, y0, y1] = drawn.box;
      paint(this.picture, drawn, width, Math.min(width, width * (y1 - y0) / (x1 - x0)));
    }
  }

  resize() {
    const width = this.box.clientWidth;
    if (!this.run || width === this.boxWidth) return;
    this.boxWidth = width;
    this.measure();
    this.show();
  }

  measure() {
    this.stageWidth = this.picture.parentElement?.clientWidth || 320;
    this.plotWidth = this.curves.clientWidth || 320;
  }

  // ---- curves ----

  buildCurves() {
    this.curves = el("div", { class: "plots" });
    this.choice = el("fieldset", { class: "choice" });
    this.panelsKey = null;
    return el("div", { class: "curves", role: "group", "aria-label": this.say("curves") },
      this.choice, this.buildPredict(), this.curves);
  }

  // Guesses at three times, before the curves are seen; then how far each was off.
  buildPredict() {
    const fields = [0.25, 0.5, 1].map((part, k) => ({ part, box: el("input", { type: "text",
      inputmode: "decimal", size: 8, id: `guess-${k}` }), label: el("label", { for: `guess-${k}` }) }));
    const verdict = el("p", { role: "status" });
    const head = el("p");
    const line = () => [...this.plots.values()][0]?.lines[0];
    const time = (part) => this.start + part * (this.end - this.start);
    const hide = (hidden) => {
      this.hidden = hidden;
      this.show();
      this.later();
    };
    const box = el("details", { class: "predict", ontoggle: () => {
      const of = line();
      if (!box.open || !of) return hide(false);
      head.textContent = this.say("predict_what", { label: of.label });
      for (const { part, label } of fields) {
        label.textContent = this.say("predict_at", { time: this.numbers.show(time(part)) });
      }
      verdict.textContent = "";
      return hide(true);
    } }, el("summary", {}, this.say("predict")), head,
    ...fields.map((one) => el("span", { class: "pair" }, one.label, one.box)),
    el("button", { type: "button", onclick: () => {
      const of = line();
      if (!of) return;
      hide(false);
      verdict.textContent = fields.map(({ part, box: field }) => {
        const guess = this.parse(field.value), at = time(part);
        if (guess === null) return "";
        const value = valueAt(this.run.time, of.values, at);
        return this.say("predicted", { time: this.numbers.show(at),
          guess: this.numbers.show(guess), value: this.numbers.show(value, of.error),
          off: this.numbers.show(guess - value, Math.max(of.error, Math.abs(guess - value) / 2000)) });
      }).filter(Boolean).join(" ") || this.say("no_guess");
    } }, this.say("compare")), verdict);
    return box;
  }

  // Panels: the names of their columns. The state and the energies are shown first.
  panels() {
    const groups = new Map();
    for (const one of this.run.said.columns) {
      if (one.flag) continue;
      const key = panelOf(one.name);
      if (!groups.has(key)) groups.set(key, []);
      groups.get(key).push(one);
    }
    return groups;
  }

  setPanels() {
    const groups = this.panels(), key = [...groups.keys()].join("|");
    if (key === this.panelsKey) return;
    this.panelsKey = key;
    const first = [...groups].filter(([name, list]) => (list[0].measure >= 0 || name === "energy") &&
      name !== "attitude").map(([name]) => name).slice(0, maxPanels);
    this.open_ = new Set(first.length ? first : [[...groups.keys()][0]]);
    this.choice.replaceChildren(el("legend", {}, this.say("which_curves")),
      ...[...groups].map(([name, list], i) => {
        const box = el("input", { type: "checkbox", id: `p-${i}`, checked: this.open_.has(name),
          onchange: () => {
            if (box.checked) this.open_.add(name); else this.open_.delete(name);
            this.show();
            this.later();
          } });
        return el("span", { class: "pair" }, box,
          el("label", { for: box.id }, this.panelTitle(name, list)));
      }));
    this.plots.clear();
    this.curves.replaceChildren();
  }

  columnTitle(name) {
    const { stem } = splitName(name);
    const number = /^rotor_(\d+)_(.*)$/.exec(stem);
    if (number) return `${this.say(`name.${number[2]}`, {}, number[2])}, ${
      this.say("rotor")} ${number[1]}`;
    const axis = /^(.*)_([xyz]|\d)$/.exec(stem) ?? /^(.*)_(\d)(_.*)?$/.exec(stem);
    const known = this.say(`name.${stem}`, {}, "");
    if (known) return known;
    if (axis) {
      const base = axis[1] + (axis[3] ?? "");
      return `${this.say(`name.${base}`, {}, base.replaceAll("_", " "))} ${axis[2]}`;
    }
    return stem.replaceAll("_", " ");
  }

  panelTitle(name, list) {
    if (name === "energy") return this.say("name.energy");
    if (list.length === 1) return this.columnTitle(list[0].name);
    const stem = name.replace(/ \(.*$/, "");
    return this.say(`name.${stem}`, {}, stem.replaceAll("_", " "));
  }

  // The unit shown of a column, and the factor from SI.
  unitOf(name) {
    const { unit } = splitName(name);
    if (!(unit in shownUnits)) return { unit, factor: 1 };
    const shown = this.shown[unit];
    return { unit: shown === "turns" ? this.say("turns") : shown, factor: shownUnits[unit][shown] };
  }

  // The absolute error of a column.
  errorOf(column) {
    const { report, columns } = this.run;
    if (column.measure >= 0) return report.measures[column.measure]?.error ?? 0;
    return report.error * this.look.largest([column.name]) || 0;
  }

  // The lines of a column: one for each of several rows.
  linesOf(column) {
    const per = this.run.said.rows_per_time, values = this.run.columns[column.name];
    const { factor } = this.unitOf(column.name);
    const index = this.run.said.index;
    return Array.from({ length: per }, (_, k) => ({
      label: per > 1 ? `${this.columnTitle(column.name)}, ${
        this.say(`name.${index}`, {}, index)} ${k + 1}` : this.columnTitle(column.name),
      values: Float64Array.from({ length: this.run.time.length }, (_, i) =>
        values[i * per + k] * factor),
      error: this.errorOf(column) * factor,
      dots: this.data && this.data.columns[column.name] && per === 1 ? {
        time: this.data.time, values: this.data.columns[column.name].map((x) => x * factor)
      } : null
    }));
  }

  show() {
    if (!this.run) return;
    this.setPanels();
    const groups = this.panels(), { time } = this.run;
    for (const [name, list] of groups) {
      let plot = this.plots.get(name);
      if (!this.open_.has(name)) {
        plot?.figure.remove();
        this.plots.delete(name);
        continue;
      }
      if (!plot) {
        plot = new Plot((t) => this.goto(t));
        plot.caption = el("figcaption");
        plot.words = el("p", { class: "alt" });
        plot.figure = el("figure", {}, plot.caption, plot.root, plot.words);
        this.plots.set(name, plot);
        const place = [...groups.keys()].filter((one) => this.plots.has(one)).indexOf(name);
        this.curves.insertBefore(plot.figure, this.curves.children[place] ?? null);
      }
      const { unit } = this.unitOf(list[0].name);
      plot.lines = list.flatMap((column) => this.linesOf(column));
      const title = this.panelTitle(name, list);
      plot.caption.textContent = unit ? `${title} (${unit})` : title;
      plot.picture.setAttribute("aria-label", title);
      plot.figure.classList.toggle("hidden-curves", this.hidden);
      plot.draw(time, plot.lines, this.plotWidth ?? 320, this.numbers, this.say("time_axis"));
      this.plots.set(name, plot);
    }
    this.slow.textContent = this.rateText();
    this.paint();
  }

  lineText(line, unit) {
    const { time } = this.run, { values, error } = line;
    let low = 0, high = 0;
    values.forEach((x, i) => {
      if (x < values[low]) low = i;
      if (x > values[high]) high = i;
    });
    const show = (x) => `${this.numbers.show(x, error)}${unit ? ` ${unit}` : ""}`;
    const when = (i) => this.numbers.show(time[i], (time.at(-1) - time[0]) / 1000);
    const label = line.label.charAt(0).toLocaleUpperCase(this.words.language) + line.label.slice(1);
    return this.say("line", {
      label, first: show(values[0]), last: show(values.at(-1)),
      least: show(values[low]), least_time: when(low), most: show(values[high]),
      most_time: when(high)
    });
  }

  // ---- solving ----

  refuse(said) {
    const name = said.input ? this.say(`name.${splitName(said.input).stem}`, {}, said.input) : "";
    const text = this.say(said.input ? "refused_input" : "refused", {
      name: said.input ? `${name} (${said.input})` : "",
      reason: this.words.core(said.reason || said.status_text)
    });
    this.refusal.textContent = text;
    this.refusal.hidden = false;
    return text;
  }

  solve() {
    if (this.recording) {
      const { time, columns, said, report } = this.recording;
      const numbers = (list) => Float64Array.from(list, (x) => x ?? NaN);
      this.run = { said, report, time: numbers(time), columns: Object.fromEntries(
        Object.entries(columns).map(([name, list]) => [name, numbers(list)])) };
    } else {
      const text = JSON.stringify(this.tree);
      const run = this.engine.run(text, { start: this.start, end: this.end,
        rows: this.settings.rows, accuracy: this.settings.accuracy, steps: this.settings.steps,
        model: this.settings.model ?? "" });
      const bad = run.said.status !== 0 ? run.said : !run.columns ? run.report : null;
      if (bad) {
        const text = this.refuse(bad);
        this.refusal.hidden = Boolean(this.run);
        if (this.run) this.wrongInput(text);
        return false;
      }
      this.text = text;
      this.run = run;
    }
    this.box.classList.remove("void");
    this.look = new Look(this.tree ?? {}, this.run, this.view);
    if (!this.plotWidth) this.measure();
    this.refusal.hidden = this.run.report.status === 0;
    if (this.run.report.status !== 0) {
      this.refusal.textContent = this.say("stopped", {
        time: this.numbers.show(this.run.report.time_s), rows: this.run.report.rows_done,
        reason: this.words.core(this.run.report.status_text)
      });
    }
    this.t = Math.max(this.run.time[0], Math.min(this.t, this.run.time.at(-1)));
    this.show();
    this.showModel();
    return true;
  }

  // ---- model, error, audit ----

  buildModel() {
    this.modelText = el("p", { class: "model" });
    this.errorText = el("p");
    this.events = el("ul", { class: "events" });
    this.audit = el("div", { class: "audit" });
    this.models = el("div");
    return el("div", { class: "about", role: "group", "aria-label": this.say("model") },
      el("p", { class: "part" }, this.say("model")), this.modelText, this.errorText,
      el("p", { class: "part" }, this.say("events")), this.events,
      el("p", { class: "part" }, this.say("audit")), this.audit,
      this.recording ? null :
        el("details", {}, el("summary", {}, this.say("all_models")), this.models));
  }

  showModel() {
    const { report } = this.run;
    const why = this.recording?.why ?? this.engine?.catalogue.models[report.model] ?? "";
    this.modelText.textContent = this.say("model_is", {
      model: report.model ?? "–", why: this.words.core(why)
    }) + (report.reason ?
      ` ${this.say("leaves_out", { reason: this.words.core(report.reason) })}` : "");
    this.errorText.textContent = this.say(report.error_is_bound ? "error_bound" : "error_estimate",
      { error: this.numbers.error(report.error) });
    const events = report.events ?? [];
    this.nextEvent.disabled = false;
    this.nextEvent.setAttribute("aria-disabled", String(events.length === 0));
    this.events.replaceChildren(...(events.length ? events.slice(0, 12).map((one) =>
      el("li", {}, this.eventText(one))) : [el("li", {}, this.say("no_events"))]),
    ...(report.n_events > 12 ? [el("li", {}, this.say("more_events",
      { n: report.n_events - 12 }))] : []));
  }

  showAudit(list) {
    this.audit.replaceChildren(...list.map((one) => {
      const size = Math.max(Math.abs(one.explained ?? 0), 0);
      const show = (x) => `${this.numbers.show(x, size)} ${unitText(one.unit)}`.trim();
      const quantity = this.columnTitle(one.quantity);
      const verdict = one.balanced === 1 ? "balanced" : one.balanced === 0 ? "not_balanced" :
        "unknown_balance";
      const largest = Math.max(...one.terms.map((term) => Math.abs(term.value)), 1e-300);
      const terms = one.terms.filter((term) => term.value !== 0 || one.terms.length < 4);
      return el("div", { class: "balance" },
        el("p", {}, this.say("balance", { quantity, change: show(one.change),
          supplied: show(one.supplied), dissipated: show(one.dissipated) }), " ",
        this.say(verdict, { residual: this.numbers.error(Math.abs(one.residual)),
          explained: this.numbers.error(one.explained), unit: unitText(one.unit) })),
        el("ul", { class: "bars" }, ...terms.map((term) => {
          const bar = el("span", { class: `bar-${term.role}`, "aria-hidden": "true" });
          bar.style.width = `${(100 * Math.abs(term.value) / largest).toFixed(1)}%`;
          return el("li", {}, el("span", {}, `${this.words.core(term.words)}: ${show(term.value)}`), bar);
        })));
    }));
  }

  showModels(list) {
    const head = ["model", "applies", "promise", "cost", "why"].map((key) =>
      el("th", { scope: "col" }, this.say(`models.${key}`)));
    this.models.replaceChildren(el("div", { class: "wide", tabindex: "0", role: "group",
      "aria-label": this.say("all_models") },
    el("table", {}, el("thead", {}, el("tr", {}, ...head)),
      el("tbody", {}, ...list.map((one) => el("tr", {
        class: one.model === this.run.report.model ? "chosen" : false
      },
      el("th", { scope: "row" }, one.model),
      el("td", {}, this.say(one.applies ? "yes" : "no")),
      el("td", {}, one.error === null ? "–" : this.numbers.error(one.error)),
      el("td", {}, one.cost_s === null ? "–" : `${this.numbers.error(one.cost_s)} s`),
      el("td", {}, this.words.core(one.reason || this.engine.catalogue.models[one.model] || ""))))))));
  }

  // ---- what can be taken away ----

  buildTake() {
    this.code = el("textarea", { id: "code", readonly: true, rows: 8, spellcheck: "false" });
    this.link = el("input", { id: "link", type: "text", readonly: true });
    this.linkNote = el("p", { class: "note", hidden: true });
    this.rows = el("div", { class: "wide", tabindex: "0", role: "group",
      "aria-label": this.say("table") });
    this.tables = el("details", { ontoggle: () => this.showTable() },
      el("summary", {}, this.say("table")), this.rows);
    this.dataNote = el("p", { class: "note", role: "status" });
    this.residuals = el("div");
    const button = (key, act) =>
      el("button", { type: "button", onclick: act }, this.say(key));
    const copy = (field) => async () => {
      field.select();
      try {
        await navigator.clipboard.writeText(field.value);
        this.announce(this.say("copied"));
      } catch {
        this.announce(this.say("copy_by_hand"));
      }
    };
    const file = el("input", { type: "file", id: "data", accept: ".csv,.txt,text/csv",
      onchange: async () => { if (file.files[0]) this.useData(await file.files[0].text()); } });
    this.film = this.drawn && filmType() ? button("save_film", () => this.saveFilm()) : null;
    return el("div", { class: "take", role: "group", "aria-label": this.say("take") },
      el("label", { for: "code", class: "part" }, this.say("code")), this.code,
      el("div", { class: "bar" }, button("copy_code", copy(this.code))),
      this.recording ? null : el("label", { for: "link", class: "part" }, this.say("link")),
      this.recording ? null : this.link, this.linkNote,
      el("div", { class: "bar" },
        this.recording ? null : button("copy_link", copy(this.link)),
        button("save_csv", () => this.saveCsv()),
        button("save_svg", () => this.saveSvg()), button("save_png", () => this.savePng()),
        this.film,
        rotdynParts.page() ? button("save_lab", () => this.saveLab()) : null),
      el("p", { class: "pair" }, el("label", { for: "data" }, this.say("data")), file),
      this.dataNote, this.residuals, this.tables);
  }

  codeText() {
    if (this.recording) return this.recording.code ?? "";
    const made = this.engine.code(this.text);
    const scene = made ? `scene <- ${made}` :
      `scene <- read_scene(r"---(${this.text})---")`;
    const { rows, accuracy } = this.settings;
    const named = this.settings.model ? `, model = "${this.settings.model}"` : "";
    return `library(rotdyn)\n${scene}\nmotion <- trajectory(\n  scene, seq(${this.start}, ${
      this.end}, length.out = ${rows})${accuracy === 1e-9 ? "" : `, accuracy = ${accuracy}`}${
      named}\n)\nmotion\naudit(motion)\n`;
  }

  state() {
    const { title, rows, accuracy, start } = this.settings;
    return {
      scene: this.text, end: this.end, title: title || null, start: start ?? null,
      rows: rows === defaults.rows ? null : rows,
      accuracy: accuracy === defaults.accuracy ? null : accuracy
    };
  }

  download(name, type, text) {
    const address = URL.createObjectURL(new Blob([text], { type }));
    el("a", { href: address, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(address), 1000);
  }

  csv() { return csvOf(this.run, { comma: this.words.comma, index: this.run.said.index }); }
  saveCsv() { this.download("rotdyn.csv", "text/csv;charset=utf-8", this.csv()); }

  // The picture, or without one the first curve, as SVG with the R code as text.
  pictureText() {
    const copy = (this.drawn ? this.picture : [...this.plots.values()][0].picture).cloneNode(true);
    const style = svg("style");
    style.textContent = rotdynParts.ink;
    copy.prepend(svg("title", {}, this.settings.title || this.sceneTitle()),
      svg("desc", {}, this.codeText()), style);
    return new XMLSerializer().serializeToString(copy);
  }

  saveSvg() { this.download("rotdyn.svg", "image/svg+xml", this.pictureText()); }

  // The same in pixels, four for each, on white; on `canvas` if there is one.
  async pixels(canvas) {
    const text = this.pictureText(), image = new Image();
    const address = URL.createObjectURL(new Blob([text], { type: "image/svg+xml" }));
    image.src = address;
    await image.decode();
    canvas ??= el("canvas", { width: 2 * image.width, height: 2 * image.height });
    const pen = canvas.getContext("2d");
    pen.fillStyle = "#fff";
    pen.fillRect(0, 0, canvas.width, canvas.height);
    pen.drawImage(image, 0, 0, canvas.width, canvas.height);
    URL.revokeObjectURL(address);
    return canvas;
  }

  async savePng() {
    (await this.pixels()).toBlob((blob) => this.download("rotdyn.png", "image/png", blob));
  }

  // A film of the whole motion, at the speed of playing; the button ends it before.
  async saveFilm() {
    if (this.filming) {
      this.filming = false;
      return;
    }
    this.stop();
    this.filming = true;
    this.film.textContent = this.say("filming");
    const kept = this.t;
    try {
      await this.record();
    } finally {
      this.filming = false;
      this.film.textContent = this.say("save_film");
      this.goto(kept);
    }
  }

  async record() {
    const [from, to] = [this.run.time[0], this.run.time.at(-1)];
    const nextFrame = () => new Promise((done) => requestAnimationFrame(done));
    this.goto(from);
    const canvas = await this.pixels(), parts = [];
    const recorder = new MediaRecorder(canvas.captureStream(25), { mimeType: filmType() });
    recorder.ondataavailable = ({ data }) => parts.push(data);
    const ended = new Promise((done) => { recorder.onstop = done; });
    recorder.start();
    const began = await nextFrame();
    for (let t = from; this.filming && t < to;) {
      t = Math.min(to, from + (await nextFrame() - began) / 1000 * this.rate());
      this.goto(t);
      await this.pixels(canvas);
    }
    // The last picture stays for a quarter of a second.
    await new Promise((done) => setTimeout(done, 250));
    recorder.stop();
    await ended;
    const type = filmType();
    this.download(`rotdyn.${/mp4/.test(type) ? "mp4" : "webm"}`, type, new Blob(parts, { type }));
  }

  saveLab() { this.download("lab.html", "text/html;charset=utf-8", rotdynParts.page(this.state())); }

  // A CSV of one's own: points over the curves, and how far they are off.
  useData(text) {
    try {
      this.data = readCsv(text);
    } catch (error) {
      this.data = null;
      this.dataNote.textContent = this.say(error.message, {}, error.message);
      return;
    }
    this.show();
    this.showResiduals();
  }

  showResiduals() {
    this.residuals.replaceChildren();
    if (!this.data) return;
    const per = this.run.said.rows_per_time, list = [];
    for (const column of this.run.said.columns) {
      const own = this.data.columns[column.name];
      if (!own || per > 1) continue;
      let largest = 0, sum = 0, n = 0;
      own.forEach((x, i) => {
        const off = x - valueAt(this.run.time, this.run.columns[column.name], this.data.time[i]);
        if (!Number.isFinite(off)) return;
        largest = Math.max(largest, Math.abs(off));
        sum += off * off;
        n++;
      });
      if (n) {
        const { unit } = splitName(column.name);
        list.push(el("li", {}, this.say("residual", {
          label: this.columnTitle(column.name), n, largest: this.numbers.show(largest, largest / 500),
          rms: this.numbers.show(Math.sqrt(sum / n), largest / 500), unit
        })));
      }
    }
    this.dataNote.textContent = list.length ? this.say("data_read", { n: this.data.time.length }) :
      this.say("data_no_column");
    this.residuals.append(el("ul", {}, ...list));
  }

  showTable() {
    if (!this.tables.open || !this.run) return;
    const columns = this.run.said.columns, per = this.run.said.rows_per_time;
    const n = this.run.time.length, every = Math.max(1, Math.floor((n - 1) / 20));
    const head = [`${this.say("time")} (s)`, ...(per > 1 ? [this.run.said.index] : []),
      ...columns.map((one) => {
        const { unit } = this.unitOf(one.name);
        return this.columnTitle(one.name) + (unit ? ` (${unit})` : "");
      })];
    const rows = [];
    for (let i = 0; i < n; i += every) {
      for (let k = 0; k < per; k++) {
        rows.push(el("tr", {},
          el("th", { scope: "row" }, this.numbers.show(this.run.time[i])),
          per > 1 ? el("td", {}, String(k + 1)) : null,
          ...columns.map((one) => {
            const { factor } = this.unitOf(one.name);
            const value = this.run.columns[one.name][i * per + k];
            return el("td", {}, one.flag ? (value === 1 ? this.say("yes") : value === 0 ?
              this.say("no") : "–") : this.numbers.show(value * factor,
              this.errorOf(one) * factor));
          })));
      }
    }
    this.rows.replaceChildren(el("table", {}, el("caption", {}, this.say("table_caption")),
      el("thead", {}, el("tr", {}, ...head.map((one) => el("th", { scope: "col" }, one)))),
      el("tbody", {}, ...rows)));
  }

  // ---- what follows half a second after the last change ----

  later() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.settle(), this.settled ? idleMs : 0);
  }

  settle() {
    if (!this.run) return;
    this.settled = true;
    if (this.recording) {
      this.showAudit(this.recording.audit ?? []);
    } else {
      this.solveAgain();
      this.showAudit(this.engine.audit());
      this.showModels(this.engine.models());
      const link = linkOf(document.baseURI, this.state());
      this.link.value = link ?? "";
      // A page on a disk is found there alone.
      const note = link === null ? "link_too_long" : link.startsWith("file:") ? "link_local" : "";
      this.linkNote.hidden = note === "";
      this.linkNote.textContent = note && this.say(note);
    }
    this.code.value = this.codeText();
    this.code.rows = Math.min(16, this.code.value.split("\n").length);
    const sentences = [];
    for (const [name, plot] of this.plots) {
      const { unit } = this.unitOf(this.panels().get(name)[0].name);
      const text = plot.lines.slice(0, 3).map((line) => this.lineText(line, unit)).join(" ");
      plot.words.textContent = this.hidden ? this.say("curves_hidden") : text;
      sentences.push(plot.words.textContent);
    }
    this.summary.textContent = this.say("summary", {
      model: this.run.report.model ?? "–", from: this.numbers.show(this.run.time[0]),
      to: this.numbers.show(this.run.time.at(-1)),
      error: this.numbers.error(this.run.report.error)
    }) + (sentences.length ? ` ${sentences[0]}` : "");
    this.showTable();
    if (this.data) this.showResiduals();
    this.announce(this.summary.textContent);
    this.dispatchEvent(new CustomEvent("rotdyn-settled", { bubbles: true }));
  }

  // Audit and models are of the last run of the engine, which several labs share.
  solveAgain() {
    this.engine.run(this.text, { start: this.start, end: this.end, rows: this.settings.rows,
      accuracy: this.settings.accuracy, steps: this.settings.steps,
      model: this.settings.model ?? "" });
  }

  announce(text) { if (this.live.textContent !== text) this.live.textContent = text; }
}

customElements.define("rotdyn-lab", Lab);

export { Lab };
