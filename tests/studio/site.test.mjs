// The documentation's pages: each link that opens a file in the playground opens that file, with its text, and says nothing on the console. SITE is
// the folder of the pages, which `make check-site` makes with the playground in it.
import assert from "node:assert/strict";
import test from "node:test";
import {createServer} from "node:http";
import {existsSync, readFileSync, readdirSync} from "node:fs";
import {extname, join} from "node:path";
import {inflateRawSync} from "node:zlib";
import {TYPES, done, text, visit} from "./studio.mjs";

const SITE = process.env.SITE;

async function serve(t) {
  const server = createServer((request, response) => {
    const path = join(SITE, decodeURIComponent(new URL(request.url, "http://localhost").pathname));
    if (!existsSync(path)) return response.writeHead(404).end();
    response.writeHead(200, {"content-type": TYPES[extname(path)] ?? "application/octet-stream"}).end(readFileSync(path));
  });
  await new Promise((listens) => server.listen(0, "127.0.0.1", listens));
  t.after(() => server.close());
  return `http://127.0.0.1:${server.address().port}`;
}

// The links of the pages, as addresses below the site's.
function tries() {
  const pages = readdirSync(SITE, {recursive: true}).filter((name) => name.endsWith(".html") && !name.startsWith("play"));
  return pages.flatMap((page) => [...readFileSync(join(SITE, page), "utf8").matchAll(/href="[^"]*(play\/index\.html#t1\.[\w-]+)"/g)].map((found) => ({page, link: found[1]})));
}

test("each file of a page opens in the playground", {skip: SITE ? false : "make check-site runs it"}, async (t) => {
  const address = await serve(t);
  const links = tries();
  assert.ok(links.length > 20, `${links.length} files can be tried`);
  for (const {page, link} of links)
    await t.test(page, async (t) => {
      const {files, open} = JSON.parse(inflateRawSync(Buffer.from(link.split("#t1.")[1], "base64url")).toString());
      const window = await visit(t, `${address}/${link}`);
      await window.locator(".file-name", {hasText: open}).waitFor();
      await window.waitForFunction((wanted) => document.querySelector(".editor")?.shadowRoot?.querySelector(".cm-content")?.cmTile.root.view.state.doc.toString() === wanted, files[open]);
      assert.equal(await text(window), files[open]);
    });
  await done();
});
