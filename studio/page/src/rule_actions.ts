// What can be done with a part of a rule: each has a letter, a sentence and the edit that it makes.
import type {RuleShown} from "./requests";
import {landingsOn, type Operation} from "./rule_drops";
import {childrenOf, indexOf, parentOf} from "./rule_parts";

export interface Action {
  key: string;
  label: string;
  about: string;
  group: "box" | "beside" | "part";
  operation: Operation;
}

// What each box says, for those who do not know its word.
export const BOXES: Record<string, {key: string; about: string}> = {
  not: {key: "n", about: "plans that do not have what is in it"},
  symmetric: {key: "s", about: "a row, or its mirror image"},
  quantity: {key: "q", about: "counts the trays that are what is in it"},
  occurrences: {key: "o", about: "counts the places where what is in it stands"},
  many: {key: "m", about: "one tray or more in a row, each what is in it"},
  neighbour: {key: "r", about: "a row: what is in it stands side by side, in this order"},
  optional: {key: "p", about: "in a row: with this part or without it"},
  distance: {key: "d", about: "what lies between one tray and every other"},
};

export const DELETE = "Delete";

function boxes(rule: RuleShown, part: number): Action[] {
  return rule.boxes.map((box) => ({
    key: BOXES[box]?.key ?? "", label: box, about: BOXES[box]?.about ?? "", group: "box", operation: {operation: "wrap", part, by: box},
  }));
}

const BESIDE: {key: string; text: string; wanted: RegExp; label: string; about: string}[] = [
  {key: "i", text: "any", wanted: /^(behind it|last)/, label: "tray behind it", about: "in the row"},
  {key: "h", text: "any", wanted: /^(before it|first)/, label: "tray before it", about: "in the row"},
  {key: "a", text: "any", wanted: /^and/, label: "and a tray", about: "both have to be there, anywhere in the plan"},
  {key: "l", text: "any", wanted: /^or/, label: "or a tray", about: "one of them is enough"},
  {key: "[", text: "beginning", wanted: /^(before it|first)/, label: "beginning", about: "of the plan, before it"},
  {key: "]", text: "end", wanted: /^(behind it|last)/, label: "end", about: "of the plan, behind it"},
  {key: ".", text: "...", wanted: /^(behind it|last)/, label: "…", about: "any number of trays, behind it"},
];

function beside(rule: RuleShown, part: number): Action[] {
  return BESIDE.flatMap(({key, text, wanted, label, about}): Action[] => {
    const landing = landingsOn(rule, {text}, part).find((one) => wanted.test(one.label));
    return landing ? [{key, label, about, group: "beside", operation: landing.operation}] : [];
  });
}

function itself(rule: RuleShown, part: number): Action[] {
  const parent = parentOf(rule, part);
  const found: Action[] = [];
  const own = childrenOf(rule, part);
  if (parent) found.push({key: "u", label: "pull it out", about: `of ${parent.kind}, which goes`, group: "part", operation: {operation: "unwrap", part: parent.number, at: indexOf(rule, part)}});
  if (own.length === 1) found.push({key: "e", label: "take the box away", about: "what is in it stays", group: "part", operation: {operation: "unwrap", part, at: 0}});
  found.push({key: DELETE, label: "remove it", about: "", group: "part", operation: {operation: "remove", part}});
  return found;
}

export function actionsOn(rule: RuleShown, part: number): Action[] {
  if (rule.parts[part].made) return itself(rule, part);
  return [...beside(rule, part), ...boxes(rule, part), ...itself(rule, part)];
}
