// What a lab is set to beside its scene, from an attribute, a link or a file of strangers: what is
// no number within its limits is as none given.
const defaults = { end: 10, rows: 401, accuracy: 1e-9, steps: 5e4 };
const limits = { rows: [2, 4001], accuracy: [1e-14, 1e-2] };

function settingsFrom(given) {
  const settings = { ...defaults, ...given };
  for (const [name, [low, high]] of Object.entries(limits)) {
    const value = Number(settings[name]);
    settings[name] = value >= low && value <= high ? value : defaults[name];
  }
  settings.rows = Math.round(settings.rows);
  return settings;
}

// The start that is set, else that of the scene.
function startFrom(settings, start) {
  const own = Number(settings.start ?? start);
  return Number.isFinite(own) ? own : start;
}

// The end, later than the start: 10 s, or what is more than its rounding.
function endFrom(end, start) {
  const own = Number(end);
  return Number.isFinite(own) && own > start ? own :
    start + Math.max(defaults.end, 1e-9 * Math.abs(start));
}

export { defaults, endFrom, settingsFrom, startFrom };
