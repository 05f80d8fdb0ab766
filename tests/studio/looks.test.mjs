// All rooms and panes in four windows: nothing on the console, nothing that an inspector of accessibility finds, nothing
// wider than the window; and the keyboard alone.
import assert from "node:assert/strict";
import test, {after} from "node:test";
import {join} from "node:path";
import {ROWS, countOf, counted, done, folder, inspected, serve, visit} from "./studio.mjs";

after(done);

for (const width of [1280, 390])
  for (const dark of [false, true])
    test(`${width} points wide, ${dark ? "dark" : "light"}`, async (t) => {
      const path = folder(t, {"rows.plan": ROWS, "houses.plan": 'use "lahave-houses"\nlibrary small using lahave from houses { trays 4..5 }\n'});
      const {address} = await serve(t, path);
      const page = await visit(t, address, {width, dark});
      await page.locator(".cm-content").waitFor();
      await page.locator(".file-name").click();
      await inspected(page, "the files");
      await page.locator(".files").getByRole("button", {name: "rows.plan"}).click();
      await page.locator(".file-name", {hasText: "rows.plan"}).waitFor();
      await inspected(page, "the text");
      if (width < 860) await page.getByRole("button", {name: "Library", exact: true}).click();
      await counted(page, countOf(join(path, "rows.plan")).kept);
      for (const pane of ["Plans", "Measures", "Open plan", "What changed", "Tests"]) {
        await page.getByRole("tab", {name: pane}).click();
        await page.waitForTimeout(700);
        await inspected(page, pane);
      }
      await page.getByRole("tab", {name: "Plans"}).click();
      await page.locator(".sheet .card").first().click();
      await page.locator(".why .verdict").waitFor();
      await inspected(page, "one plan");
    });

test("by the keyboard alone", async (t) => {
  const path = folder(t, {"rows.plan": ROWS});
  const {address} = await serve(t, path);
  const page = await visit(t, address);
  await counted(page, countOf(join(path, "rows.plan")).kept);
  const focused = () => page.evaluate(() => {
    const {activeElement: found} = document;
    return found.shadowRoot ? "the editor" : found.matches(".sheet .card") ? "a plan" : found.getAttribute("aria-label") || found.id || found.tagName;
  });
  const seen = [];
  for (let i = 0; i < 40 && !seen.includes("a plan"); i++) {
    await page.keyboard.press("Tab");
    if ((await focused()) === "the editor") await page.keyboard.press("Escape");
    seen.push(await focused());
  }
  assert.ok(seen.includes("a plan"), `a plan is reached: ${seen.join(", ")}`);
  await page.keyboard.press("Enter");
  await page.locator(".why .verdict").waitFor();
  await page.keyboard.press("Escape");
  assert.equal(await focused(), "a plan", "the plan has the focus again");
});
