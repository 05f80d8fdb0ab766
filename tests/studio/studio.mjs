// What the scenarios share: a folder, `tartan studio` on it, a browser without a screen, and the page in it.
import {chromium} from "playwright-core";
import assert from "node:assert/strict";
import {spawn, spawnSync} from "node:child_process";
import {mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync} from "node:fs";
import {createServer as createWeb} from "node:http";
import {createServer} from "node:net";
import {tmpdir} from "node:os";
import {basename, dirname, extname, join, resolve} from "node:path";
import {fileURLToPath} from "node:url";
import {deflateRawSync} from "node:zlib";

const here = dirname(fileURLToPath(import.meta.url));
export const TARTAN = resolve(process.env.TARTAN ?? join(here, "../../build/tartan"));
const BROWSER = process.env.CHROMIUM ?? "/usr/bin/chromium";
// Forms are drawn by the processor, where there is no other.
const FLAGS = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"];
// The folder of the page without a server (make wasm), if the scenarios are to run on that.
export const PLAYGROUND = process.env.PLAYGROUND ? resolve(process.env.PLAYGROUND) : null;
const START_MS = 20_000;

let browser;

export function tartan(...words) {
  const {status, stdout, stderr} = spawnSync(TARTAN, words, {encoding: "utf8"});
  assert.ok(status === 0 || status === 1, stderr);
  return stdout;
}

// A folder with these texts by their names; it goes with the scenario.
export function folder(t, texts = {}) {
  const path = mkdtempSync(join(tmpdir(), "tartan-studio-"));
  for (const [name, text] of Object.entries(texts)) writeFileSync(join(path, name), text);
  t.after(() => rmSync(path, {recursive: true, force: true}));
  return path;
}

export function freePort() {
  return new Promise((done) => {
    const server = createServer().listen(0, "127.0.0.1", () => {
      const {port} = server.address();
      server.close(() => done(port));
    });
  });
}

export const TYPES = {".html": "text/html; charset=utf-8", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm"};

// Serves the playground as any server of files does; the folder's texts are in the address.
async function serveFiles(t, path) {
  const server = createWeb((request, response) => {
    const name = basename(new URL(request.url, "http://localhost").pathname) || "index.html";
    try {
      const bytes = readFileSync(join(PLAYGROUND, name));
      response.writeHead(200, {"content-type": TYPES[extname(name)] ?? "application/octet-stream"}).end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  t.after(() => server.close());
  const names = readdirSync(path);
  const files = Object.fromEntries(names.map((name) => [name, read(join(path, name))]));
  const packed = deflateRawSync(JSON.stringify({files, open: names[0]})).toString("base64url");
  return {address: `http://127.0.0.1:${server.address().port}/${names.length ? `#t1.${packed}` : ""}`, stop: async () => {}};
}

// Where the page of an address has its files, for what is compared with the command.
const folders = new Map();

// Starts the server; `stop` ends it as Ctrl-C does.
export async function serve(t, path, ...options) {
  const served = PLAYGROUND ? await serveFiles(t, path) : await serveFolder(t, path, ...options);
  folders.set(served.address, path);
  return served;
}

async function serveFolder(t, path, ...options) {
  const child = spawn(TARTAN, ["studio", path, "--no-open", ...options], {stdio: ["ignore", "pipe", "pipe"]});
  let said = "";
  const address = await new Promise((done, fail) => {
    const timer = setTimeout(() => fail(new Error(`no address after ${START_MS} ms: ${said}`)), START_MS);
    const listen = (part) => {
      said += part;
      const found = /http:\/\/\S+#[0-9a-f]{32}/.exec(said);
      if (!found) return;
      clearTimeout(timer);
      done(found[0]);
    };
    child.stdout.on("data", listen);
    child.stderr.on("data", listen);
    child.on("exit", (code) => fail(new Error(`the server ended with ${code}: ${said}`)));
  });
  const stop = () => new Promise((done) => {
    if (child.exitCode !== null || child.signalCode !== null) return done();
    child.on("exit", done);
    child.kill("SIGINT");
  });
  t.after(stop);
  return {address, stop};
}

// The page in a window of its own. What it says to its console fails the scenario, but for what `expected` matches.
export async function visit(t, address, {width = 1280, height = 800, dark = false, expected = null, context = null} = {}) {
  browser ??= await chromium.launch({executablePath: BROWSER, args: FLAGS});
  const own = context ?? (await browser.newContext({viewport: {width, height}, colorScheme: dark ? "dark" : "light", reducedMotion: "reduce"}));
  const page = await own.newPage();
  const said = [];
  page.on("console", (message) => said.push(message.text()));
  page.on("pageerror", (error) => said.push(String(error.stack ?? error.message ?? error)));
  page.on("dialog", (dialog) => dialog.accept());
  page.folder = folders.get(address);
  await page.goto(address);
  t.after(async () => {
    await page.close({runBeforeUnload: false});
    if (!context) await own.close();
    assert.deepEqual(said.filter((text) => !expected?.test(text)), [], "the console is empty");
  });
  return page;
}

// The browser is left to the last scenario of a file.
export async function done() {
  await browser?.close();
  browser = undefined;
}

// ---- the page

export const count = (page) => page.locator("#count");

export async function counted(page, digits) {
  const text = BigInt(digits).toLocaleString("en-US");
  await page.locator("#count", {hasText: new RegExp(`^${text}$`)}).waitFor();
}

// Opens a file of the list, and waits until it is the one that is edited: another of the same text would look alike.
export async function openFile(page, name) {
  await page.locator(".file-name").click();
  await page.locator(".files").getByRole("button", {name}).click();
  await page.locator(".file-name", {hasText: name}).waitFor();
}

export const text = (page) => page.evaluate(() => document.querySelector(".editor").shadowRoot.querySelector(".cm-content").cmTile.root.view.state.doc.toString());

// Types at the end of the line that has this text, or in its place.
export async function write(page, {after, over, typed}) {
  await page.evaluate(({after, over}) => {
    const view = document.querySelector(".editor").shadowRoot.querySelector(".cm-content").cmTile.root.view;
    const doc = view.state.doc.toString();
    const at = doc.indexOf(after ?? over);
    if (at < 0) throw new Error(`the text has no ${after ?? over}`);
    const end = at + (after ?? over).length;
    view.dispatch({selection: {anchor: over === undefined ? end : at, head: end}, scrollIntoView: true});
    view.focus();
  }, {after, over});
  await page.keyboard.insertText(typed);
}

export async function save(page) {
  await page.keyboard.press("Control+s");
  await page.locator(".status", {hasText: /^saved$/}).waitFor();
  if (PLAYGROUND) writeFileSync(join(page.folder, (await page.locator(".file-name").textContent()).replace("▾", "")), await text(page));
}

export function countOf(path, ...options) {
  return JSON.parse(tartan("count", path, "--json", ...options));
}

export const read = (path) => readFileSync(path, "utf8");

// What an inspector of accessibility finds in the page as it is.
export async function inspected(page, where) {
  await page.addScriptTag({content: ""}).catch(() => {});
  const source = read(join(here, "node_modules/axe-core/axe.min.js"));
  await page.evaluate(source);
  const {violations} = await page.evaluate(() => window.axe.run(document, {resultTypes: ["violations"]}));
  const found = violations.map(({id, help, nodes}) => `${id}: ${help}\n${nodes.map((node) => `    ${node.target.join(" ")} ${node.failureSummary?.split("\n").slice(1).join(";") ?? ""}`).slice(0, 4).join("\n")}`);
  assert.deepEqual(found, [], `${where} is accessible`);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
  assert.equal(wide, 0, `${where} is not wider than its window`);
}

export const ROWS = `schema bay "one bay of the row" {
  use   "what it is for" = room | hall | stair
  width "along the row" role length = 3m | 4m | 6m
}

param lot "how long the row may be" = 20m in 12m..30m
param stairs "how many stairs" = 1 in 0..3
param side "where the hall is" = left | right | anywhere

rule left-hall = neighbour(beginning, tray(hall))
rule right-hall = neighbour(tray(hall), end)

rule enough "there are as many stairs as wanted" =
  quantity(tray(stair)) = stairs

rule narrow-hall "a hall of 3 m" =
  tray(hall, 3m)

library rows "rows of three to six bays" using bay {
  trays 3..6
  require enough, sum(width) <= lot
  require side = left implies left-hall, side = right implies right-hall
  prune narrow-hall
}

measure cost "in thousands" =
  9 * sum(width) / 1m + 25 * quantity(tray(stair))

measure rooms "how many there are" =
  quantity(tray(room))

test rows {
  keep [hall 4m | stair 3m | room 6m]
}
`;
