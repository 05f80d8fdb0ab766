import assert from "node:assert/strict";
import test from "node:test";
import {conditionOf, countOf} from "../src/rule_count";
import {choiceOf, itemOf} from "../src/rule_values";

const width = {name: "width", doc: "", zone: false, items: ["4'", "8'", "12'"]};
const body = {name: "body", doc: "", zone: true, items: ["body open", "body open 8'", "body dense"]};
const open = {name: "public", doc: "", zone: false, items: ["public", "not public"]};

test("an item is read as a choice of values", () => {
  assert.deepEqual(choiceOf(width, width.items, "4'"), {denied: false, values: ["4'"]});
  assert.deepEqual(choiceOf(width, width.items, "4' or 12'"), {denied: false, values: ["4'", "12'"]});
  assert.deepEqual(choiceOf(width, width.items, "not (4' or 12')"), {denied: true, values: ["4'", "12'"]});
  assert.deepEqual(choiceOf(body, body.items, "body  not dense"), {denied: true, values: ["body dense"]});
  assert.deepEqual(choiceOf(body, body.items, "not body dense"), {denied: true, values: ["body dense"]});
  assert.deepEqual(choiceOf(open, open.items, "not public"), {denied: false, values: ["not public"]});
  assert.equal(choiceOf(width, width.items, "4'..12'"), null, "a range is more than a choice");
});

test("a choice is written as an item", () => {
  assert.equal(itemOf(width, {denied: false, values: ["4'", "8'"]}), "4' or 8'");
  assert.equal(itemOf(width, {denied: true, values: ["4'", "8'"]}), "not (4' or 8')");
  assert.equal(itemOf(body, {denied: false, values: ["body open", "body dense"]}), "body open or dense");
  assert.equal(itemOf(body, {denied: true, values: ["body dense"]}), "body not dense");
  assert.equal(itemOf(width, {denied: false, values: []}), "");
});

test("a condition is a comparison and a number, or is left as it is written", () => {
  assert.deepEqual(countOf("n >= 2"), {name: "n", compares: ">=", number: 2});
  assert.equal(conditionOf({name: "n", compares: "<", number: 3}), "n < 3");
  for (const other of ["n in 2..4", "w > 12'", "2 <= n and n <= 4", "n mod 3 = 1"]) assert.equal(countOf(other), null);
});
