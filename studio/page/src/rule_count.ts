// The condition of what is counted, such as `n >= 2`, as a choice and a number.
import {h} from "./dom";

export interface Count {
  name: string; // of what is counted
  compares: string;
  number: number;
}

export const COMPARISONS: [string, string][] = [
  [">=", "at least"],
  ["<=", "at most"],
  ["=", "exactly"],
  [">", "more than"],
  ["<", "fewer than"],
  ["!=", "not"],
];

// Null for a condition that says more than that, such as `n in 2..4` or one about lengths.
export function countOf(condition: string): Count | null {
  const found = /^\s*([A-Za-z][\w-]*)\s*(>=|<=|!=|=|>|<)\s*(\d{1,9})\s*$/.exec(condition);
  return found && {name: found[1], compares: found[2], number: Number(found[3])};
}

export function conditionOf({name, compares, number}: Count): string {
  return `${name} ${compares} ${number}`;
}

// The choice, and a number between two buttons; `set` gets what is chosen.
export function countControl(condition: string, set: (condition: string) => void): HTMLElement | null {
  const count = countOf(condition);
  if (!count) return null;
  const choice = h("select", {id: "rule-compares", "aria-label": "How the number is compared", onchange: () => set(conditionOf({...count, compares: choice.value}))},
    COMPARISONS.map(([sign, label]) => h("option", {value: sign, selected: sign === count.compares}, label)));
  const step = (by: number, label: string, sign: string) => h("button", {
    type: "button", id: `rule-count-${by}`, class: "step", "aria-label": label, disabled: count.number + by < 0,
    onclick: () => set(conditionOf({...count, number: count.number + by})),
  }, sign);
  return h("div", {class: "count-control"}, choice, step(-1, "one less", "−"), h("output", {"aria-live": "polite"}, String(count.number)), step(1, "one more", "+"));
}
