// Films the three first tasks and a rule that is drawn, from an empty folder and an empty profile, and a form, and makes the pictures of
// docs/studio.md:
// node pictures.mjs FOLDER. Prints what each task took, without the time of whoever thinks.
import {mkdirSync, mkdtempSync, rmSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {join, resolve} from "node:path";
import {counted, countOf, done, save, serve, visit} from "./studio.mjs";

const out = resolve(process.argv[2] ?? "pictures");
mkdirSync(out, {recursive: true});
const work = [];
const t = {after: (end) => work.push(end)};
const folder = mkdtempSync(join(tmpdir(), "tartan-studio-"));
const {address} = await serve(t, folder);
const page = await visit(t, address, {width: 1280, height: 800});
let shots = 0;
const shot = (name) => page.screenshot({path: join(out, `${String(++shots).padStart(2, "0")}-${name}.png`)});
let began = performance.now();
const lap = (task) => {
  console.log(`${task}: ${((performance.now() - began) / 1000).toFixed(1)} s`);
  began = performance.now();
};
const settled = () => page.waitForTimeout(600);

await page.getByRole("button", {name: "A row of rooms"}).first().waitFor();
await shot("empty-folder");
await page.getByRole("button", {name: "A row of rooms"}).first().click();
await page.locator("#count").waitFor();
await save(page);
await counted(page, countOf(join(folder, "rows.plan")).kept);
lap("an empty folder, and a text that works");
await settled();
await shot("a-row-of-rooms");

began = performance.now();
await page.locator(".sheet .card").nth(1).click();
await page.getByRole("button", {name: "Watch this plan"}).click();
await page.getByRole("button", {name: "Watched"}).waitFor();
await page.getByRole("button", {name: "Close", exact: true}).click();
await page.getByRole("button", {name: "Add a rule"}).click();
await page.getByLabel("Which tray").selectOption("stair");
await shot("add-a-rule");
await page.getByRole("button", {name: "Add it"}).click();
await page.locator(".clauses").getByRole("button", {name: "stair-in-the-middle", exact: true}).waitFor();
lap("only plans with a stair in the middle");
await settled();
await shot("a-stair-in-the-middle");

began = performance.now();
await page.locator(".watched .card").first().click();
await page.locator(".why .verdict").waitFor();
await page.locator(".why .part").first().hover();
lap("why a plan that one liked is gone");
await settled();
await shot("why-it-is-gone");
await page.getByRole("button", {name: "Close", exact: true}).click();

began = performance.now();
await page.getByRole("tab", {name: "Measures"}).click();
await page.getByRole("heading", {name: "What one more tray does to it"}).waitFor();
lap("what one more bay costs");
await page.getByRole("heading", {name: "What one more tray does to it"}).scrollIntoViewIfNeeded();
await settled();
await shot("one-more-bay");
await page.getByRole("tab", {name: "What changed"}).click();
await page.locator(".totals").waitFor();
await settled();
await shot("what-changed");
await page.getByRole("tab", {name: "Open plan"}).click();
await page.locator("#value-use-hall").click();
await settled();
await shot("open-plan");

await page.locator(".file-name").click();
await page.locator(".starts").getByRole("button", {name: "LaHave houses"}).click();
await page.locator("#count").waitFor();
await page.getByRole("tab", {name: "Rule", exact: true}).click();
const drawn = (text) => page.locator('.rule-drawing[aria-busy="false"]').and(page.locator(`:has-text("${text}")`)).waitFor();
const part = (number) => page.locator(`.rule-stage svg [data-part="${number}"]`).first();
const middle = async (locator, [x, y] = [0.5, 0.5]) => {
  await locator.waitFor();
  const box = await locator.evaluate((element) => element.getBoundingClientRect().toJSON());
  return [box.x + box.width * x, box.y + box.height * y];
};
const drag = async (what, number, place, over) => {
  await page.mouse.move(...(await middle(page.locator(`#palette-${what}`))));
  await page.mouse.down();
  await page.mouse.move(...(await middle(part(number), place)), {steps: 5});
  if (over) await shot(over);
  await page.mouse.up();
};
const sign = async (number, field, text) => {
  await page.mouse.click(...(await middle(part(number).locator(`:scope > [data-item="${field}"]`), [0.3, 0.5])));
  await drawn(text);
};
await part(0).waitFor();
await settled();
began = performance.now();
await page.locator("#new-rule").click();
await page.getByRole("button", {name: "Make it"}).click();
await drawn("any tray");
await drag("neighbour", 0);
await drawn("a row");
await drag("any", 1, [0.96, 0.5], "where-it-lands");
await part(2).waitFor();
await sign(1, 4, "machine dense");
await sign(2, 4, "machine dense");
await sign(2, 0, "4'");
await page.getByRole("button", {name: "Leave such plans out"}).click();
await page.getByText(/^It leaves out/).waitFor();
lap("a rule drawn without typing");
await page.locator(".library").evaluate((room) => room.scrollTo(0, 0));
await settled();
await page.waitForTimeout(4000); // what is said at the bottom goes
await shot("a-rule-as-a-picture");

const TANGLE = `# The tangle cube of the standard library, drawn out and turned.
use "primitives"

surface tangle "a cube of handles" =
  blobby at (0.8*x + 0.25*z, 1.1*y, z - 0.25*x)

box (-8, -8, -8)..(8, 8, 8)
grid 80
`;
const forms = mkdtempSync(join(tmpdir(), "tartan-studio-"));
writeFileSync(join(forms, "tangle.field"), TANGLE);
const shown = await visit(t, (await serve(t, forms)).address, {width: 1280, height: 800});
await shown.locator(".form-stage[data-frames]").waitFor();
await shown.waitForTimeout(600);
await shown.screenshot({path: join(out, `${String(++shots).padStart(2, "0")}-a-form.png`)});

for (const end of work.reverse()) await end();
await done();
rmSync(forms, {recursive: true, force: true});
rmSync(folder, {recursive: true, force: true});
