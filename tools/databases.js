// The tables, rows and wrong rows of databases.R in DuckDB: node tools/databases.js FOLDER
const path = require("path");
const folder = process.argv[2];
const duckdb = require(require.resolve("@duckdb/node-api", { paths: [folder] }));
const { script, wrong, what, views } = require(path.join(folder, "duckdb.json"));

(async () => {
  const instance = await duckdb.DuckDBInstance.create(":memory:");
  const con = await instance.connect();
  const rows = async (sql) => (await con.runAndReadAll(sql)).getRows();
  console.log("DuckDB", (await rows("SELECT version()"))[0][0]);
  for (const sql of script) await con.run(sql);
  let failed = 0;
  const least = [5, 5, 6, 10, 3, 13, 6, 8, 6, 4];
  for (let i = 0; i < views.length; i++) {
    const n = Number((await rows(`SELECT COUNT(*) FROM ${views[i]}`))[0][0]);
    if (n < least[i]) { failed++; console.log(`not ok - ${views[i]} has ${n} rows`); }
  }
  const closing = await rows(`SELECT relation_name, equation_text, interpretation
    FROM physical_relations ORDER BY relation_id;`);
  if (closing.length !== 13) { failed++; console.log("not ok - the closing query"); }
  let refused = 0;
  for (let i = 0; i < wrong.length; i++) {
    try {
      await con.run(wrong[i]);
      failed++;
      console.log("not ok - DuckDB takes", what[i]);
    } catch (e) {
      refused++;
    }
  }
  console.log(`ok - DuckDB refuses ${refused} of ${wrong.length} wrong rows`);
  process.exit(failed ? 1 : 0);
})().catch((e) => { console.log("not ok - DuckDB:", e.message); process.exit(1); });
