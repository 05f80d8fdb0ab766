// What a rule is made of, to be dragged onto its picture, or pressed to be put at the chosen part.
import {fill, h} from "./dom";
import type {RuleShown} from "./requests";
import {BOXES} from "./rule_actions";
import type {Carried} from "./rule_drops";

interface Thing {
  key: string;
  label: string;
  about: string;
  carried: Carried;
}

const THINGS: Thing[] = [
  {key: "any", label: "tray", about: "any tray; a click on its signs says which", carried: {text: "any"}},
  {key: "beginning", label: "beginning", about: "the beginning of the plan, first in a row", carried: {text: "beginning"}},
  {key: "end", label: "end", about: "the end of the plan, last in a row", carried: {text: "end"}},
  {key: "gap", label: "…", about: "any number of trays, in a row", carried: {text: "..."}},
];

export interface PaletteHooks {
  press: (event: PointerEvent, carried: Carried, label: string) => void;
  put: (carried: Carried, label: string) => void;
  say: (sentence: string) => void; // what is pointed at; empty: nothing
}

export class Palette {
  readonly element = h("div", {class: "palette", role: "group", "aria-label": "What a rule is made of"});
  private shape = "";

  constructor(private hooks: PaletteHooks) {}

  show(rule: RuleShown): void {
    const shape = JSON.stringify([rule.boxes, rule.names]);
    if (shape === this.shape) return;
    this.shape = shape;
    const focused = document.activeElement?.id;
    const boxes = rule.boxes.map((box): Thing => ({key: box, label: box, about: BOXES[box]?.about ?? "", carried: {box}}));
    const names = usable(rule).map((name): Thing => ({key: `rule-${name}`, label: name, about: `the rule ${name}`, carried: {text: name}}));
    const open = this.element.querySelector("details")?.open;
    fill(this.element,
      this.group("Parts", "thing", THINGS),
      names.length > 0 && h("details", {class: "palette-group", open}, h("summary", {class: "palette-title"}, names.length === 1 ? "One other rule" : `${names.length} other rules`), names.map((name) => this.item("name", name))),
      this.group("Boxes", "box", boxes));
    if (focused) document.getElementById(focused)?.focus();
  }

  private group(title: string, kind: string, things: Thing[]): HTMLElement {
    return h("div", {class: "palette-group", role: "group", "aria-label": title}, h("span", {class: "palette-title", "aria-hidden": "true"}, title), things.map((thing) => this.item(kind, thing)));
  }

  private item(kind: string, {key, label, about, carried}: Thing): HTMLElement {
    return h("button", {
      type: "button", id: `palette-${key}`, class: `palette-item ${kind}`, title: about,
      onpointerdown: (event: PointerEvent) => this.hooks.press(event, carried, label),
      onclick: () => this.hooks.put(carried, label),
      onpointerenter: () => this.hooks.say(`${label}: ${about}.`),
      onfocus: () => this.hooks.say(`${label}: ${about}.`),
      onpointerleave: () => this.hooks.say(""),
      onblur: () => this.hooks.say(""),
    }, label);
  }
}

// Rules, and the words of the rule's own parentheses; what a quantifier binds stands for a value, not for a part.
function usable(rule: RuleShown): string[] {
  const values = new Set(rule.parts.flatMap((part) => part.binds ?? []));
  return rule.names.filter(({name, means}) => means === "rule" || (means === "bound" && !values.has(name))).map(({name}) => name);
}
