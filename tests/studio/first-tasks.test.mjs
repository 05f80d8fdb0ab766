// What somebody who has never seen a rule wants first, done in an empty folder with the pointer alone.
import assert from "node:assert/strict";
import test, {after} from "node:test";
import {join} from "node:path";
import {countOf, counted, done, folder, inspected, save, serve, text, visit} from "./studio.mjs";

after(done);

async function begin(t) {
  const path = folder(t);
  const {address} = await serve(t, path);
  const page = await visit(t, address);
  await page.getByRole("button", {name: "A row of rooms"}).first().click();
  await page.locator("#count").waitFor();
  await save(page);
  return {page, file: join(path, "rows.plan")};
}

test("an empty folder says what to do", async (t) => {
  const {address} = await serve(t, folder(t));
  const page = await visit(t, address);
  await page.getByRole("heading", {name: "Rules for plans, and the plans that they keep"}).waitFor();
  assert.equal(new URL(page.url()).hash, "", "the token is out of the address");
  await inspected(page, "the beginning");
});

test("only plans with a stair in the middle are kept", async (t) => {
  const {page, file} = await begin(t);
  await counted(page, countOf(file).kept);
  assert.equal(await page.locator(".sheet .card svg").count(), 12, "twelve plans are drawn");
  await page.getByRole("button", {name: "Add a rule"}).click();
  await page.getByLabel("Which tray").selectOption("stair");
  await page.getByLabel("Where it stands").selectOption("in the middle");
  await inspected(page, "the dialog of a new rule");
  await page.getByRole("button", {name: "Add it"}).click();
  assert.match(await text(page), /require stair-in-the-middle\n/);
  await page.getByText("not saved").waitFor();
  await save(page);
  const answer = countOf(file);
  assert.ok(answer.requirements.some(({name}) => name === "stair-in-the-middle"));
  await counted(page, answer.kept);
});

test("why a plan that one likes is gone", async (t) => {
  const {page} = await begin(t);
  await page.getByRole("button", {name: "Ask about a plan"}).click();
  const field = page.getByLabel("The plan, tray by tray");
  await field.fill("room 4m | stair 4m | hall 6m");
  await field.press("Enter");
  await page.getByText("One clause leaves it out: a stair takes no more than 3 m.").waitFor();
  await page.getByRole("heading", {name: /^The nearest plan/}).waitFor();
  await page.locator(".why .part").first().hover();
  await page.locator(".large svg .lit").first().waitFor();
  await inspected(page, "one plan");
  await page.getByLabel("Add the plan as a case of a test").selectOption("rows must leave it out");
  assert.match(await text(page), /drop \[room 4m deep:6m \| stair 4m deep:6m \| hall 6m deep:6m\] by wide-stair\n\}/);
  await page.getByRole("button", {name: "Close", exact: true}).click();
  await page.getByRole("tab", {name: "Tests"}).click();
  await page.getByText("All 3 come out as they should.").waitFor();
});

test("what one more tray costs", async (t) => {
  const {page, file} = await begin(t);
  await page.getByRole("tab", {name: "Measures"}).click();
  await page.getByRole("heading", {name: "What one more tray does to it"}).waitFor();
  const least = [3, 4].map((length) => Number(countOf(file, "--by", "cost", "--trays", `${length}..${length}`).least));
  const row = page.locator(".by-length tbody tr").nth(1);
  assert.equal(await row.locator("td").nth(0).textContent(), String(least[1]));
  assert.equal(await row.locator("td").nth(1).textContent(), `+${least[1] - least[0]}`);
  await page.locator(".bins .link").first().click();
  await page.getByRole("button", {name: /^Only plans with cost/}).waitFor();
});
