// A wrong rule and its fix; counts and differences are the command's.
import assert from "node:assert/strict";
import test, {after} from "node:test";
import {writeFileSync} from "node:fs";
import {join} from "node:path";
import {ROWS, countOf, counted, done, folder, inspected, openFile, read, save, serve, tartan, text, visit, write} from "./studio.mjs";

after(done);

test("a wrong name is told at its place, and the fix is taken", async (t) => {
  const path = folder(t, {"rows.plan": ROWS});
  const {address} = await serve(t, path);
  const page = await visit(t, address);
  const kept = countOf(join(path, "rows.plan")).kept;
  await counted(page, kept);
  await write(page, {over: "prune narrow-hall", typed: "prune narow-hall"});
  const trouble = page.locator(".trouble-bar");
  await trouble.getByText("narow-hall").waitFor();
  await page.locator(".cm-lintRange-error").waitFor();
  assert.equal(await page.locator(".sheet .card svg").count(), 12, "the plans that were there stay");
  await inspected(page, "a text with an error");
  await trouble.getByRole("button", {name: "Show it"}).click();
  await page.keyboard.press("F8");
  await page.locator(".cm-lintRange-error").hover();
  await page.locator(".cm-diagnosticAction").first().click();
  await page.waitForFunction(() => document.querySelector(".trouble-bar").hidden);
  assert.equal(await text(page), ROWS);
  await counted(page, kept);
});

test("counts and differences are the command's", async (t) => {
  const path = folder(t, {"rows.plan": ROWS, "before.plan": ROWS});
  const {address} = await serve(t, path);
  const page = await visit(t, address);
  await openFile(page, "rows.plan");
  await counted(page, countOf(join(path, "rows.plan")).kept);
  await write(page, {over: "tray(hall, 3m)", typed: "tray(hall, width < 6m)"});
  const changed = ROWS.replace("tray(hall, 3m)", "tray(hall, width < 6m)");
  const copy = join(path, "copy.plan");
  writeFileSync(copy, changed);
  const answer = countOf(copy);
  await counted(page, answer.kept);
  const lengths = await page.locator(".lengths tbody tr").evaluateAll((rows) => rows.map((row) => row.querySelector(".num").textContent.replaceAll(",", "")));
  assert.deepEqual(lengths, answer.by_length.map((row) => row.kept));
  await page.getByRole("tab", {name: "What changed"}).click();
  const {total} = JSON.parse(tartan("diff", join(path, "before.plan"), copy, "--json"));
  await page.locator(".totals .gone dd").waitFor();
  const told = await page.locator(".totals dd").evaluateAll((cells) => cells.map((cell) => cell.textContent.replaceAll(",", "")));
  assert.deepEqual(told, [total.removed, total.added, total.kept]);
  assert.match(await page.locator(".changed").textContent(), /narrow-hall is changed/);
  await inspected(page, "what changed");
  await save(page);
  await page.getByText("Nothing has changed since the file was saved.").waitFor();
});

test("what is saved has the command's bytes", async (t) => {
  const path = folder(t, {"rows.plan": 'use "lahave"\n\nlibrary small "houses of two trays" using lahave {\n  trays 1..2\n  prune narrow-pair, dense-end\n}\n'});
  const {address} = await serve(t, path);
  const page = await visit(t, address);
  await page.locator(".sheet .card svg").first().waitFor();
  const saved = async (what) => {
    const [file] = await Promise.all([page.waitForEvent("download"), page.getByLabel("Save a copy of").selectOption(what)]);
    return read(await file.path());
  };
  for (const [what, name, ...words] of [["svg", "out.svg", "draw", "--sample", "12", "--seed", "0"], ["pl", "out.pl", "export", "--prolog"]]) {
    const [command, ...options] = words;
    tartan(command, join(path, "rows.plan"), ...options, "-o", join(path, name));
    const same = (text) => text.replaceAll(path + "/", "").replaceAll("/rows.plan", "rows.plan");
    assert.equal(same(await saved(what)), same(read(join(path, name))), what);
  }
});

test("to a definition in the standard library, and back", async (t) => {
  const path = folder(t, {"small.plan": 'use "lahave"\n\nlibrary small using lahave {\n  trays 1..2\n  prune narrow-pair\n}\n'});
  const {address} = await serve(t, path);
  const page = await visit(t, address);
  await page.locator("#count").waitFor();
  await write(page, {after: "prune narrow-p", typed: ""});
  await page.keyboard.press("F12");
  await page.getByText("This file comes with Tartan.").waitFor();
  assert.match(await text(page), /^# The trays of the LaHave House grammar/);
  await inspected(page, "a file of the standard library");
  await page.getByRole("button", {name: "Back to small.plan"}).click();
  await page.locator("#count").waitFor();
  assert.match(await text(page), /^use "lahave"/);
});
