// The controls of a scene: its numbers, found in its text by the core's list of inputs.
import { roundUp, unitText } from "./numbers.js";

const isObject = (x) => typeof x === "object" && x !== null && !Array.isArray(x);
const asNumber = (x) => typeof x === "number" ? x :
  x === "Inf" ? Infinity : x === "-Inf" ? -Infinity : null;

// The scene of a text: [constructor, inputs].
const sceneOf = (tree) => Object.entries(tree).find(([key]) => key !== "scene_format") ?? [];

// Ends of a slider: the domain where it is bounded, else about twice the value, or the largest of
// several values.
const rangeOf = (input, value) => {
  const span = { rad: Math.PI, "rad/s": 10, "N*m": 1, kg: 1, m: 1 }[input.unit] ?? 1;
  const bounded = (x) => Number.isFinite(x) && Math.abs(x) < 1e300;
  let low = bounded(input.low) ? input.low : null, high = bounded(input.high) ? input.high : null;
  // 250 steps of either sign are doubles, too.
  const size = value && Number.isFinite(value) ?
    Math.min(Math.max(roundUp(2 * Math.min(Math.abs(value), 1e307)), 1e-300), 1e307) : span;
  high ??= size;
  low ??= -size;
  const step = roundUp((high - low) / 250);
  if (input.above) low = step;
  else low = Math.ceil(low / step) * step;
  return { low: Number(low.toPrecision(6)), high, step };
};

const controlOf = (input, value, path, group, item, set, largest = value) => ({
  name: input.name, words: input.words, unit: unitText(input.unit), path, group, item, value, set,
  ...rangeOf(input, largest)
});

// Numbers that are set, and those with a default or of a scene that may be set.
function controlsOf(tree, catalogue) {
  const found = [];
  const walk = (constructor, inputs, path, group) => {
    for (const input of catalogue[constructor]?.inputs ?? []) {
      const kinds = input.kinds.split(", "), value = inputs[input.name];
      const at = [...path, input.name];
      if (input.name === "start_s" && group === "") continue;
      const number = asNumber(value);
      if (number !== null) {
        if (kinds.some((one) => ["number", "limit", "numbers"].includes(one))) {
          found.push(controlOf(input, number, at, group, null, true));
        }
      } else if (Array.isArray(value)) {
        const numbers = value.every((one) => typeof one === "number");
        if (kinds.includes("times") || kinds.includes("attitude")) continue;
        value.forEach((one, i) => {
          if (numbers && value.length <= 6) {
            found.push(controlOf(input, one, [...at, i], group, i, true,
              Math.max(...value.map(Math.abs))));
          } else if (isObject(one)) {
            nested(one, [...at, i], input.name, `${input.name} ${i + 1}`);
          }
        });
      } else if (isObject(value)) {
        nested(value, at, input.name, input.name);
      } else if (value === undefined && input.otherwise !== null && kinds.includes("number")) {
        found.push(controlOf(input, input.otherwise, at, group, null, false));
      } else if (value === undefined && input.name === "resistance" && group === "" &&
        !kinds.includes("numbers")) {
        walk("resistance", {}, at, "resistance");
      }
    }
  };
  const nested = (value, path, name, group) => {
    const keys = Object.keys(value);
    if (keys.length === 1 && catalogue[keys[0]]?.kind) {
      walk(keys[0], value[keys[0]], [...path, keys[0]], keys[0]);
    } else if (catalogue[name]) walk(name, value, path, group);
  };
  const [constructor, inputs] = sceneOf(tree);
  if (constructor && isObject(inputs)) walk(constructor, inputs, [constructor], "");
  return found;
}

// The tree with another number at a path; objects on the way are made.
function withNumber(tree, path, value) {
  const copy = structuredClone(tree);
  let at = copy;
  path.slice(0, -1).forEach((key) => { at = at[key] ??= {}; });
  at[path.at(-1)] = Number.isFinite(value) ? value : String(value).replace("inity", "");
  return copy;
}

export { controlsOf, sceneOf, withNumber };
