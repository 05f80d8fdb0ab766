// The parts of a rule, as they are read: which are in which, and each in words.
import type {RulePartShown, RuleShown} from "./requests";

export type Tree = Pick<RuleShown, "parts" | "fields">;

export function childrenOf(rule: Tree, part: number): number[] {
  return rule.parts.filter((one) => one.parent === part).map((one) => one.number);
}

export function parentOf(rule: Tree, part: number): RulePartShown | null {
  const {parent} = rule.parts[part];
  return parent === undefined ? null : rule.parts[parent];
}

// Which of its parent's parts it is.
export function indexOf(rule: Tree, part: number): number {
  const {parent} = rule.parts[part];
  return parent === undefined ? 0 : childrenOf(rule, parent).indexOf(part);
}

// Is `part` the other part, or inside it?
export function isWithin(rule: Tree, part: number, other: number): boolean {
  for (let at: number | undefined = part; at !== undefined; at = rule.parts[at].parent) if (at === other) return true;
  return false;
}

export function depthOf(rule: Tree, part: number): number {
  let depth = 0;
  for (let at = rule.parts[part].parent; at !== undefined; at = rule.parts[at].parent) depth++;
  return depth;
}

export const isTray = (part: RulePartShown): boolean => part.kind === "tray" || part.kind === "any";

// What stands only in a row of neighbours.
export const ROW_ONLY = ["beginning", "end", "..."];

const NAMES: Record<string, string> = {
  any: "any tray",
  and: "both",
  or: "one or the other",
  not: "not",
  neighbour: "a row, side by side",
  symmetric: "this way or mirrored",
  quantity: "how many there are",
  occurrences: "at how many places",
  many: "one or more, each",
  optional: "with it or without",
  distance: "from, to, and what lies between",
  beginning: "the beginning of the plan",
  end: "the end of the plan",
  gap: "any number of trays",
  implies: "if, then",
  where: "where",
  every: "every",
  "every near": "every one near",
  sum: "a sum",
};

// A part in a few words.
export function inFew(part: RulePartShown): string {
  switch (part.kind) {
    case "tray":
      return part.items.length ? `a tray: ${part.items.map((item) => item.text).join(", ")}` : "any tray";
    case "name":
      return `the rule ${part.name}`;
    case "call":
      return `the rule ${part.name}, with what it asks for`;
    case "text":
      return part.text;
    case "quantity":
    case "occurrences":
    case "sum":
      return `${NAMES[part.kind]}: ${part.condition ?? ""}`;
    case "near":
      return part.relation ?? "near";
    case "some":
    case "each":
      return `${part.kind === "some" ? "some" : "every"} ${(part.binds ?? []).join(", ")} of ${part.name ?? ""}`;
    default:
      return NAMES[part.kind] ?? part.kind;
  }
}

// The values that a quantifier around the part binds to words, as items of a tray: "use u".
export function boundItems(rule: Tree, part: number, field: string): string[] {
  const items: string[] = [];
  for (let at = rule.parts[part].parent; at !== undefined; at = rule.parts[at].parent) {
    const {kind, name, binds} = rule.parts[at];
    if ((kind === "some" || kind === "each") && name === field) items.push(...(binds ?? []).map((word) => `${field} ${word}`));
  }
  return items;
}
