// Rules drawn as pictures: by mouse, by the keyboard alone, and what happens to the text meanwhile.
import assert from "node:assert/strict";
import test, {after} from "node:test";
import {dirname, join} from "node:path";
import {fileURLToPath} from "node:url";
import {PLAYGROUND, ROWS, done, folder, inspected, read, save, serve, text, visit, write} from "./studio.mjs";

after(done);

const LAHAVE = read(join(dirname(fileURLToPath(import.meta.url)), "../../stdlib/lahave.plan"));
const START = `use "lahave"

library small "short plans" using lahave {
  trays 2..3
  prune narrow-pair
}
`;

// What a rule says, its layout left out.
function saidBy(source, name) {
  const found = new RegExp(`^rule ${name}(?![\\w-])[^=]*?=([^#]*?)(?=^(?:rule|library|test|#)|$(?![^]))`, "m").exec(source);
  return found && found[1].trim().replace(/\s+/g, " ");
}

async function begin(t, {files = {"small.plan": START}, width = 1280, height = 1000, dark = false} = {}) {
  const {address} = await serve(t, folder(t, files));
  const page = await visit(t, address, {width, height, dark});
  await page.locator(".cm-content").waitFor();
  if (width < 860) await page.getByRole("button", {name: "Library", exact: true}).click();
  await page.locator("#count").waitFor();
  await page.getByRole("tab", {name: "Rule", exact: true}).click();
  return page;
}

// The text is as `wanted` says, and its picture is drawn.
async function becomes(page, name, wanted) {
  for (let i = 0; i < 100 && saidBy(await text(page), name) !== wanted; i++) await page.waitForTimeout(50);
  assert.equal(saidBy(await text(page), name), wanted);
  await page.locator('.rule-drawing[aria-busy="false"]:not(.old) svg').waitFor();
}

// The rule is chosen, and its picture is drawn.
async function chooses(page, name) {
  await page.locator("#rule-name").selectOption(name);
  await page.locator(`.rule-drawing[aria-busy="false"][aria-label="The rule ${name} as a picture"]`).waitFor();
}

async function newRule(page, name) {
  await page.locator("#new-rule").click();
  await page.locator("#new-rule-name").fill(name);
  await page.keyboard.press("Enter");
  await becomes(page, name, "any");
}

// ---- the mouse

const part = (page, number) => page.locator(`.rule-stage svg [data-part="${number}"]`).first();

// Where it is once it stays there: what is counted meanwhile may come to stand above it.
async function at(locator, [x, y] = [0.5, 0.5]) {
  const read = () => locator.evaluate((element) => {
    element.scrollIntoView({block: "nearest", inline: "nearest"});
    const {left, top, width, height} = element.getBoundingClientRect();
    return {left, top, width, height};
  });
  let box = await read();
  for (let i = 0; i < 40; i++) {
    await locator.page().waitForTimeout(50);
    const now = await read();
    if (now.top === box.top && now.left === box.left) break;
    box = now;
  }
  return [box.left + box.width * x, box.top + box.height * y];
}

async function drag(page, from, to, place) {
  const [x, y] = await at(from);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 9, y + 9);
  const [toX, toY] = await at(to, place);
  await page.mouse.move(toX, toY, {steps: 4});
  await page.mouse.up();
}

const palette = (page, key) => page.locator(`#palette-${key}`);
const put = (page, key, number, place) => drag(page, palette(page, key), part(page, number), place);

// Clicks a sign of a tray so often, each time when the one before is drawn.
async function click(page, name, number, field, wanted) {
  for (const said of wanted) {
    const [x, y] = await at(part(page, number).locator(`:scope > [data-item="${field}"]`), [0.3, 0.5]);
    await page.mouse.click(x, y);
    await becomes(page, name, said);
  }
}

const WIDTH = 0, HEIGHT = 1, MACHINE = 4, BODY = 5;
const LEFT = [0.04, 0.5], RIGHT = [0.96, 0.5], BELOW = [0.5, 0.97], MIDDLE = [0.5, 0.5];

test("the rules of Figure 8 by mouse", async (t) => {
  const page = await begin(t);

  await newRule(page, "a");
  await put(page, "neighbour", 0);
  await becomes(page, "a", "neighbour(any)");
  await put(page, "any", 1, RIGHT);
  await becomes(page, "a", "neighbour(any, any)");
  await click(page, "a", 1, WIDTH, ["neighbour(tray(4'), any)"]);
  await click(page, "a", 2, WIDTH, ["neighbour(tray(4'), tray(4'))"]);
  assert.equal(saidBy(await text(page), "a"), saidBy(LAHAVE, "narrow-pair"), "Fig. 8a");

  await newRule(page, "b");
  await put(page, "beginning", 0, LEFT);
  await becomes(page, "b", "neighbour(beginning, any)");
  await click(page, "b", 2, BODY, ["neighbour(beginning, tray(body open))", "neighbour(beginning, tray(body dense))"]);
  await put(page, "symmetric", 0, [0.5, 0.02]);
  await becomes(page, "b", saidBy(LAHAVE, "dense-end"));

  await newRule(page, "c");
  await click(page, "c", 0, WIDTH, ["tray(4')", "tray(8')", "tray(12')"]);
  await click(page, "c", 0, BODY, ["tray(12', body open)", "tray(12', body dense)"]);
  await put(page, "not", 0);
  await becomes(page, "c", "not tray(12', body dense)");
  await put(page, "any", 0, RIGHT);
  await becomes(page, "c", "not tray(12', body dense) and any");
  const both = (tray) => `not tray(12', body dense) and ${tray}`;
  await click(page, "c", 3, WIDTH, [both("tray(4')"), both("tray(8')"), both("tray(12')")]);
  await click(page, "c", 3, MACHINE, [both("tray(12', machine dense)"), both("tray(12', machine empty)")]);
  await put(page, "quantity", 3);
  await becomes(page, "c", both("quantity(tray(12', machine empty), n >= 1)"));
  await part(page, 3).locator("text").first().click();
  await page.locator("#rule-compares").selectOption("more than");
  await becomes(page, "c", saidBy(LAHAVE, "thin-totem"));

  await newRule(page, "d");
  await put(page, "distance", 0);
  await becomes(page, "d", "distance(from any, to any, by quantity(any, n >= 1))");
  const far = (from, to, by) => `distance(from ${from}, to ${to}, by quantity(${by}, n >= 1))`;
  await click(page, "d", 1, HEIGHT, [far("tray(single)", "any", "any")]);
  await click(page, "d", 2, MACHINE, [far("tray(single)", "tray(machine dense)", "any")]);
  await put(page, "any", 2, BELOW);
  const to = (other) => `tray(machine dense) or ${other}`;
  await becomes(page, "d", far("tray(single)", to("any"), "any"));
  await click(page, "d", 4, BODY, ["tray(body open)", "tray(body dense)"].map((other) => far("tray(single)", to(other), "any")));
  const by = (tray) => far("tray(single)", to("tray(body dense)"), tray);
  await click(page, "d", 6, WIDTH, ["tray(4')", "tray(8')", "tray(12')"].map(by));
  await click(page, "d", 6, MACHINE, ["tray(12', machine dense)", "tray(12', machine empty)"].map(by));
  await click(page, "d", 6, BODY, [by("tray(12', machine empty, body open)")]);
  await page.locator(".rule-drawing").press("ArrowUp");
  await page.getByRole("button", {name: "one more"}).click();
  await becomes(page, "d", saidBy(LAHAVE, "stranded"));
});

// ---- the keyboard

async function keys(page, ...pressed) {
  for (const key of pressed) await page.keyboard.press(key);
}

// Presses a key until what has the focus is what is looked for.
async function until(page, key, wanted) {
  for (let i = 0; i < 120; i++) {
    if (await page.evaluate(wanted.find, wanted.of)) return;
    await page.keyboard.press(key);
  }
  assert.fail(`${key} leads to ${JSON.stringify(wanted.of)}`);
}

const valueOf = (field, value) => ({of: [field, value], find: ([field, value]) => {
  const {activeElement: found} = document;
  return found.textContent === value && found.closest("fieldset")?.querySelector("legend").firstChild.textContent === field;
}});
const action = (id) => ({of: id, find: (id) => document.activeElement.id === id});
const labelled = (label) => ({of: label, find: (label) => document.activeElement.textContent === label || document.activeElement.getAttribute("aria-label") === label});

// Chooses values of the chosen tray and goes back to the picture.
async function values(page, name, ...chosen) {
  await page.keyboard.press("Enter");
  await page.locator(".rule-menu :focus").waitFor();
  for (const [field, value, said] of chosen) {
    await until(page, "ArrowDown", valueOf(field, value));
    await page.keyboard.press("Enter");
    await becomes(page, name, said);
  }
  await page.keyboard.press("Escape");
  await page.locator(".rule-drawing:focus").waitFor();
}

async function newByKeyboard(page, name) {
  await until(page, "Shift+Tab", action("new-rule"));
  await page.keyboard.press("Enter");
  await page.keyboard.insertText(name);
  await page.keyboard.press("Enter");
  await becomes(page, name, "any");
  await page.locator(".rule-drawing:focus").waitFor();
}

test("the rules of Figure 8 by the keyboard alone", async (t) => {
  const page = await begin(t);
  await page.locator("#tab-rule").focus();
  await until(page, "Tab", action("new-rule"));

  await newByKeyboard(page, "a");
  await keys(page, "r", "End");
  await values(page, "a", ["width", "4'", "neighbour(tray(4'))"]);
  await keys(page, "i", "End");
  await values(page, "a", ["width", "4'", saidBy(LAHAVE, "narrow-pair")]);

  await newByKeyboard(page, "b");
  await keys(page, "[", "End");
  await values(page, "b", ["body", "dense", "neighbour(beginning, tray(body dense))"]);
  await keys(page, "Home", "s");
  await becomes(page, "b", saidBy(LAHAVE, "dense-end"));

  await newByKeyboard(page, "c");
  await values(page, "c", ["width", "12'", "tray(12')"], ["body", "dense", "tray(12', body dense)"]);
  await keys(page, "n", "Home", "a", "End");
  const both = (tray) => `not tray(12', body dense) and ${tray}`;
  await values(page, "c", ["width", "12'", both("tray(12')")], ["machine", "empty", both("tray(12', machine empty)")]);
  await keys(page, "q", "End", "ArrowUp", "Enter");
  await page.locator("#rule-compares:focus").waitFor();
  await page.keyboard.press("m"); // of a list, what begins so
  await becomes(page, "c", saidBy(LAHAVE, "thin-totem"));
  await page.keyboard.press("Escape");

  await newByKeyboard(page, "d");
  const far = (from, to, by) => `distance(from ${from}, to ${to}, by quantity(${by}, n >= 1))`;
  await keys(page, "d", "Home", "ArrowRight");
  await values(page, "d", ["height", "single", far("tray(single)", "any", "any")]);
  await keys(page, "ArrowRight");
  await values(page, "d", ["machine", "dense", far("tray(single)", "tray(machine dense)", "any")]);
  await keys(page, "l", "Home", "ArrowRight", "ArrowRight", "ArrowRight", "ArrowRight");
  await values(page, "d", ["body", "dense", far("tray(single)", "tray(machine dense) or tray(body dense)", "any")]);
  const by = (tray) => far("tray(single)", "tray(machine dense) or tray(body dense)", tray);
  await keys(page, "End");
  await values(page, "d", ["width", "12'", by("tray(12')")], ["machine", "empty", by("tray(12', machine empty)")], ["body", "open", by("tray(12', machine empty, body open)")]);
  await keys(page, "ArrowUp", "Enter");
  await until(page, "Tab", labelled("one more"));
  await page.keyboard.press("Enter");
  await becomes(page, "d", saidBy(LAHAVE, "stranded"));
});

// ---- other things that a picture is used for

const BAY = ROWS.replace("library rows", `rule wide "a wide room beside a stair" =
  neighbour(tray(room, 6m), tray(stair))

library rows`);

test("a rule of another schema: boxes of words, values of each field, ranges, joined and denied", async (t) => {
  const page = await begin(t, {files: {"rows.plan": BAY}});
  await chooses(page, "wide");
  await part(page, 1).waitFor();
  await page.locator(".rule-drawing").focus();
  await keys(page, "Home", "ArrowRight");
  const menu = page.locator(".rule-menu");
  const field = (name) => menu.locator("fieldset", {has: page.locator("legend", {hasText: new RegExp(`^${name}`)})});
  await menu.getByRole("heading", {name: "a tray: room, 6m"}).waitFor();
  await field("use").getByRole("button", {name: "hall"}).click();
  await becomes(page, "wide", "neighbour(tray(room or hall, 6m), tray(stair))");
  await field("use").getByRole("button", {name: "not"}).click();
  await becomes(page, "wide", "neighbour(tray(not (room or hall), 6m), tray(stair))");
  await field("use").getByRole("button", {name: "any"}).click();
  await becomes(page, "wide", "neighbour(tray(6m), tray(stair))");
  await field("width").locator("summary").click();
  await field("width").getByRole("textbox").fill("width >=");
  await page.keyboard.press("Enter");
  await page.locator(".refusal", {hasText: "A length is missing."}).waitFor();
  await inspected(page, "a refusal");
  await field("width").getByRole("textbox").fill("width >= 4m");
  await page.keyboard.press("Enter");
  await becomes(page, "wide", "neighbour(tray(width >= 4m), tray(stair))");
  await page.getByRole("button", {name: "one more"}).isHidden();
  await page.getByText("its text").click();
  await page.getByLabel("The text of this part").fill("narrow-hall");
  await page.keyboard.press("Enter");
  await becomes(page, "wide", "neighbour(narrow-hall, tray(stair))");
});

test("parts are moved, pulled out and thrown away, and what cannot be is said", async (t) => {
  const page = await begin(t, {files: {"rows.plan": BAY}});
  await chooses(page, "wide");
  await part(page, 2).waitFor();
  await drag(page, part(page, 2), part(page, 1), LEFT);
  await becomes(page, "wide", "neighbour(tray(stair), tray(room, 6m))");
  await put(page, "symmetric", 1);
  await page.locator(".refusal", {hasText: "is for a neighbour"}).waitFor();
  await put(page, "not", 1);
  await becomes(page, "wide", "neighbour(not tray(stair), tray(room, 6m))");
  assert.ok(await page.locator(".refusal").isHidden());
  await drag(page, part(page, 2), part(page, 1), [0.5, 0.06]);
  await becomes(page, "wide", "neighbour(tray(stair), tray(room, 6m))");
  const [x, y] = await at(part(page, 1));
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 20, y + 20, {steps: 3});
  const [binX, binY] = await at(page.locator(".bin"));
  await page.mouse.move(binX, binY, {steps: 3});
  await page.mouse.up();
  await becomes(page, "wide", "neighbour(tray(room, 6m))");
  await page.locator(".palette summary").click();
  await drag(page, palette(page, "rule-narrow-hall"), part(page, 1), MIDDLE);
  await becomes(page, "wide", "neighbour(narrow-hall)");
  // By the keyboard: what is carried is put beside another part.
  await page.locator(".rule-drawing").focus();
  await keys(page, "Home", "a");
  await becomes(page, "wide", "neighbour(narrow-hall) and any");
  await keys(page, "End", "x", "Home", "ArrowRight", "ArrowRight", "Enter");
  await until(page, "ArrowDown", labelled("before it in the row"));
  await page.keyboard.press("Enter");
  await becomes(page, "wide", "neighbour(any, narrow-hall)");
  await keys(page, "End", "Delete", "Home", "e");
  await becomes(page, "wide", "any");
});

test("undo and redo, in the editor and beside it", async (t) => {
  const page = await begin(t, {files: {"rows.plan": BAY}});
  const before = await text(page);
  await chooses(page, "wide");
  await put(page, "not", 1);
  await becomes(page, "wide", "neighbour(not tray(room, 6m), tray(stair))");
  await put(page, "any", 3, RIGHT);
  await becomes(page, "wide", "neighbour(not tray(room, 6m), tray(stair), any)");
  await page.keyboard.press("Control+z");
  await becomes(page, "wide", "neighbour(not tray(room, 6m), tray(stair))");
  await page.locator("#rule-undo").click();
  await becomes(page, "wide", "neighbour(tray(room, 6m), tray(stair))");
  assert.equal(await text(page), before, "the same bytes");
  await page.locator("#rule-redo").click();
  await becomes(page, "wide", "neighbour(not tray(room, 6m), tray(stair))");
  await write(page, {over: "not tray", typed: "tray"});
  await becomes(page, "wide", "neighbour(tray(room, 6m), tray(stair))");
  await page.keyboard.press("Control+z");
  await becomes(page, "wide", "neighbour(not tray(room, 6m), tray(stair))");
  await page.locator(".rule-stage svg text", {hasText: /^not$/}).waitFor(); // the picture follows the editor
});

test("a rule that cannot be read keeps its last picture, in grey", async (t) => {
  const page = await begin(t, {files: {"rows.plan": BAY}});
  await chooses(page, "wide");
  await part(page, 2).waitFor();
  await write(page, {over: "6m), tray(stair))", typed: "6m), tray(stair"});
  await page.locator(".rule-drawing.old svg").waitFor();
  await page.getByText("This is the picture of the text as it was before.").waitFor();
  await page.locator(".trouble-bar").waitFor();
  await inspected(page, "an old picture");
  await part(page, 1).click();
  await write(page, {over: "6m), tray(stair", typed: "6m), tray(stair, 3m))"});
  await becomes(page, "wide", "neighbour(tray(room, 6m), tray(stair, 3m))");
  assert.ok(await page.locator(".rule-message").isHidden());
});

test("two windows on one file", {skip: PLAYGROUND ? "one page has no other window" : false}, async (t) => {
  const {address} = await serve(t, folder(t, {"rows.plan": BAY}));
  const pages = [];
  for (let i = 0; i < 2; i++) {
    const page = await visit(t, address);
    await page.locator("#count").waitFor();
    await page.getByRole("tab", {name: "Rule", exact: true}).click();
    await chooses(page, "wide");
    await part(page, 2).waitFor();
    pages.push(page);
  }
  await put(pages[0], "not", 2);
  await becomes(pages[0], "wide", "neighbour(tray(room, 6m), not tray(stair))");
  await save(pages[0]);
  await becomes(pages[1], "wide", "neighbour(tray(room, 6m), not tray(stair))");
  await pages[1].locator(".rule-stage svg text", {hasText: /^not$/}).waitFor();
});

test("what a rule does to the library, from the list of clauses and as a clause", async (t) => {
  const page = await begin(t, {files: {"rows.plan": BAY}});
  await page.getByRole("tab", {name: "Plans"}).click();
  await page.getByRole("button", {name: "narrow-hall as a picture"}).click();
  const effect = page.locator(".rule-effect");
  await effect.getByText(/^It leaves out [\d,]+ of [\d,]+ plans/).waitFor();
  const plan = await effect.locator(".card").getAttribute("title");
  assert.match(plan, /hall 3m/, "the plan that is shown is one that it leaves out");
  await chooses(page, "wide");
  await effect.getByText(/^No clause of rows asks for it/).waitFor();
  await effect.getByRole("button", {name: "Leave such plans out"}).click();
  assert.match(await text(page), /\n  prune wide\n}/);
  await effect.getByText(/^It leaves out [\d,]+ of/).waitFor();
});

test("the cursor of the editor chooses the rule", async (t) => {
  const page = await begin(t, {files: {"rows.plan": BAY}});
  await page.locator(".rule-stage svg").waitFor();
  await write(page, {after: "neighbour(tray(room, 6m), tray(sta", typed: ""});
  await page.waitForFunction(() => document.querySelector("#rule-name").value === "wide");
});

test("a file without a library has pictures of its rules all the same", async (t) => {
  const {address} = await serve(t, folder(t, {"only.plan": 'use "lahave"\nrule pair = neighbour(tray(4\'), tray(4\'))\n'}));
  const page = await visit(t, address);
  await part(page, 2).waitFor();
  await put(page, "not", 2);
  await becomes(page, "pair", "neighbour(tray(4'), not tray(4'))");
});

const FAR = `${START}
rule far "Fig. 8d" = # as the paper has it
  ${saidBy(LAHAVE, "stranded")}
`;

for (const width of [1280, 390])
  for (const dark of [false, true])
    test(`the picture in a window ${width} points wide, ${dark ? "dark" : "light"}`, async (t) => {
      const page = await begin(t, {files: {"small.plan": FAR}, width, height: 844, dark});
      await part(page, 4).waitFor();
      await page.locator(".rule-effect .rule-count").waitFor();
      await inspected(page, "the whole");
      await page.locator(".rule-drawing").focus();
      await keys(page, "End");
      await page.locator(".rule-menu fieldset").first().waitFor();
      await inspected(page, "a tray");
      await palette(page, "any").click();
      await page.getByRole("heading", {name: /Where does/}).waitFor();
      await inspected(page, "where something goes");
      await page.locator(".rule-menu").getByRole("button", {name: "leave it"}).click();
      await page.locator("#new-rule").click();
      await inspected(page, "a new rule");
    });
