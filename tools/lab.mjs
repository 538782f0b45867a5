// Joins the page of the lab: node tools/lab.mjs CORE.wasm.gz PAGE.html. The modules of web/src become
// one script in the order in which they import each other; no name is at the top of two of them.
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const root = join(dirname(fileURLToPath(import.meta.url)), "..", "web");
const read = (name) => readFileSync(join(root, name), "utf8");
const [, , core, page] = process.argv;

const order = [];
const visit = (name) => {
  if (order.includes(name)) return;
  const imports = [...read(`src/${name}`).matchAll(/^import .* from "\.\/(.*)";$/gm)];
  for (const [, other] of imports) visit(other);
  order.push(name);
};
visit("lab.js");
visit("page.js");

const seen = new Map();
const script = order.map((name) => {
  const text = read(`src/${name}`);
  for (const [, top] of text.matchAll(/^(?:const|let|class|function|async function) (\w+)/gm)) {
    if (seen.has(top)) throw new Error(`${top} is at the top of ${seen.get(top)} and ${name}`);
    seen.set(top, name);
  }
  return text.replace(/^import [^;]*;\n/gm, "").replace(/^export [^;]*;\n/gm, "")
    .replace(/^ *\/\/.*\n/gm, "").replace(/\n{2,}/g, "\n").trim();
}).join("\n");

const css = (name) => read(`src/${name}`).replace(/\n {2}/g, "\n").trim();
const list = JSON.parse(read("scenes/list.json"));
const parts = {
  css: `${css("lab.css")}\n${css("ink.css")}`,
  ink: css("ink.css"),
  words: Object.fromEntries(readdirSync(join(root, "words")).sort().map((name) =>
    [name.replace(".json", ""), JSON.parse(read(`words/${name}`))])),
  scenes: list.map((id) => ({ id, ...JSON.parse(read(`scenes/${id}.json`)) })),
  html: read("src/page.html").replace("PAGE_CSS", () => css("page.css") + "\n"),
  core: readFileSync(core).toString("base64")
};
// "<" would end the script where "</script" or "<!--" stand in a text.
const given = Object.entries(parts).map(([name, value]) =>
  `${JSON.stringify(name)}:${JSON.stringify(value).replaceAll("<", "\\u003c")}`).join(",\n");
// In ASCII: the same in a document of any encoding, and a byte a letter in the browser's memory.
const ascii = (text) => text.replace(/[^\0-\x7f]/g, (one) =>
  `\\u${one.charCodeAt(0).toString(16).padStart(4, "0")}`);
const whole = ascii(`(() => {\n"use strict";\nconst rotdynParts = {\n${given}\n};\n${
  script.replaceAll("</", "<\\/")}\n})();\n`);
writeFileSync(page, parts.html.replace("SCRIPT", () => whole));
const kilo = (text) => Math.round(text.length / 1000);
console.log(`lab: ${order.length} modules, ${kilo(script)} kB of script, ${
  kilo(parts.core)} kB of core, ${kilo(whole)} kB in all`);
