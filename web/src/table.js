// Rows as CSV, and a CSV of one's own.

// Full digits; a decimal comma comes with semicolons.
function csvOf(run, { comma = false, index } = {}) {
  const names = Object.keys(run.columns), per = run.said.rows_per_time;
  const separator = comma ? ";" : ",";
  const number = (x) => {
    const text = Number.isNaN(x) ? "NA" : Number.isFinite(x) ? String(x) : x > 0 ? "Inf" : "-Inf";
    return comma ? text.replace(".", ",") : text;
  };
  const lines = [["time_s", ...(per > 1 ? [index] : []), ...names].join(separator)];
  for (let i = 0; i < run.time.length; i++) {
    for (let k = 0; k < per; k++) {
      lines.push([
        number(run.time[i]), ...(per > 1 ? [String(k + 1)] : []),
        ...names.map((name) => number(run.columns[name][i * per + k]))
      ].join(separator));
    }
  }
  return lines.join("\n") + "\n";
}

// { time, columns } of a text with a header; columns by the names of a run. Throws words' keys.
function readCsv(text) {
  const lines = text.replace(/^\uFEFF/, "").split(/\r?\n/).filter((one) => one.trim() !== "");
  if (lines.length < 2) throw new Error("data_empty");
  const separator = lines[0].includes(";") ? ";" : lines[0].includes("\t") ? "\t" : ",";
  const cells = (one) => one.split(separator).map((x) => x.trim().replace(/^"|"$/g, ""));
  const names = cells(lines[0]);
  const numbers = lines.slice(1).map((one) => cells(one).map((x) =>
    x === "" || x === "NA" ? NaN : Number(separator === "," ? x : x.replace(",", "."))));
  const at = names.indexOf("time_s");
  if (at < 0) throw new Error("data_no_time");
  const columns = {};
  names.forEach((name, k) => {
    if (k !== at) columns[name] = numbers.map((row) => row[k] ?? NaN);
  });
  return { time: numbers.map((row) => row[at]), columns };
}

// The value of a column at a time, linear between rows; NaN outside.
function valueAt(time, values, t) {
  if (!(t >= time[0] && t <= time[time.length - 1])) return NaN;
  let low = 0, high = time.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (time[middle] <= t) low = middle; else high = middle;
  }
  const f = (t - time[low]) / (time[high] - time[low] || 1);
  return values[low] + f * (values[high] - values[low]);
}

export { csvOf, readCsv, valueAt };
