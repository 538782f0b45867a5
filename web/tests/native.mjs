// The native program (web/tests/native.c) as a function of a scene and its times.
import { spawn } from "node:child_process";
import { createInterface } from "node:readline";

export function openNative(path) {
  const program = spawn(path, { stdio: ["pipe", "pipe", "inherit"] });
  const lines = createInterface({ input: program.stdout })[Symbol.asyncIterator]();
  const next = async () => {
    const { value, done } = await lines.next();
    if (done) throw new Error("the native program ended");
    return value;
  };
  const doubles = (hex) => {
    const bytes = Buffer.from(hex, "hex");
    return Float64Array.from({ length: bytes.length / 8 }, (_, i) => bytes.readDoubleBE(8 * i));
  };
  return {
    catalogue: next().then(JSON.parse),
    async run(scene, { start, end, rows, accuracy, steps }) {
      program.stdin.write(`${start} ${end} ${rows} ${accuracy} ${steps} ${scene}\n`);
      const said = JSON.parse(await next()), report = JSON.parse(await next());
      if (!report) return (await next(), { said });
      const models = JSON.parse(await next()), audit = JSON.parse(await next());
      const code = (await next()).replaceAll("\t", "\n"), columns = {};
      for (const one of said.columns) columns[one.name] = doubles(await next());
      await next();
      return { said, report, models, audit, code, columns };
    },
    close() { program.stdin.end(); }
  };
}
