import assert from "node:assert/strict";
import test from "node:test";
import {LONGEST, fragmentOf, linkedOf} from "../src/link";
import {Texts} from "../src/texts";

test("files go into a link and come out of it", async () => {
  const linked = {files: {"rows.plan": "# äöü 😀\n".repeat(2000), "sub/b.plan": ""}, open: "sub/b.plan"};
  const fragment = (await fragmentOf(linked))!;
  assert.match(fragment, /^#t1\.[\w-]+$/);
  assert.ok(fragment.length < 500);
  assert.deepEqual(await linkedOf(fragment), linked);
});

test("what is no link, or too long, is none", async () => {
  for (const text of ["", "#", "#0123456789abcdef0123456789abcdef", "#t1.", "#t1.!!!!", "#t1.AAAA", `#t1.${"A".repeat(LONGEST)}`]) assert.equal(await linkedOf(text), null);
  const noise = Array.from({length: 90_000}, (_, i) => String.fromCharCode(33 + ((i * 7919 + (i % 113) * 31) % 90))).join("");
  const random = Array.from(crypto.getRandomValues(new Uint8Array(60_000)), (byte) => byte.toString(16)).join("");
  assert.equal(await fragmentOf({files: {"a.plan": noise + random}, open: "a.plan"}), null);
  for (const path of ["../a.plan", "/a.plan", "a/../../b.plan"]) assert.equal(await linkedOf((await fragmentOf({files: {[path]: ""}, open: path}))!), null);
});

test("texts follow the messages of the editor", () => {
  const texts = new Texts();
  const uri = "file:///a.plan";
  texts.take({method: "textDocument/didOpen", params: {textDocument: {uri, languageId: "plan", version: 1, text: "one\ntwo\n"}}});
  texts.take({method: "textDocument/didChange", params: {textDocument: {uri, version: 2}, contentChanges: [
    {range: {start: {line: 1, character: 0}, end: {line: 1, character: 3}}, text: "three"},
    {range: {start: {line: 0, character: 3}, end: {line: 1, character: 0}}, text: " "},
  ]}});
  assert.equal(texts.known.get(uri)!.text, "one three\n");
  assert.equal(JSON.parse(texts.opening()[0]).params.textDocument.version, 2);
  texts.take({method: "textDocument/didClose", params: {textDocument: {uri}}});
  assert.deepEqual(texts.opening(), []);
});
