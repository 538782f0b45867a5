// Curves as SVG of the width that it has: its letters are as large as those around it. One quantity
// an axis; the names of the lines stand above, in HTML.
import { el, svg } from "./dom.js";
import { roundUp } from "./numbers.js";

// Lines differ by colour, by dash, and by their name at the line.
const lineStyles = [
  ["line-1", ""], ["line-2", "7 3"], ["line-3", "2 3"], ["line-4", "10 3 2 3"],
  ["line-5", "4 2"], ["line-6", "12 4"]
];
const height = 190, left = 64, right = 12, top = 8, bottom = 30;

// Round values between two ends.
const ticksOf = (low, high, wanted) => {
  const step = roundUp((high - low) / wanted);
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) {
    ticks.push(Number((k * step).toPrecision(12)));
  }
  return ticks;
};

const endsOf = (lines) => {
  let low = Infinity, high = -Infinity;
  for (const line of lines) {
    for (const x of line.values) {
      if (x < low) low = x;
      if (x > high) high = x;
    }
  }
  if (!Number.isFinite(low) || !Number.isFinite(high)) return [-1, 1];
  // A line that is still within rounding is drawn level.
  if (high - low <= 1e-9 * Math.max(Math.abs(low), Math.abs(high))) {
    const half = Math.max(Math.abs(low), Math.abs(high)) || 1;
    return [low - half, high + half];
  }
  const more = 0.04 * (high - low);
  return [low - more, high + more];
};

// Points of a path, thinned to two a pixel.
const pathOf = (time, values, x, y) => {
  let text = "", pen = "M";
  const every = Math.max(1, Math.floor(time.length / 1600));
  for (let i = 0; i < time.length; i += every) {
    if (!Number.isFinite(values[i])) { pen = "M"; continue; }
    text += `${pen}${x(time[i]).toFixed(1)} ${y(values[i]).toFixed(1)}`;
    pen = "L";
  }
  return text;
};

class Plot {
  // onTime(t): the time that was pointed at.
  constructor(onTime) {
    this.legend = el("ul", { class: "legend" });
    this.picture = svg("svg", { role: "img", class: "plot" });
    this.cursor = svg("line", { class: "cursor", y1: top, y2: height - bottom });
    this.root = el("div", { class: "plot-box" }, this.legend, this.picture);
    this.picture.addEventListener("pointerdown", (event) => {
      if (!this.x) return;
      const at = event.clientX - this.picture.getBoundingClientRect().left;
      onTime(this.from + (at - left) / (this.width - left - right) * (this.to - this.from));
    });
  }

  // lines: [{ label, values, dots }]; values in the unit shown.
  draw(time, lines, width, numbers, axis) {
    this.width = Math.max(width, 200);
    [this.from, this.to] = [time[0], time[time.length - 1]];
    const [low, high] = endsOf(lines);
    const across = this.width - left - right, up = height - top - bottom;
    this.x = (t) => left + (t - this.from) / (this.to - this.from || 1) * across;
    const y = (v) => top + (high - v) / (high - low) * up;
    const parts = [];
    for (const tick of ticksOf(low, high, 4)) {
      parts.push(svg("line", { class: "grid", x1: left, x2: left + across, y1: y(tick),
        y2: y(tick) }));
      parts.push(svg("text", { class: "tick", x: left - 6, y: y(tick) + 4, "text-anchor": "end" },
        numbers.show(tick, (high - low) / 1e4)));
    }
    for (const tick of ticksOf(this.from, this.to, Math.max(2, Math.floor(across / 90)))) {
      parts.push(svg("line", { class: "grid", x1: this.x(tick), x2: this.x(tick), y1: top,
        y2: top + up }));
      parts.push(svg("text", { class: "tick", x: this.x(tick), y: height - bottom + 16,
        "text-anchor": "middle" }, numbers.show(tick, (this.to - this.from) / 1e4)));
    }
    parts.push(svg("text", { class: "tick", x: left + across, y: height - 2,
      "text-anchor": "end" }, axis));
    lines.forEach((line, i) => {
      const [style, dash] = lineStyles[i % lineStyles.length];
      if (line.dots) {
        line.dots.time.forEach((t, k) => {
          if (t < this.from || t > this.to || !Number.isFinite(line.dots.values[k])) return;
          parts.push(svg("circle", { class: "dot", cx: this.x(t), cy: y(line.dots.values[k]),
            r: 2.5 }));
        });
      }
      parts.push(svg("path", { class: `curve ${style}`, "stroke-dasharray": dash,
        d: pathOf(time, line.values, this.x, y) }));
    });
    this.picture.setAttribute("width", this.width);
    this.picture.setAttribute("height", height);
    this.picture.replaceChildren(...parts, this.cursor);
    this.legend.replaceChildren(...lines.map((line, i) => {
      const [style, dash] = lineStyles[i % lineStyles.length];
      const sample = svg("svg", { width: 34, height: 10, "aria-hidden": "true" },
        svg("path", { class: `curve ${style}`, "stroke-dasharray": dash, d: "M0 5H34" }));
      return el("li", {}, sample, " ", line.label, " ", line.output);
    }));
    this.legend.hidden = false;
  }

  move(t) {
    if (!this.x) return;
    this.cursor.setAttribute("x1", this.x(t));
    this.cursor.setAttribute("x2", this.x(t));
  }
}

export { Plot };
