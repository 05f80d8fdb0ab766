import assert from "node:assert/strict";
import test from "node:test";
import {rangeAbout, rangeOf, within, written} from "../src/sliders";
import {requirement, spelled} from "../src/measures";
import {item, pattern} from "../src/open_plan";
import type {ShownSchema} from "../src/requests";

test("what a slider goes between", () => {
  assert.deepEqual(rangeOf({value: "20m", least: "12m", most: "30m"}), {from: 12, to: 30, step: 0.1, places: 1, unit: "m"});
  assert.deepEqual(rangeOf({value: "1", least: "0", most: "3"}), {from: 0, to: 3, step: 1, places: 0, unit: ""});
  assert.deepEqual(rangeOf({value: "28'", least: "20'", most: "60'"})?.unit, "'");
  assert.equal(rangeOf({value: "7'-9\"", least: "7'", most: "9'"}), null);
  assert.equal(rangeOf({value: "20m", least: "12'", most: "30'"}), null);
  const metres = rangeOf({value: "20m", least: "12m", most: "30m"})!;
  assert.equal(written(18.5, metres), "18.5m");
  assert.equal(written(30, metres), "30m");
});

test("what a slider goes between where nothing bounds it", () => {
  assert.deepEqual(rangeAbout("30"), {from: 0, to: 60, step: 1, places: 0, unit: ""});
  assert.deepEqual(rangeAbout("2"), {from: 0, to: 10, step: 1, places: 0, unit: ""});
  assert.deepEqual(rangeAbout("0.25"), {from: 0, to: 0.5, step: 0.01, places: 2, unit: ""});
  assert.deepEqual(rangeAbout("1.5"), {from: 0, to: 3, step: 0.01, places: 2, unit: ""});
  assert.deepEqual(rangeAbout("-4"), {from: -10, to: 0, step: 1, places: 0, unit: ""});
  assert.equal(rangeAbout("[.75]"), null);
  assert.ok(within(rangeAbout("30")!, "60"));
  for (const text of ["61", "-1", "30.5", "30mm", "thirty"]) assert.equal(within(rangeAbout("30")!, text), false);
});

test("values of measures in the words of the file", () => {
  assert.deepEqual(spelled("7/2", ""), {times: "", value: "3.5"});
  assert.deepEqual(spelled("1/3", "m2"), {times: "3 * ", value: "1m2"});
  assert.deepEqual(spelled("12", "ft"), {times: "", value: "12'"});
  assert.equal(requirement("cost", "", {from: "100", to: "110"}), "cost >= 100 and cost < 110");
  assert.equal(requirement("area", "sf", {value: "96"}), "area = 96sf");
});

test("open plans as patterns", () => {
  const schema = {fields: [{name: "use", kind: "choice", values: []}, {name: "lit", kind: "flag", values: []}, {name: "back", kind: "zone", values: []}]} as unknown as ShownSchema;
  assert.equal(pattern(schema, [{}, {use: "stair", lit: "-", back: "dense:2m"}]), "? | tray(use stair, not lit, back dense 2m)");
  assert.equal(item(schema.fields[1], "lit"), "lit");
});
