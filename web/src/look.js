// What pictures and curves read of a run: rows by column, the largest values, the scene's numbers.
import { sceneOf } from "./inputs.js";

class Look {
  constructor(tree, run, view) {
    this.run = run;
    this.said = run.said;
    this.view = view;
    [, this.inputs] = sceneOf(tree);
    this.radius = run.said.radius_m;
    this.size = this.numbers("length_m", run.said.rows_per_time).reduce((a, b) => a + b, 0) || 1;
    this.sizes = new Map();
  }

  has(name) { return name in this.run.columns; }

  // The row of time i: name, and which of several rows => number; undefined without the column.
  row(i) {
    const per = this.said.rows_per_time;
    const row = (name, k = 0) => this.run.columns[name]?.[i * per + k];
    row.at = i;
    return row;
  }

  // An input that is a number.
  number(name) { return typeof this.inputs?.[name] === "number" ? this.inputs[name] : undefined; }

  // An input as n numbers, one for all.
  numbers(name, n) {
    const value = this.inputs?.[name], many = Array.isArray(value) ? value : [value];
    return Array.from({ length: n }, (_, k) => many[k % many.length] ?? 1);
  }

  sized(key, make) {
    if (!this.sizes.has(key)) this.sizes.set(key, make());
    return this.sizes.get(key);
  }

  // The largest absolute value in the run.
  largest(names) {
    return this.sized(names.join(), () => names.reduce((most, name) =>
      (this.run.columns[name] ?? []).reduce((a, x) => Math.abs(x) > a ? Math.abs(x) : a, most), 0));
  }

  // A column in this row over its largest value.
  relative(name, row) { return (row(name) ?? 0) / (this.largest([name]) || 1); }

  largestVector(stem, end) {
    return this.sized(stem, () => {
      const of = ["x", "y", "z"].map((k) => this.run.columns[`${stem}_${k}${end}`]);
      if (of.some((one) => !one)) return 0;
      let most = 0;
      for (let i = 0; i < of[0].length; i++) {
        most = Math.max(most, Math.hypot(of[0][i], of[1][i], of[2][i]));
      }
      return most;
    });
  }
}

export { Look };
