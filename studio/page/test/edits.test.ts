import assert from "node:assert/strict";
import test from "node:test";
import {addCase, addRule, applied, bared, freeName, offsetOf} from "../src/edits";

const rows = `schema bay { use = room | stair  width = 3' | 12' }

# library rows { in a comment
library rows "rows of {bays}" using bay {
  trays 3..5
  prune tray(12') as wide "12' and more"
}
`;

test("places count bytes from 1", () => {
  assert.equal(offsetOf("ab\ncä\u{1F600}d", 2, 1), 3);
  assert.equal(offsetOf("ab\ncä\u{1F600}d", 2, 4), 5);
  assert.equal(offsetOf("ab\ncä\u{1F600}d", 2, 8), 7);
  assert.equal(offsetOf("ab", 9, 1), 2);
});

test("comments and quoted texts are blanks, lengths are not", () => {
  assert.equal(bared('a "b{" 2\'6" # }').length, 'a "b{" 2\'6" # }'.length);
  assert.ok(!bared('a "b{" 2\'6" # }').includes("{"));
  assert.ok(bared('tray(2\'6") {').includes("{"));
});

test("a rule goes before its library and its name inside", () => {
  const edits = addRule(rows, "rows", "require", {name: "middle", doc: "a stair", text: "tray(stair)"})!;
  const made = applied(rows, edits);
  assert.ok(made.includes('rule middle "a stair" =\n  tray(stair)\n\nlibrary rows'));
  assert.ok(made.includes('"12\' and more"\n  require middle\n}\n'));
  assert.equal(addRule(rows, "others", "prune", {name: "a", doc: "", text: "any"}), null);
});

test("a clause goes into a library of one line", () => {
  const made = applied("library a { trays 1..2 }", addRule("library a { trays 1..2 }", "a", "prune", {name: "b", doc: "c", text: "any"})!);
  assert.ok(made.endsWith("library a { trays 1..2\n  prune b\n}"));
});

test("a case goes into the test of its subject, or into a new one", () => {
  const first = applied(rows, [addCase(rows, "rows", "drop", "12' | 3'", "wide")]);
  assert.ok(first.endsWith("}\n\ntest rows {\n  drop [12' | 3'] by wide\n}\n"));
  const second = applied(first, [addCase(first, "rows", "keep", "3'")]);
  assert.ok(second.endsWith("  drop [12' | 3'] by wide\n  keep [3']\n}\n"));
});

test("names that are taken get a number", () => {
  assert.equal(freeName("rule middle = any", "middle"), "middle-2");
  assert.equal(freeName("rule middle-stair = any", "middle"), "middle");
});
