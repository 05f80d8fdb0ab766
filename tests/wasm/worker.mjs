// The engines of a page in a worker, as the page talks to it: node worker.mjs SITE TARTAN, SITE what `make wasm` made, TARTAN the native command.
//
// Node's worker stands in for a browser's. What the page is told of a text is compared with what the command says of it.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { performance } from "node:perf_hooks";
import { pathToFileURL } from "node:url";
import { Worker } from "node:worker_threads";

const site = resolve(process.argv[2]), tartan = resolve(process.argv[3]);
const compiled = await WebAssembly.compile(readFileSync(join(site, "engine.wasm")));
const folder = mkdtempSync(join(tmpdir(), "tartan-"));

// What a browser gives its workers, and Node does not. Modules are told by their ending here: the site's are copied as .mjs.
writeFileSync(join(folder, "engine.mjs"), readFileSync(join(site, "engine.js")));
writeFileSync(join(folder, "worker.mjs"), readFileSync(join(site, "worker.js"), "utf8").replace("./engine.js", "./engine.mjs"));
writeFileSync(join(folder, "start.mjs"), `
import { parentPort } from "node:worker_threads";
globalThis.self = globalThis;
globalThis.location = { href: ${JSON.stringify(pathToFileURL(site + "/worker.js").href)} };
globalThis.importScripts = () => {};
globalThis.onmessage = null;
globalThis.postMessage = (data) => parentPort.postMessage(data);
globalThis.process = undefined; // so that nothing takes this for Node
parentPort.on("message", (data) => globalThis.onmessage({ data }));
await import("./worker.mjs");
parentPort.postMessage("loaded");
`);

class Page {
  constructor() {
    this.worker = new Worker(join(folder, "start.mjs"), { resourceLimits: { stackSizeMb: 1 } }); // what a browser's worker has
    this.told = [];
    this.asked = null;
    this.id = 0;
    this.worker.on("message", (data) => {
      this.told.push(typeof data === "string" && data.startsWith("{") ? JSON.parse(data) : data);
      this.look();
    });
    this.worker.on("error", (error) => { throw error; });
  }
  look() {
    const at = this.asked ? this.told.findIndex(this.asked.is) : -1;
    if (at < 0) return;
    const { found } = this.asked;
    this.asked = null;
    found(this.told.splice(at, 1)[0]);
  }
  until(is) {
    return new Promise((found) => {
      this.asked = { is, found };
      this.look();
    });
  }
  async begin(files, languages) {
    await this.until((m) => m === "loaded");
    this.worker.postMessage({ module: compiled, files, languages });
    return (await this.until((m) => m.ready || m.failed)).ready;
  }
  notify(method, params) {
    this.worker.postMessage(JSON.stringify({ jsonrpc: "2.0", method, params }));
  }
  request(method, params) {
    const id = ++this.id;
    this.worker.postMessage(JSON.stringify({ jsonrpc: "2.0", id, method, params }));
    return this.until((m) => m.id === id);
  }
}

const houses = readFileSync("stdlib/lahave-houses.plan", "utf8"), uri = "file:///mine.plan", other = "file:///own.plan";
const open = (u, text) => ({ textDocument: { uri: u, languageId: "plan", version: 1, text } });
const own = 'use "pieces.plan"\nlibrary few using row { trays 1..3  prune long }\n';
const pieces = "schema row {\n  width role length = 4' | 8'\n}\nrule long = quantity(tray(8')) >= 2\n";

try {
  const page = new Page();
  assert.match(await page.begin({ "/pieces.plan": pieces }), /^\d+\.\d+\.\d+$/);

  // The language server.
  const told = await page.request("initialize", { processId: null, rootUri: "file:///", capabilities: {} });
  assert.ok(told.result.capabilities.hoverProvider);
  page.notify("initialized", {});
  page.notify("textDocument/didOpen", open(uri, houses));
  let found = await page.until((m) => m.method === "textDocument/publishDiagnostics" && m.params.uri === uri);
  assert.ok(Array.isArray(found.params.diagnostics));
  page.notify("textDocument/didChange", { textDocument: { uri, version: 2 }, contentChanges: [{ text: houses + "\nlibrary wrong using nothing { trays 1..2 }\n" }] });
  found = await page.until((m) => m.method === "textDocument/publishDiagnostics" && m.params.uri === uri && m.params.diagnostics.some((d) => d.severity === 1));
  page.notify("textDocument/didChange", { textDocument: { uri, version: 3 }, contentChanges: [{ text: houses }] });
  found = await page.until((m) => m.method === "textDocument/publishDiagnostics" && m.params.uri === uri && !m.params.diagnostics.some((d) => d.severity === 1));

  // The desk, with a file that the page holds.
  let answer = await page.request("tartan/count", { uri, version: 3, request: {} });
  const count = JSON.parse(execFileSync(tartan, ["count", "lahave-houses", "--json"], { encoding: "utf8" }));
  assert.deepEqual(answer.result.answer, count);
  page.notify("textDocument/didOpen", open(other, own));
  answer = await page.request("tartan/count", { uri: other, version: 1, request: {} });
  assert.ok(answer.result, JSON.stringify(answer));
  const few = answer.result.answer;
  writeFileSync(join(folder, "own.plan"), own);
  writeFileSync(join(folder, "pieces.plan"), pieces);
  assert.deepEqual(few, JSON.parse(execFileSync(tartan, ["count", join(folder, "own.plan"), "--json"], { encoding: "utf8" })));

  // The file changes.
  const changed = pieces.replace(">= 2", ">= 1");
  page.worker.postMessage({ path: "/pieces.plan", text: changed });
  writeFileSync(join(folder, "pieces.plan"), changed);
  answer = await page.request("tartan/count", { uri: other, version: 1, request: {} });
  assert.ok(answer.result, JSON.stringify(answer));
  assert.deepEqual(answer.result.answer, JSON.parse(execFileSync(tartan, ["count", join(folder, "own.plan"), "--json"], { encoding: "utf8" })));
  page.worker.postMessage({ path: "/pieces.plan", text: null });
  answer = await page.request("tartan/count", { uri: other, version: 1, request: {} });
  assert.equal(answer.error.code, -32803);

  // What is no message, and what is no question.
  page.worker.postMessage("{");
  answer = await page.until((m) => m.error && m.id === null);
  answer = await page.request("tartan/nothing", { uri, version: 3, request: {} });
  assert.equal(answer.error.code, -32601);
  answer = await page.request("tartan/count", { uri, version: 7, request: {} });
  assert.equal(answer.error.code, -32801);

  // A worker that is ended is replaced by another of the same module.
  const began = performance.now();
  await page.worker.terminate();
  const next = new Page();
  await next.begin({}, ["desk"]);
  next.notify("textDocument/didOpen", open(uri, houses));
  answer = await next.request("tartan/count", { uri, version: 1, request: {} });
  assert.deepEqual(answer.result.answer, count);
  const first = performance.now();
  console.log(`a worker of a page answers as the command; ended and counting again after ${(first - began).toFixed(0)} ms`);
  await next.worker.terminate();
} finally {
  rmSync(folder, { recursive: true, force: true });
}
