import assert from "node:assert/strict";
import test from "node:test";
import type {RulePartShown} from "../src/requests";
import {landingAt, landingsOn, partAt, type Box} from "../src/rule_drops";
import {depthOf, inFew, isWithin, type Tree} from "../src/rule_parts";
import {nextPart} from "../src/rule_walk";

const FORMS: Record<string, string> = {neighbour: "row", and: "row", or: "row", not: "places", distance: "places", quantity: "places"};

// A tree of kinds, each with the number of the part that it is in.
function tree(...parts: [kind: string, parent?: number][]): Tree {
  return {
    fields: [],
    parts: parts.map(([kind, parent], number) => ({number, parent, kind, form: FORMS[kind] ?? "leaf", text: kind, items: [], made: false}) as unknown as RulePartShown),
  };
}

const boxes = (...all: [number, number, number, number][]): Map<number, Box> => new Map(all.map(([x, y, width, height], part) => [part, {x, y, width, height}]));

const row = tree(["neighbour"], ["tray", 0], ["tray", 0]);
const rowBoxes = boxes([0, 0, 200, 100], [20, 20, 40, 60], [120, 20, 40, 60]);

test("the innermost part is pointed at", () => {
  assert.equal(partAt(rowBoxes, 30, 50), 1);
  assert.equal(partAt(rowBoxes, 90, 50), 0);
  assert.equal(partAt(rowBoxes, 900, 50), 0);
});

test("a box goes around the part under it", () => {
  assert.deepEqual(landingAt(row, rowBoxes, {box: "not"}, 30, 50)?.operation, {operation: "wrap", part: 1, by: "not"});
  assert.deepEqual(landingAt(row, rowBoxes, {box: "not"}, 90, 50)?.operation, {operation: "wrap", part: 0, by: "not"});
});

test("a part goes between those of a row", () => {
  const between = landingAt(row, rowBoxes, {text: "any"}, 90, 50)!;
  assert.deepEqual([between.operation, between.part, between.side], [{operation: "insert", part: 0, at: 1, text: "any"}, 2, "left"]);
  assert.deepEqual(landingAt(row, rowBoxes, {text: "any"}, 158, 50)?.operation, {operation: "insert", part: 0, at: 2, text: "any"});
  assert.deepEqual(landingAt(row, rowBoxes, {from: 1}, 180, 50)?.operation, {operation: "move", part: 0, at: 2, from: 1});
  assert.equal(landingAt(row, rowBoxes, {from: 1}, 30, 50), null, "not on itself");
});

test("beside a part stands `and`, below it `or`, in its middle what replaces it", () => {
  const one = tree(["tray"]);
  const box = boxes([0, 0, 40, 60]);
  assert.deepEqual(landingAt(one, box, {text: "any"}, 39, 30)?.operation, {operation: "join", part: 0, by: "and", before: false, text: "any"});
  assert.deepEqual(landingAt(one, box, {text: "any"}, 20, 2)?.operation, {operation: "join", part: 0, by: "or", before: true, text: "any"});
  assert.deepEqual(landingAt(one, box, {text: "any"}, 20, 30)?.operation, {operation: "text", part: 0, text: "any"});
  assert.deepEqual(landingAt(one, box, {text: "any"}, 120, 30)?.operation, {operation: "join", part: 0, by: "and", before: false, text: "any"});
});

test("what only a row can have makes one", () => {
  const one = tree(["tray"]);
  const box = boxes([0, 0, 40, 60]);
  for (const x of [2, 20, 38]) assert.deepEqual(landingAt(one, box, {text: "beginning"}, x, 30)?.operation, {operation: "text", part: 0, text: "neighbour(beginning, tray)"});
  assert.deepEqual(landingAt(one, box, {text: "end"}, 2, 30)?.operation, {operation: "text", part: 0, text: "neighbour(tray, end)"});
  assert.deepEqual(landingAt(row, rowBoxes, {text: "beginning"}, 21, 50)?.operation, {operation: "insert", part: 0, at: 0, text: "beginning"});
});

test("a part is dragged out of its box onto the box's frame, and into the places of a distance", () => {
  const not = tree(["not"], ["tray", 0]);
  assert.deepEqual(landingAt(not, boxes([0, 0, 100, 100], [30, 30, 40, 60]), {from: 1}, 4, 50)?.operation, {operation: "unwrap", part: 0, at: 0});
  const both = tree(["and"], ["tray", 0], ["distance", 0], ["any", 2], ["any", 2], ["quantity", 2], ["any", 5]);
  const placed = boxes([0, 0, 400, 100], [10, 20, 40, 60], [80, 10, 300, 80], [90, 20, 40, 60], [330, 20, 40, 60], [200, 15, 60, 70], [210, 20, 40, 60]);
  assert.deepEqual(landingAt(both, placed, {from: 1}, 110, 50)?.operation, {operation: "move", part: 2, at: 0, from: 1});
  assert.deepEqual(landingAt(both, placed, {from: 1}, 300, 16)?.operation, {operation: "move", part: 2, at: 1, from: 1});
});

test("the keyboard has all places", () => {
  assert.deepEqual(landingsOn(row, {text: "any"}, 1).map((landing) => landing.label), ["before it in the row", "behind it in the row", "and: both have to be there", "or: one of them is enough", "instead of it"]);
  assert.deepEqual(landingsOn(row, {text: "end"}, 0).map((landing) => landing.label), ["last in this row"]);
  assert.deepEqual(landingsOn(row, {from: 0}, 1), [], "nothing goes into itself");
});

test("arrows walk the tree", () => {
  const parts = tree(["and"], ["not", 0], ["tray", 1], ["tray", 0]);
  assert.deepEqual(["ArrowRight", "ArrowLeft", "ArrowDown", "ArrowUp", "Home", "End", "a"].map((key) => nextPart(parts, 1, key)), [2, 0, 2, 0, 0, 3, null]);
  assert.equal(nextPart(parts, 3, "ArrowRight"), null);
  assert.equal(nextPart(parts, 2, "ArrowDown"), null);
  assert.deepEqual([0, 1, 2, 3].map((part) => depthOf(parts, part)), [0, 1, 2, 1]);
  assert.ok(isWithin(parts, 2, 1) && !isWithin(parts, 3, 1));
  assert.equal(inFew(parts.parts[2]), "any tray");
});
