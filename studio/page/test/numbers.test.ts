import assert from "node:assert/strict";
import test from "node:test";
import {counted, decimal, grouped, minus, percent, plans, rounded, share} from "../src/numbers";

test("digits are grouped, however many", () => {
  assert.equal(grouped("14252657920"), "14,252,657,920");
  assert.equal(grouped("15265742528021225472"), "15,265,742,528,021,225,472");
  assert.equal(grouped("12"), "12");
  assert.equal(grouped("-1234.5"), "−1,234.5");
  assert.equal(counted(null), "too many to count");
  assert.equal(plans("1"), "1 plan");
  assert.equal(plans("2000"), "2,000 plans");
});

test("long counts are told in few letters", () => {
  assert.equal(rounded("9999999"), "9,999,999");
  assert.equal(rounded("14252657920"), "14.25 billion");
  assert.equal(rounded("71755065638281866240000"), "71.75 sextillion");
  assert.equal(rounded("123456789"), "123.4 million");
  assert.equal(rounded("1".repeat(40)), "1.11 × 10^39");
});

test("shares of counts past what a double holds", () => {
  assert.equal(share("7632871264010612736", "15265742528021225472"), 0.5);
  assert.equal(percent("1", "15265742528021225472"), "<0.01%");
  assert.equal(percent("999999", "1000000"), "99%");
  assert.equal(percent("0", "5"), "none");
  assert.equal(percent("5", "5"), "all");
});

test("fractions are written as decimals, rounded", () => {
  assert.equal(decimal("7/2"), "3.5");
  assert.equal(decimal("-1/3"), "−0.33");
  assert.equal(decimal("2/3"), "0.67");
  assert.equal(decimal("1000"), "1,000");
  assert.equal(decimal("0.125"), "0.13");
  assert.equal(decimal(null), "–");
  assert.equal(decimal(minus("7/2", "1/2")), "3");
  assert.equal(decimal("-1/1000"), "0");
});
