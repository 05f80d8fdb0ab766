// What the scenarios share: a folder, `tartan studio` on it, a browser without a screen, and the page in it.
import {chromium} from "playwright-core";
import assert from "node:assert/strict";
import {spawn, spawnSync} from "node:child_process";
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from "node:fs";
import {createServer} from "node:net";
import {tmpdir} from "node:os";
import {dirname, join, resolve} from "node:path";
import {fileURLToPath} from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
export const TARTAN = resolve(process.env.TARTAN ?? join(here, "../../build/tartan"));
const BROWSER = process.env.CHROMIUM ?? "/usr/bin/chromium";
const FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"];
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

// Starts the server; `stop` ends it as Ctrl-C does.
export async function serve(t, path, ...options) {
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
