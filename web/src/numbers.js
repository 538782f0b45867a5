// Numbers and units as text: digits end where the error says, never more than six.

// The unit of a column or an input by the end of its name; the longest that fits counts.
const unitEnds = [
  ["_kg_m2_per_s", "kg m²/s"], ["_rad_per_s2", "rad/s²"], ["_rad_per_s", "rad/s"],
  ["_n_m_per_rad", "N m/rad"], ["_n_m_s2", "N m s²"], ["_n_m_s", "N m s"], ["_n_m", "N m"],
  ["_n_s2_per_m2", "N s²/m²"], ["_n_s_per_m", "N s/m"], ["_m_per_s2", "m/s²"],
  ["_m_per_s", "m/s"], ["_kg_m2", "kg m²"], ["_per_s", "1/s"], ["_rad", "rad"], ["_deg", "°"],
  ["_kg", "kg"], ["_j", "J"], ["_n", "N"], ["_m", "m"], ["_s", "s"]
];

const splitName = (name) => {
  const end = unitEnds.find(([end]) => name.endsWith(end) && name.length > end.length);
  return end ? { stem: name.slice(0, -end[0].length), unit: end[1] } : { stem: name, unit: "" };
};

// "kg*m^2" as it is written.
const unitText = (unit) => !unit || unit === "1" ? "" : unit === "degree" ? "°" :
  unit.replaceAll("*", " ").replaceAll("^2", "²").replaceAll("^j", "ʲ");

// How numbers and units are shown: stored is SI. A factor for each unit.
const shownUnits = {
  rad: { rad: 1, "°": 180 / Math.PI, turns: 1 / (2 * Math.PI) },
  "rad/s": { "rad/s": 1, rpm: 30 / Math.PI }
};

const maxDigits = 6;

// Decimal places of a value whose error is `error`.
const placesOf = (value, error) => {
  const size = Math.abs(value), leading = size > 0 ? Math.floor(Math.log10(size)) : 0;
  const wanted = error > 0 ? -Math.ceil(Math.log10(error)) : Infinity;
  return Math.min(wanted, maxDigits - 1 - leading);
};

class Numbers {
  constructor(language) {
    this.language = language;
    this.kept = new Map();
  }

  format(options) {
    const key = JSON.stringify(options);
    if (!this.kept.has(key)) this.kept.set(key, new Intl.NumberFormat(this.language, options));
    return this.kept.get(key);
  }

  // A value with the digits that its error leaves.
  show(value, error = 0) {
    if (value === null || Number.isNaN(value)) return "–";
    if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
    const places = placesOf(value, error), size = Math.abs(value);
    if (size !== 0 && (size >= 1e6 || size < 1e-4)) {
      const digits = Math.max(0, Math.min(maxDigits - 1, Math.floor(Math.log10(size)) + places));
      if (places < -Math.floor(Math.log10(size))) return "0";
      return this.format({ notation: "scientific", maximumFractionDigits: digits })
        .format(value).replace("E", " · 10^").replace(/\^(-?)(\d+)$/, (_, sign, digits) =>
          (sign ? "⁻" : "") + [...digits].map((one) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[one]).join(""))
        .replace("-", "−");
    }
    const shown = Math.max(0, Math.min(12, places === Infinity ? maxDigits - 1 : places));
    // No zero with a sign.
    const rounded = Number(value.toFixed(shown)) === 0 ? 0 : value;
    return this.format({ maximumFractionDigits: shown, useGrouping: false })
      .format(rounded).replace("-", "−");
  }

  // Of the size of an error: two digits.
  error(value) {
    if (value === 0) return "0";
    if (!Number.isFinite(value)) return this.show(value);
    const power = Math.floor(Math.log10(value)), lead = value / 10 ** power;
    const digits = [...String(Math.abs(power))].map((one) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[one]).join("");
    return this.format({ maximumSignificantDigits: 2 }).format(lead) + " · 10" +
      (power < 0 ? "⁻" : "") + digits;
  }
}

// A round number not below x: 1, 2 or 5 times a power of ten.
const roundUp = (x) => {
  const power = 10 ** Math.floor(Math.log10(x)), lead = x / power;
  const round = [1, 2, 5, 10].find((one) => lead <= one * (1 + 1e-12));
  return Number((round * power).toPrecision(3));
};

export { Numbers, roundUp, shownUnits, splitName, unitText };
