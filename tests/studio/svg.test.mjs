// Pictures are copied by a list: what could run, load or reach out of a picture stays outside.
import assert from "node:assert/strict";
import test from "node:test";
import {build} from "esbuild";
import {chromium} from "playwright-core";
import {dirname, join} from "node:path";
import {fileURLToPath} from "node:url";

const source = join(dirname(fileURLToPath(import.meta.url)), "../../studio/page/src/svg.ts");

test("what a picture may have", async () => {
  const {outputFiles} = await build({entryPoints: [source], bundle: true, write: false, format: "iife", globalName: "pictures"});
  const browser = await chromium.launch({executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox", "--disable-gpu"]});
  const page = await browser.newPage();
  await page.evaluate(outputFiles[0].text + ";globalThis.pictures = pictures;");
  const copied = (text) => page.evaluate((given) => globalThis.pictures.picture(given, "a picture")?.outerHTML ?? null, text);
  const svg = (inside, attributes = "") => `<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 9 9" ${attributes}>${inside}</svg>`;
  for (const inside of [
    "<script>alert(1)</script>", "<foreignObject><p>x</p></foreignObject>", '<image href="http://127.0.0.1/x.png"/>', "<style>*{}</style>", '<a href="javascript:alert(1)"/>',
    "<animate/>", '<set attributeName="href" to="x"/>', '<p xmlns="http://www.w3.org/1999/xhtml">x</p>',
  ])
    assert.equal(await copied(svg(inside)), await copied(svg("")).then((empty) => empty), inside);
  const rect = async (attributes) => /<rect[^>]*>/.exec(await copied(svg(`<rect ${attributes}/>`)))[0];
  assert.equal(await rect('onclick="alert(1)"'), "<rect>");
  assert.equal(await rect('fill="url(http://127.0.0.1/#a)"'), "<rect>");
  assert.equal(await rect('style="fill:url(http://127.0.0.1/x)"'), "<rect>");
  assert.equal(await rect('style="fill:#fff;position:fixed;stroke:red"'), '<rect fill="#fff" stroke="red">');
  assert.match(await rect('fill="url(#a)"'), /fill="url\(#p\d+-a\)"/);
  assert.match(await rect('id="a" data-tray="3"'), /id="p\d+-a" data-tray="3"/);
  assert.match(await copied(svg('<use xlink:href="#a"/><use href="x.svg#a"/>')), /<use href="#p\d+-a"><\/use><use><\/use>/);
  assert.equal(await copied("<svg"), null);
  assert.equal(await copied("<p xmlns='http://www.w3.org/1999/xhtml'/>"), null);
  await browser.close();
});
