// The parts of sweep-parts.R read by DuckDB, bit by bit; DuckDB's npm package is in MODULES:
// node tools/sweep-parts.js FOLDER MODULES
const fs = require("fs");
const path = require("path");
const folder = process.argv[2];
const duckdb = require(require.resolve("@duckdb/node-api", { paths: [process.argv[3]] }));
const records = require(path.join(folder, "sweep-parts.json"));
const width = { double: 8, integer: 4 };
const type = { double: "DOUBLE", integer: "INTEGER" };
let failed = 0;
const verdict = (good, text) => {
  if (!good) failed++;
  console.log((good ? "ok - " : "not ok - ") + text);
};
const quoted = (text) => "'" + text.replaceAll("'", "''") + "'";

(async () => {
  const instance = await duckdb.DuckDBInstance.create(":memory:");
  const con = await instance.connect();
  // The bytes of each column, as DuckDB has them; null where one is of another type or has a NULL.
  const columns = async (sql, types) => {
    const result = await con.run(sql);
    if (result.columnTypes().map((t) => t.toString()).join() !== types.map((t) => type[t]).join()) {
      return null;
    }
    const bytes = types.map(() => []);
    for (const chunk of await result.fetchAllChunks()) {
      for (let i = 0; i < types.length; i++) {
        const vector = chunk.getColumnVector(i);
        const items = vector.items;
        for (let k = 0; k < chunk.rowCount; k++) if (vector.getItem(k) === null) return null;
        bytes[i].push(Buffer.from(Buffer.from(
          items.buffer, items.byteOffset, chunk.rowCount * width[types[i]]
        )));
      }
    }
    return bytes.map((list) => Buffer.concat(list));
  };
  const same = (a, b) => a !== null && a.length === b.length && a.every((x, i) => x.equals(b[i]));
  for (const { name, files, size, bits, glob, columns: names, types } of records) {
    // Of each part, the bytes of its columns.
    const all = fs.readFileSync(bits);
    let at = 0;
    const want = size.map((n) => types.map((t) => all.subarray(at, (at += n * width[t]))));
    let equal = 0;
    for (let p = 0; p < files.length; p++) {
      const read = await columns(`SELECT * FROM read_parquet(${quoted(files[p])})`, types);
      if (same(read, want[p])) equal++;
    }
    const rows = size.reduce((a, b) => a + b, 0);
    verdict(at === all.length && equal === files.length,
      `DuckDB reads ${equal} of ${files.length} parts of ${name} (${rows} rows) bit for bit`);
    const from = `FROM read_parquet(${quoted(glob)})`;
    const count = (await con.runAndReadAll(`SELECT count(*) ${from}`)).getRows()[0][0];
    verdict(Number(count) === rows, `DuckDB counts ${count} rows over the parts of ${name}`);
    if (names[0] !== "row") continue;
    const joined = types.map((t, i) => Buffer.concat(want.map((part) => part[i])));
    const ordered = await columns(`SELECT * ${from} ORDER BY "row"`, types);
    verdict(same(ordered, joined), `DuckDB reads all parts of ${name} at once, in order of rows`);
    let found = 0;
    const places = [0, Math.floor(rows / 3), rows - 1];
    for (const place of places) {
      const number = joined[0].readDoubleLE(8 * place);
      const one = await columns(`SELECT * ${from} WHERE "row" = ${number}`, types);
      const its = joined.map((x, i) => {
        return x.subarray(place * width[types[i]], (place + 1) * width[types[i]]);
      });
      if (same(one, its)) found++;
    }
    verdict(found === places.length, `DuckDB finds rows of ${name} by their numbers, the last ` +
      joined[0].readDoubleLE(8 * (rows - 1)));
  }
  process.exit(failed ? 1 : 0);
})().catch((e) => { console.log("not ok - DuckDB:", e.message); process.exit(1); });
