// Forms in space: a surface, a model, a design of boxes and growth are drawn, follow what is written, are turned by keys,
// and are saved with the command's bytes; what stands there without WebGL, and while the text is wrong.
import assert from "node:assert/strict";
import test, {after} from "node:test";
import {readFileSync, writeFileSync} from "node:fs";
import {dirname, join} from "node:path";
import {fileURLToPath} from "node:url";
import {PLAYGROUND, done, folder, inspected, openFile, read, serve, tartan, text, visit, write} from "./studio.mjs";

after(done);

const root = join(dirname(fileURLToPath(import.meta.url)), "../..");
const GATEHOUSE = read(join(root, "examples/gatehouse/gatehouse.kit"));
const EGG = "# An egg.\nsurface egg \"a ball, drawn out\" = pow(x/2, 2) + y*y + z*z - 1.5\nbox (-4, -4, -4) .. (4, 4, 4)\ngrid 30\n";

const form = async (page) => {
  if (page.viewportSize().width < 860) await page.getByRole("button", {name: "Form", exact: true}).click();
  await page.locator(".form-stage[data-frames]").waitFor();
};
const frames = (page) => page.locator(".form-stage").getAttribute("data-frames").then(Number);
const drawnSince = (page, before) => page.waitForFunction((many) => Number(document.querySelector(".form-stage").dataset.frames) > many, before);
const grouped = (number) => number.toLocaleString("en-US");

// The numbers that the command has for a mesh.
function measured(file, ...words) {
  const said = tartan("mesh", file, "--stats", ...words);
  return ["vertices", "triangles"].map((word) => Number(new RegExp(`^${word} +(\\d+)$`, "m").exec(said)[1]));
}

// And the page for that text.
async function sized(page, path, content) {
  const copy = join(path, "copy.field");
  writeFileSync(copy, content);
  const [vertices, triangles] = measured(copy);
  await page.locator(".form-size", {hasText: `${grouped(vertices)} vertices, ${grouped(triangles)} faces`}).waitFor();
  return vertices;
}

async function saved(page, format) {
  await page.getByLabel("Saved as").selectOption(format);
  const coming = page.waitForEvent("download");
  await page.getByRole("button", {name: "Save a copy"}).click();
  return readFileSync(await (await coming).path());
}

function made(path, command, name, format, ...words) {
  tartan(command, join(path, name), ...words, "-o", join(path, `made.${format}`));
  return readFileSync(join(path, `made.${format}`));
}

test("a surface follows what is written and a slider", async (t) => {
  const path = folder(t, {"egg.field": EGG});
  const {address} = await serve(t, path);
  const page = await visit(t, address);
  await form(page);
  const first = await sized(page, path, EGG);
  const picture = await page.locator(".form-stage").screenshot();
  let before = await frames(page);
  await write(page, {over: "x/2", typed: "x/3"});
  const second = await sized(page, path, EGG.replace("x/2", "x/3"));
  await drawnSince(page, before);
  assert.notEqual(first, second);
  const slider = page.locator(".setting", {hasText: "grid"}).locator("input");
  before = await frames(page);
  await slider.focus();
  for (let i = 0; i < 5; i++) await page.keyboard.press("ArrowRight");
  assert.match(await text(page), /^grid 35$/m);
  await sized(page, path, await text(page));
  await drawnSince(page, before);
  assert.notDeepEqual(await page.locator(".form-stage").screenshot(), picture);
  await page.locator(".cm-content").focus();
  for (let i = 0; i < 6; i++) await page.keyboard.press("Control+z");
  assert.equal(await text(page), EGG);
  await sized(page, path, EGG);
  await slider.scrollIntoViewIfNeeded();
  const {x, y, width, height} = await slider.boundingBox();
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + (3 * width) / 4, y + height / 2, {steps: 8});
  await page.mouse.up();
  assert.match(await text(page), /^grid 4\d$/m);
  await page.locator(".cm-content").focus();
  await page.keyboard.press("Control+z");
  assert.equal(await text(page), EGG, "a slider that was moved is one step");
});

test("while the text is wrong the last form stays, grey", async (t) => {
  const path = folder(t, {"egg.field": EGG});
  const {address} = await serve(t, path);
  const page = await visit(t, address);
  await form(page);
  await sized(page, path, EGG);
  const grey = () => page.locator(".form-stage canvas").evaluate((canvas) => getComputedStyle(canvas).filter === "grayscale(1)");
  assert.equal(await grey(), false);
  await write(page, {over: "y*y", typed: "y*"});
  await page.locator(".trouble-bar", {hasText: "Line 2"}).waitFor();
  await page.waitForFunction(() => getComputedStyle(document.querySelector(".form-stage canvas")).filter === "grayscale(1)");
  await sized(page, path, EGG);
  await inspected(page, "a form whose text is wrong");
  await page.keyboard.press("Control+z");
  await page.locator(".trouble-bar").waitFor({state: "hidden"});
  assert.equal(await grey(), false);
});

test("of what is typed fast the last is drawn", async (t) => {
  const path = folder(t, {"egg.field": EGG.replace("grid 30", "grid 160")});
  const {address} = await serve(t, path);
  const page = await visit(t, address);
  await form(page);
  for (let i = 0; i < 12; i++) await write(page, {after: "# An egg", typed: `${i}`});
  await write(page, {over: "1.5", typed: "1.7"});
  await sized(page, path, await text(page));
});

test("saved with the command's bytes, at the grid that is chosen", async (t) => {
  const path = folder(t, {"egg.field": EGG});
  const {address} = await serve(t, path);
  const page = await visit(t, address);
  await form(page);
  assert.deepEqual(await saved(page, "glb"), made(path, "mesh", "egg.field", "glb"));
  assert.deepEqual(await saved(page, "obj"), made(path, "mesh", "egg.field", "obj"));
  if (PLAYGROUND) {
    await page.getByLabel("Saved as").selectOption("stl");
    await page.getByRole("button", {name: "Save a copy"}).click();
    await page.locator(".spoken.on", {hasText: /meshes|STL/i}).waitFor();
  } else assert.deepEqual(await saved(page, "stl"), made(path, "mesh", "egg.field", "stl"));
  await page.locator(".form-number select").selectOption("50");
  const [vertices] = measured(join(path, "egg.field"), "--grid", "50");
  await page.locator(".form-size", {hasText: `${grouped(vertices)} vertices`}).waitFor();
  assert.deepEqual(await saved(page, "ply"), made(path, "mesh", "egg.field", "ply", "--grid", "50"));
});

test("a model of a kit", async (t) => {
  const path = folder(t, {"gatehouse.kit": GATEHOUSE});
  const {address} = await serve(t, path);
  const page = await visit(t, address);
  await form(page);
  await page.locator(".form-size", {hasText: "colours"}).waitFor();
  const parts = made(path, "place", "gatehouse.kit", "ldr").toString().match(/^1 .*$/gm);
  await page.locator(".form-parts thead", {hasText: `${parts.length} parts`}).waitFor();
  const kinds = new Set(parts.map((part) => part.split(" ")[1] + part.split(" ").at(-1)));
  assert.equal(await page.locator(".form-parts tbody tr").count(), kinds.size);
  assert.deepEqual(await saved(page, "glb"), made(path, "place", "gatehouse.kit", "glb"));
  await page.locator(".form-number select").selectOption("3");
  await page.locator(".form-parts").waitFor();
  assert.deepEqual(await saved(page, "ldr"), made(path, "place", "gatehouse.kit", "ldr", "--seed", "3"));
  const before = await frames(page);
  await write(page, {over: "10 bricks, 1 stud);", typed: "12 bricks, 1 stud);"});
  await drawnSince(page, before);
});

test("growth and boxes; a study that is evolved says so", async (t) => {
  const path = folder(t, {
    "chair.solid": read(join(root, "examples/solids/chair.solid")),
    "square.hemls": read(join(root, "stdlib/square.hemls")),
    "canopy.study": read(join(root, "examples/growing-surfaces/canopy.study")),
    "four.study": read(join(root, "examples/breeding-fields/four.study")),
  });
  const {address} = await serve(t, path);
  const page = await visit(t, address);
  await openFile(page, "square.hemls");
  await page.locator(".form-size", {hasText: "289 vertices, 256 faces"}).waitFor();
  assert.deepEqual(await saved(page, "glb"), made(path, "grow", "square.hemls", "glb"));
  await page.locator(".form-number select").selectOption("5");
  await page.locator(".form-size", {hasText: "1,024 faces"}).waitFor();
  await openFile(page, "chair.solid");
  await page.locator(".form-size", {hasText: "colours"}).waitFor();
  assert.deepEqual(await saved(page, "glb"), made(path, "mesh", "chair.solid", "glb"));
  await openFile(page, "canopy.study");
  await page.locator(".form-size", {hasText: "561 vertices, 1,024 faces"}).waitFor();
  assert.deepEqual(await saved(page, "obj"), made(path, "grow", "canopy.study", "obj"));
  await openFile(page, "four.study");
  await page.locator(".form-nothing", {hasText: "tartan evolve"}).waitFor();
  assert.equal(await page.locator(".form-stage").isVisible(), false);
});

test("turned, moved and zoomed by keys, by buttons and by the mouse", async (t) => {
  const path = folder(t, {"gatehouse.kit": GATEHOUSE});
  const {address} = await serve(t, path);
  const page = await visit(t, address);
  await form(page);
  const stage = page.locator(".form-stage");
  const canvas = stage.locator("canvas");
  let seen = await stage.screenshot();
  const changes = async (what, work) => {
    const before = await frames(page);
    await work();
    await drawnSince(page, before);
    await page.waitForTimeout(100);
    const now = await stage.screenshot();
    assert.notDeepEqual(now, seen, what);
    seen = now;
  };
  await canvas.focus();
  for (const key of ["ArrowLeft", "ArrowUp", "Shift+ArrowRight", "Shift+ArrowDown", "+", "-"]) await changes(key, () => page.keyboard.press(key));
  for (const name of ["Above", "Front", "Side", "Larger", "Whole"]) await changes(name, () => page.getByRole("button", {name, exact: true}).click());
  const box = await canvas.boundingBox();
  const drag = async (button) => {
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down({button});
    await page.mouse.move(box.x + box.width / 2 + 60, box.y + box.height / 2 + 30, {steps: 4});
    await page.mouse.up({button});
  };
  await changes("dragged", () => drag("left"));
  await changes("moved", () => drag("right"));
  await changes("rolled", () => page.mouse.wheel(0, 240));
  const still = await frames(page);
  await page.waitForTimeout(400);
  assert.equal(await frames(page), still, "nothing is drawn while nothing changes");
});

test("turned by a finger", async (t) => {
  const path = folder(t, {"egg.field": EGG});
  const {address} = await serve(t, path);
  const page = await visit(t, address);
  await form(page);
  const before = await frames(page);
  await page.locator(".form-stage canvas").evaluate((canvas) => {
    const {x, y} = canvas.getBoundingClientRect();
    for (const [type, dx] of [["pointerdown", 100], ["pointermove", 130], ["pointermove", 160], ["pointerup", 160]])
      canvas.dispatchEvent(new PointerEvent(type, {pointerId: 1, pointerType: "touch", isPrimary: true, clientX: x + dx, clientY: y + 100, button: 0, bubbles: true}));
  }).catch(() => {});
  await drawnSince(page, before);
});

test("without WebGL there is a picture", async (t) => {
  const path = folder(t, {"egg.field": EGG});
  const {address} = await serve(t, path);
  const page = await visit(t, "about:blank");
  await page.addInitScript(() => {
    const begin = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
      return /webgl/.test(kind) ? null : begin.call(this, kind, ...more);
    };
  });
  await page.goto(address);
  await page.locator(".form figcaption", {hasText: "no WebGL"}).waitFor();
  assert.ok((await page.locator(".form svg path").count()) > 10);
  await inspected(page, "a picture of a form");
  await write(page, {over: "x/2", typed: "x/"});
  await page.locator(".trouble-bar", {hasText: "Line 2"}).waitFor();
});

for (const width of [1280, 390])
  for (const dark of [false, true])
    test(`a form ${width} points wide, ${dark ? "dark" : "light"}`, async (t) => {
      const path = folder(t, {"gatehouse.kit": GATEHOUSE});
      const {address} = await serve(t, path);
      const page = await visit(t, address, {width, dark});
      await page.locator(".cm-content").waitFor();
      await form(page);
      await page.locator(".part-settings").first().waitFor();
      await inspected(page, "a form");
    });
