// The pages of lessons and articles in headless Chromium: their width on a phone, axe-core's rules,
// contrast among them, pictures that are sharp and have a text, no request, the sheet of all verbs
// on one page of paper. Prints a line for each check, then `pages: N passed, N failed`.
import { readdirSync } from "node:fs";
import { check, close, open, report, violations } from "./browser.mjs";

const { PAGES, SHOTS } = process.env;
const names = readdirSync(PAGES).filter((name) => /[.]html$/.test(name) && name !== "index.html")
  .map((name) => name.replace(/[.]html$/, ""));

for (const name of names) {
  const page = await open(name);
  const pictures = await page.evaluate(() => {
    const marks = "line, polyline, polygon, path, circle, text";
    return [...document.querySelectorAll("svg.pic, img")].map((one) => ({
      text: one.getAttribute("aria-label") || one.getAttribute("alt") || "",
      sharp: one.tagName !== "IMG" || one.naturalWidth >= 2 * one.clientWidth,
      drawn: one.getBoundingClientRect().height > 40 &&
        (one.tagName === "IMG" || one.querySelectorAll(marks).length > 5)
    }));
  });
  check(`${name}: ${pictures.length} pictures with a text`,
    pictures.every((one) => one.text.length > 20), pictures.map((one) => one.text).join("; "));
  check(`${name}: pictures are sharp`, pictures.every((one) => one.sharp));
  check(`${name}: no picture is empty`, pictures.every((one) => one.drawn));
  const small = await page.evaluate(() => {
    const size = (one) => parseFloat(getComputedStyle(one).fontSize);
    return [...document.querySelectorAll("svg.pic")].flatMap((svg) => {
      const scale = svg.getBoundingClientRect().width / svg.viewBox.baseVal.width;
      return [...svg.querySelectorAll("text")].map((one) => scale * size(one));
    }).filter((px) => px < 7.5); // exponents of an axis have 7.6
  });
  check(`${name}: letters in pictures have 7.5 px`, small.length === 0, small.slice(0, 5).join(", "));
  const films = await page.locator(".rotdyn-film .stage").count();
  const moving = await page.evaluate(() => [...document.querySelectorAll(".rotdyn-film .stage")]
    .every((svg) => svg.querySelectorAll("path[d]").length > 2));
  check(`${name}: ${films} moving pictures are drawn`, moving);
  const wrong = await violations(page);
  check(`${name}: axe finds nothing`, wrong.length === 0, wrong.join("; "));
  for (const width of [400, 320]) {
    await page.setViewportSize({ width, height: 800 });
    await page.waitForTimeout(100);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    check(`${name}: no sideways scrolling at ${width} px`, wide <= width, wide);
    if (SHOTS && width === 400) {
      await page.screenshot({ path: `${SHOTS}/${name}-400.png`, fullPage: true });
    }
  }
  const narrow = await violations(page);
  check(`${name}: axe finds nothing at 320 px`, narrow.length === 0, narrow.join("; "));
  check(`${name}: no request`, page.asked.length === 0, page.asked.join("; "));
  check(`${name}: no message`, page.heard.length === 0, page.heard.join("; "));
  await page.close();
}

// Alone, the sheet takes one page of A4 and one of letter paper.
{
  const page = await open("rotdyn");
  await page.evaluate(() => {
    const sheet = document.getElementById("all-verbs-on-one-page");
    document.body.replaceChildren(sheet);
  });
  for (const format of ["A4", "Letter"]) {
    const pdf = (await page.pdf({ format })).toString("latin1");
    const pages = (pdf.match(/\/Type\s*\/Page[^s]/g) || []).length;
    check(`rotdyn: all verbs on one page of ${format}`, pages === 1, pages);
  }
  await page.close();
}

await close();
report("pages");
