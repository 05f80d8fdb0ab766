// Nothing is lost, and nothing is overwritten unseen: the server ends and comes back, two windows have one file, a file is
// changed by somebody else, a folder is for reading alone.
import assert from "node:assert/strict";
import test, {after} from "node:test";
import {writeFileSync} from "node:fs";
import {join} from "node:path";
import {PLAYGROUND, ROWS, countOf, counted, done, folder, freePort, inspected, read, save, serve, text, visit, write} from "./studio.mjs";

after(done);

// What is about a server and its folder; the playground has neither.
const only = {skip: PLAYGROUND !== null};
const NO_SERVER = /WebSocket connection|ERR_CONNECTION_REFUSED|403/;

test("the server ends and is started again", only, async (t) => {
  const path = folder(t, {"rows.plan": ROWS});
  const port = String(await freePort());
  const first = await serve(t, path, "--port", port);
  const page = await visit(t, first.address, {expected: NO_SERVER});
  await counted(page, countOf(join(path, "rows.plan")).kept);
  await write(page, {over: "prune narrow-hall", typed: "# prune narrow-hall"});
  await first.stop();
  await page.getByText("Your text is kept here").waitFor();
  await write(page, {over: "trays 3..6", typed: "trays 3..5"});
  await inspected(page, "no connection");
  const [saved] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", {name: "Save a copy"}).click()]);
  assert.equal(saved.suggestedFilename(), "rows.plan");
  const second = await serve(t, path, "--port", port);
  await page.evaluate((hash) => (location.hash = hash), new URL(second.address).hash);
  await page.locator(".status", {hasText: "not saved"}).waitFor();
  const wanted = ROWS.replace("prune narrow-hall", "# prune narrow-hall").replace("trays 3..6", "trays 3..5");
  assert.equal(await text(page), wanted);
  assert.equal(read(join(path, "rows.plan")), ROWS, "nothing is written by itself");
  const copy = join(path, "copy.plan");
  writeFileSync(copy, wanted);
  await counted(page, countOf(copy).kept);
  await save(page);
  assert.equal(read(join(path, "rows.plan")), wanted);
});

test("a window that was closed before its text was saved", only, async (t) => {
  const path = folder(t, {"rows.plan": ROWS});
  const {address} = await serve(t, path);
  const page = await visit(t, address);
  await page.locator("#count").waitFor();
  await write(page, {over: "trays 3..6", typed: "trays 3..4"});
  await page.getByText("not saved").first().waitFor();
  await page.reload();
  await page.getByRole("button", {name: "Take that text"}).click();
  assert.match(await text(page), /trays 3\.\.4/);
});

test("two windows on one file", only, async (t) => {
  const path = folder(t, {"rows.plan": ROWS});
  const {address} = await serve(t, path);
  const one = await visit(t, address);
  const two = await visit(t, address);
  await Promise.all([one, two].map((page) => page.locator("#count").waitFor()));
  await write(one, {over: "trays 3..6", typed: "trays 3..5"});
  await write(two, {over: "20m in", typed: "18m in"});
  await save(one);
  await two.getByText("was changed elsewhere, and here too").waitFor();
  await two.getByRole("button", {name: "See both"}).click();
  await inspected(two, "both texts");
  await two.getByRole("button", {name: "Decide later"}).click();
  await two.getByRole("button", {name: "Keep mine"}).click();
  await save(two);
  assert.match(read(join(path, "rows.plan")), /18m in/);
  await one.waitForFunction(() => document.querySelector(".editor").shadowRoot.querySelector(".cm-content").textContent.includes("18m in"));
});

test("a file that is changed outside", only, async (t) => {
  const path = folder(t, {"rows.plan": ROWS});
  const {address} = await serve(t, path);
  const page = await visit(t, address);
  await page.locator("#count").waitFor();
  const changed = ROWS.replace("trays 3..6", "trays 3..4");
  writeFileSync(join(path, "rows.plan"), changed);
  await counted(page, countOf(join(path, "rows.plan")).kept);
  assert.equal(await text(page), changed);
  await write(page, {over: "20m in", typed: "18m in"});
  writeFileSync(join(path, "rows.plan"), ROWS);
  await page.getByRole("button", {name: "Reload it"}).click();
  assert.equal(await text(page), ROWS);
});

test("a folder for reading alone", only, async (t) => {
  const path = folder(t, {"rows.plan": ROWS});
  const {address} = await serve(t, path, "--read-only");
  const page = await visit(t, address);
  await counted(page, countOf(join(path, "rows.plan")).kept);
  await page.getByText("read-only").waitFor();
  assert.equal(await page.getByRole("button", {name: "Save"}).count(), 0);
  await page.keyboard.press("Control+s");
  await page.locator(".cm-content").focus();
  await page.keyboard.type("x");
  assert.equal(await text(page), ROWS);
});

test("a link is opened again, and another in the same window", {skip: PLAYGROUND === null}, async (t) => {
  const path = folder(t, {"rows.plan": ROWS});
  const {address} = await serve(t, path);
  const page = await visit(t, address);
  await counted(page, countOf(join(path, "rows.plan")).kept);
  await write(page, {over: "trays 3..6", typed: "trays 3..5"});
  await save(page);
  const kept = countOf(join(path, "rows.plan")).kept;
  await counted(page, kept);
  const link = page.url();
  assert.notEqual(link, address);
  const another = await visit(t, link);
  await counted(another, kept);
  await another.evaluate((hash) => (location.hash = hash), new URL(address).hash);
  await another.waitForFunction(() => document.querySelector(".editor").shadowRoot.querySelector(".cm-content").textContent.includes("trays 3..6"));
});
