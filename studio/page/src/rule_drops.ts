// Where something that is dragged over the picture of a rule lands, and the edit that it makes there.
import type {RuleEditRequest} from "./requests";
import {ROW_ONLY, childrenOf, indexOf, isWithin, parentOf, type Tree} from "./rule_parts";

export interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

// What is carried: a box for around a part, something written, or a part of the rule.
export type Carried = {box: string} | {text: string} | {from: number};

export type Operation = Omit<RuleEditRequest, "rule">;

export type Side = "left" | "right" | "above" | "below" | "whole";

export interface Landing {
  label: string;
  operation: Operation;
  part: number; // that it is about
  side: Side; // of that part
}

const FRAME = 5; // points at the edge of a box that are beside it, not in it

const inside = (box: Box, x: number, y: number) => x >= box.x && x <= box.x + box.width && y >= box.y && y <= box.y + box.height;

// The innermost part at a place; the whole is also around itself.
export function partAt(boxes: Map<number, Box>, x: number, y: number): number {
  let found = 0;
  for (const [part, box] of boxes) if (part > found && inside(box, x, y)) found = part;
  return found;
}

// How near the place is to each side of the box, as a part of its width or height.
function nearest(box: Box, x: number, y: number): {side: Side; share: number} {
  const all: [Side, number][] = [
    ["left", (x - box.x) / box.width],
    ["right", (box.x + box.width - x) / box.width],
    ["above", (y - box.y) / box.height],
    ["below", (box.y + box.height - y) / box.height],
  ];
  const [side, share] = all.reduce((least, one) => (one[1] < least[1] ? one : least));
  return {side, share};
}

const isRowOnly = (carried: Carried): carried is {text: string} => "text" in carried && ROW_ONLY.includes(carried.text);

function given(carried: Carried): {text?: string; from?: number} {
  return "from" in carried ? {from: carried.from} : "text" in carried ? {text: carried.text} : {};
}

function into(carried: Carried, row: number, at: number): Operation {
  if ("from" in carried) return {operation: "move", part: row, at, from: carried.from};
  return {operation: "insert", part: row, at, ...given(carried)};
}

const AND = "and: both have to be there";
const OR = "or: one of them is enough";
const beside = (kind: string) => (kind === "neighbour" ? "beside it in the row" : kind === "or" ? OR : AND);

// A row is made around a part where something stands that only a row can have.
function inNewRow(rule: Tree, part: number, text: string, side: Side): Landing {
  const before = text === "beginning" || (text === "..." && side === "left");
  const parts = before ? [text, rule.parts[part].text] : [rule.parts[part].text, text];
  return {label: "beside it, in a row", operation: {operation: "text", part, text: `neighbour(${parts.join(", ")})`}, part, side: before ? "left" : "right"};
}

function atSide(rule: Tree, carried: Carried, part: number, side: Side): Landing | null {
  const parent = parentOf(rule, part);
  const before = side === "left" || side === "above";
  const across = side === "left" || side === "right";
  if (across && parent?.kind === "neighbour")
    return {label: beside("neighbour"), operation: into(carried, parent.number, indexOf(rule, part) + (before ? 0 : 1)), part, side};
  if (isRowOnly(carried)) return inNewRow(rule, part, carried.text, side);
  const by = across ? "and" : "or";
  return {label: across ? AND : OR, operation: {operation: "join", part, by, before, ...given(carried)}, part, side};
}

// In the place of a part that something else can stand for.
function instead(rule: Tree, carried: Carried, part: number): Landing | null {
  const parent = parentOf(rule, part);
  const landing = {label: "instead of it", part, side: "whole" as Side};
  if ("text" in carried && isRowOnly(carried) && parent?.kind !== "neighbour") return null;
  if ("text" in carried) return {...landing, operation: {operation: "text", part, text: carried.text}};
  if ("from" in carried && parent?.form === "places" && !isWithin(rule, carried.from, part) && !isWithin(rule, part, carried.from))
    return {...landing, operation: {operation: "move", part: parent.number, at: indexOf(rule, part), from: carried.from}};
  return null;
}

function onLeaf(rule: Tree, boxes: Map<number, Box>, carried: Carried, part: number, x: number, y: number): Landing | null {
  const {side, share} = nearest(boxes.get(part)!, x, y);
  return (share > 0.3 ? instead(rule, carried, part) : null) ?? atSide(rule, carried, part, side);
}

// Which of a row's parts comes behind the place.
function inRow(rule: Tree, boxes: Map<number, Box>, carried: Carried, row: number, x: number, y: number): Landing {
  const {kind} = rule.parts[row];
  const parts = childrenOf(rule, row);
  const middle = (part: number) => {
    const box = boxes.get(part)!;
    return kind === "or" ? box.y + box.height / 2 < y : box.x + box.width / 2 < x;
  };
  const at = parts.filter(middle).length;
  const behind = at < parts.length;
  const sides: [Side, Side] = kind === "or" ? ["above", "below"] : ["left", "right"];
  return {label: beside(kind), operation: into(carried, row, at), part: behind ? parts[at] : parts[parts.length - 1], side: sides[behind ? 0 : 1]};
}

function inColumn(rule: Tree, boxes: Map<number, Box>, carried: Carried, distance: number, x: number): Landing | null {
  const off = (part: number) => Math.abs(boxes.get(part)!.x + boxes.get(part)!.width / 2 - x);
  const part = childrenOf(rule, distance).reduce((least, one) => (off(one) < off(least) ? one : least));
  return instead(rule, carried, part);
}

function inBox(rule: Tree, boxes: Map<number, Box>, carried: Carried, part: number, x: number, y: number): Landing | null {
  const {kind, form} = rule.parts[part];
  const box = boxes.get(part)!;
  const own = "from" in carried && rule.parts[carried.from].parent === part;
  if (own && form === "places" && kind !== "distance")
    return {label: `out of ${kind}`, operation: {operation: "unwrap", part, at: indexOf(rule, carried.from)}, part, side: "whole"};
  const edge = Math.min(x - box.x, box.x + box.width - x, y - box.y, box.y + box.height - y) < FRAME;
  if (!edge && form === "row") return inRow(rule, boxes, carried, part, x, y);
  if (!edge && kind === "distance") return inColumn(rule, boxes, carried, part, x);
  return atSide(rule, carried, part, nearest(box, x, y).side);
}

// Where what is carried lands if it is dropped at a place of the picture; null: nowhere, such as on itself.
export function landingAt(rule: Tree, boxes: Map<number, Box>, carried: Carried, x: number, y: number): Landing | null {
  const part = partAt(boxes, x, y);
  if ("box" in carried) return {label: `${carried.box} around it`, operation: {operation: "wrap", part, by: carried.box}, part, side: "whole"};
  if ("from" in carried && isWithin(rule, part, carried.from)) return null;
  const leaf = childrenOf(rule, part).length === 0;
  return leaf ? onLeaf(rule, boxes, carried, part, x, y) : inBox(rule, boxes, carried, part, x, y);
}

// All that can be done with what is carried at a part: what the keyboard chooses from.
export function landingsOn(rule: Tree, carried: Carried, part: number): Landing[] {
  if ("box" in carried) return [{label: `${carried.box} around it`, operation: {operation: "wrap", part, by: carried.box}, part, side: "whole"}];
  if ("from" in carried && isWithin(rule, part, carried.from)) return [];
  const found: (Landing | null)[] = [];
  const add = (label: string, landing: Landing | null) => found.push(landing && {...landing, label});
  const parts = childrenOf(rule, part);
  const end = isRowOnly(carried) && carried.text === "end";
  const beginning = isRowOnly(carried) && carried.text === "beginning";
  if (rule.parts[part].kind === "neighbour") {
    if (!end) add("first in this row", {label: "", operation: into(carried, part, 0), part: parts[0], side: "left"});
    if (!beginning) add("last in this row", {label: "", operation: into(carried, part, parts.length), part: parts[parts.length - 1], side: "right"});
  } else if (parentOf(rule, part)?.kind === "neighbour") {
    if (!end) add("before it in the row", atSide(rule, carried, part, "left"));
    if (!beginning) add("behind it in the row", atSide(rule, carried, part, "right"));
  } else if (isRowOnly(carried)) {
    add(beginning ? "before it, in a row" : "behind it, in a row", atSide(rule, carried, part, "right"));
  }
  if (!isRowOnly(carried)) {
    const join = (by: string): Landing => ({label: "", operation: {operation: "join", part, by, before: false, ...given(carried)}, part, side: by === "and" ? "right" : "below"});
    add(AND, join("and"));
    add(OR, join("or"));
  }
  add("instead of it", parts.length && "text" in carried && !parentOf(rule, part) ? null : instead(rule, carried, part));
  return found.filter((landing) => landing !== null);
}
