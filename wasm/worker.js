// A worker that answers a page: messages of JSON-RPC come and go as texts, as over the studio's socket.
//
// Before them the page posts {module, files, languages}: the compiled WebAssembly.Module (or nothing: the worker compiles it itself), the files
// that it holds by their paths ("/cabins.plan"), and what this worker speaks: "language" (the language server's messages), "desk" (questions), or
// both. The worker says {ready: version}, or {failed: why}. {path, text} changes a file, text null removes it; texts that use it are told. A page
// that cannot wait for an answer ends the worker and starts another from the module.
import Engine from "./engine.js";

let page = null, engine = null, roles = [], timer = null;
const waiting = [];

function take(pointer) {
  if (!pointer) return null;
  const text = engine.UTF8ToString(pointer);
  engine._free(pointer);
  return text;
}

const HEADER = 8, SIZE_WORD = 1; // of a message of bytes (studio/desk/desk.h)

// The messages of bytes that go before the answer.
function takeBytes() {
  const all = [];
  for (let pointer = engine._tn_page_bytes(page); pointer; pointer = engine._tn_page_bytes(page)) {
    const size = HEADER + engine.HEAPU32[(pointer >> 2) + SIZE_WORD];
    all.push(engine.HEAPU8.slice(pointer, pointer + size).buffer);
    engine._free(pointer);
  }
  return all;
}

function withText(text, use) {
  if (text === null) return use(0);
  const size = engine.lengthBytesUTF8(text) + 1, pointer = engine._malloc(size);
  if (!pointer) throw new Error("out of memory");
  engine.stringToUTF8(text, pointer, size);
  try {
    return use(pointer);
  } finally {
    engine._free(pointer);
  }
}

function send() {
  for (let text = take(engine._tn_page_next(page)); text !== null; text = take(engine._tn_page_next(page))) postMessage(text);
}

// What is to be done while no message comes.
function rest() {
  clearTimeout(timer);
  timer = null;
  if (!roles.includes("language")) return;
  const milliseconds = engine._tn_page_wait(page);
  if (milliseconds >= 0) {
    timer = setTimeout(() => {
      engine._tn_page_work(page);
      send();
      rest();
    }, milliseconds);
  }
}

function isQuestion(text) {
  try {
    const method = JSON.parse(text).method;
    return typeof method === "string" && method.startsWith("tartan/");
  } catch {
    return false; // the language server says what is wrong with it
  }
}

function answer(text) {
  const question = isQuestion(text);
  if (!question && roles.includes("language")) withText(text, (p) => engine._tn_page_take(page, p));
  if (roles.includes("desk")) {
    const response = take(withText(text, (p) => engine._tn_page_ask(page, p)));
    const bytes = takeBytes();
    if (question && response !== null) postMessage(bytes.length ? {answer: response, bytes} : response, bytes);
  }
  if (roles.includes("language")) send();
  rest();
}

function setFile(path, text) {
  if (withText(path, (p) => withText(text, (t) => engine._tn_page_file(page, p, t))) !== 0) throw new Error("out of memory");
}

const CHANGED = 2, DELETED = 3; // types of changes of files in the Language Server Protocol

function changeFile(path, text) {
  setFile(path, text);
  const uri = "file://" + path.split("/").map(encodeURIComponent).join("/");
  const changes = [{uri, type: text === null ? DELETED : CHANGED}];
  answer(JSON.stringify({jsonrpc: "2.0", method: "workspace/didChangeWatchedFiles", params: {changes}}));
}

// Browsers compile functions when they are first called: those that count are called before the page asks.
function warmUp() {
  const uri = "file:///.warm.plan", text = "schema s { width role length = 4' | 8' }\nrule r = quantity(tray(8')) >= 2\nlibrary l using s { trays 1..4  prune r }\n";
  const ask = (message) => take(withText(JSON.stringify({jsonrpc: "2.0", ...message}), (p) => engine._tn_page_ask(page, p)));
  ask({method: "textDocument/didOpen", params: {textDocument: {uri, languageId: "plan", version: 1, text}}});
  ask({id: 0, method: "tartan/count", params: {uri, version: 1, request: {}}});
  ask({method: "textDocument/didClose", params: {textDocument: {uri}}});
}

async function begin(given) {
  roles = given.languages || ["language", "desk"];
  const options = {};
  if (given.module) {
    options.instantiateWasm = (imports, done) => {
      WebAssembly.instantiate(given.module, imports).then((instance) => done(instance, given.module));
      return {};
    };
  }
  engine = await Engine(options);
  page = engine._tn_page_new();
  if (!page) throw new Error("out of memory");
  for (const [path, text] of Object.entries(given.files || {})) setFile(path, text);
  if (roles.includes("desk")) warmUp();
  postMessage({ready: engine.UTF8ToString(engine._tartan_version())});
  for (const message of waiting.splice(0)) handle(message);
}

function handle(data) {
  if (typeof data === "string") answer(data);
  else changeFile(data.path, data.text);
}

self.onmessage = (event) => {
  if (engine === null && event.data && event.data.path === undefined && typeof event.data !== "string") {
    begin(event.data).catch((error) => postMessage({failed: String(error)}));
  } else if (page === null) {
    waiting.push(event.data);
  } else {
    handle(event.data);
  }
};
