// Params as sliders: what they set stands in the text, and each is one step that can be undone.
import assert from "node:assert/strict";
import test, {after} from "node:test";
import {writeFileSync} from "node:fs";
import {join} from "node:path";
import {ROWS, countOf, counted, done, folder, inspected, serve, text, visit} from "./studio.mjs";

after(done);

test("three params, and undo", async (t) => {
  const path = folder(t, {"rows.plan": ROWS});
  const {address} = await serve(t, path);
  const page = await visit(t, address);
  await counted(page, countOf(join(path, "rows.plan")).kept);
  const slide = async (name, keys) => {
    const slider = page.locator(".setting", {hasText: name}).locator("input");
    await slider.focus();
    for (const key of keys) await page.keyboard.press(key);
  };
  await slide("how many stairs", ["ArrowRight"]);
  await slide("how long the row may be", ["End"]);
  await page.locator(".setting", {hasText: "where the hall is"}).locator("select").selectOption("right");
  const set = ROWS.replace("= 20m in", "= 30m in").replace("stairs\" = 1 in", "stairs\" = 2 in").replace("left | right | anywhere", "right | left | anywhere");
  assert.equal(await text(page), set);
  const copy = join(path, "copy.plan");
  writeFileSync(copy, set);
  await counted(page, countOf(copy).kept);
  await inspected(page, "settings");
  await page.locator(".cm-content").focus();
  for (let i = 0; i < 3; i++) await page.keyboard.press("Control+z");
  assert.equal(await text(page), ROWS);
  await counted(page, countOf(join(path, "rows.plan")).kept);
});
