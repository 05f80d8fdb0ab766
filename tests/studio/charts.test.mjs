// What is drawn of measures can be clicked, and does what the tables beside it do.
import assert from "node:assert/strict";
import test, {after} from "node:test";
import {dirname, join} from "node:path";
import {fileURLToPath} from "node:url";
import {ROWS, countOf, counted, done, folder, inspected, read, serve, tartan, visit} from "./studio.mjs";

const COTTAGE = join(dirname(fileURLToPath(import.meta.url)), "../../stdlib/cottage.plan");

after(done);

async function measures(t) {
  const path = folder(t, {"rows.plan": ROWS});
  const {address} = await serve(t, path);
  const page = await visit(t, address);
  const file = join(path, "rows.plan");
  await counted(page, countOf(file).kept);
  await page.getByRole("tab", {name: "Measures"}).click();
  return {page, file};
}

test("a bar shows the plans that have its value", async (t) => {
  const {page, file} = await measures(t);
  await page.locator("#measure-by").selectOption("rooms");
  const {distribution} = countOf(file, "--by", "rooms", "--bins", "16");
  const last = distribution.length - 1;
  const chart = page.getByRole("img", {name: "How many plans have which rooms"});
  await chart.locator(`[data-bar="${last}"]`).waitFor();
  assert.equal(await chart.locator("[data-bar]").count(), distribution.filter(({plans}) => plans !== "0").length);
  await inspected(page, "measures");
  // a place where nothing is drawn, above the lowest bar
  await chart.locator(`[data-bar="${last}"]`).click({position: {x: 4, y: 4}});
  await page.getByRole("button", {name: "Only plans with rooms 4 to 4.5"}).waitFor();
  assert.equal(await page.locator(".sheet .card").count(), Math.min(12, Number(distribution[last].plans)));
});

test("a point of a front shows one of its plans", async (t) => {
  const {page, file} = await measures(t);
  await page.getByLabel("against").selectOption("rooms");
  const {points} = JSON.parse(tartan("pareto", file, "--least", "cost", "--least", "rooms", "--json"));
  await page.locator(`.chart [data-point="${points.length - 1}"]`).waitFor();
  assert.equal(await page.locator(".chart [data-point]").count(), points.length);
  await page.locator('.chart [data-point="0"]').click();
  await page.getByRole("heading", {name: "One plan"}).waitFor();
  await page.locator(".why .verdict.kept").waitFor();
});

test("a house of a sheet is shown", async (t) => {
  const path = folder(t, {"cottage.plan": read(COTTAGE)});
  const {address} = await serve(t, path);
  const page = await visit(t, address);
  const houses = page.locator(".sheet .whole [data-house]");
  await houses.first().waitFor();
  const cards = page.locator(".sheet .card");
  assert.equal(await houses.count(), await cards.count());
  const file = join(path, "cottage.plan");
  for (const i of [0, 5]) {
    const [number] = /#[0-9]+/.exec(await houses.nth(i).textContent());
    assert.equal(await cards.nth(i).getAttribute("data-line"), tartan("unrank", file, number, "--library", "cottages").trim(), `house ${i} is the one of its line`);
  }
  await inspected(page, "houses");
  const line = await cards.nth(2).getAttribute("data-line");
  await houses.nth(2).click();
  await page.getByRole("heading", {name: "One house"}).waitFor();
  await page.getByText(line).first().waitFor();
});
