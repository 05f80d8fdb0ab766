// What can be done with the chosen part of a rule: its values, its number, its text, the boxes and parts to add.
import {fill, h} from "./dom";
import type {RulePartShown, RuleShown} from "./requests";
import {actionsOn, type Action} from "./rule_actions";
import {countControl} from "./rule_count";
import {landingsOn, type Carried, type Landing, type Operation} from "./rule_drops";
import {inFew, isTray} from "./rule_parts";
import {Values} from "./rule_values";

export interface MenuHooks {
  act: (operation: Operation) => void;
  move: (part: number) => void;
  back: () => void; // the keyboard goes back to the picture
}

const GROUPS: [Action["group"], string][] = [["beside", "Add"], ["box", "Put it into"], ["part", "This part"]];

export class Menu {
  readonly element = h("aside", {class: "rule-menu", "aria-label": "The chosen part"});
  private values: Values;
  private opened = new Set<string>();

  constructor(private hooks: MenuHooks) {
    this.values = new Values(hooks.act);
    this.element.addEventListener("keydown", (event) => this.key(event));
    this.element.addEventListener("toggle", (event) => this.toggled(event.target as HTMLDetailsElement), true);
  }

  private toggled(details: HTMLDetailsElement): void {
    const {key} = details.dataset;
    if (!key) return;
    if (details.open) this.opened.add(key);
    else this.opened.delete(key);
  }

  private key(event: KeyboardEvent): void {
    if (event.key === "Escape") {
      event.stopPropagation();
      this.hooks.back();
    }
    const step = event.key === "ArrowDown" || event.key === "ArrowRight" ? 1 : event.key === "ArrowUp" || event.key === "ArrowLeft" ? -1 : 0;
    if (!step || (event.target as Element).matches("input, select")) return;
    const all = [...this.element.querySelectorAll<HTMLElement>("button:not(:disabled), summary, select")].filter((one) => one.offsetParent);
    const at = all.indexOf(event.target as HTMLElement);
    if (at < 0) return;
    event.preventDefault();
    all[(at + step + all.length) % all.length].focus();
  }

  focus(): void {
    this.element.querySelector<HTMLElement>("button:not(:disabled), select")?.focus();
  }

  clear(): void {
    fill(this.element);
  }

  show(rule: RuleShown, number: number): void {
    const part = rule.parts[number];
    this.keepingFocus(() => fill(this.element,
      h("h2", {class: "part-name"}, inFew(part)),
      isTray(part) && this.values.show(rule, part),
      this.condition(part),
      GROUPS.map(([group, title]) => this.group(title, actionsOn(rule, number).filter((action) => action.group === group), part)),
      this.text(rule, part)));
    for (const details of this.element.querySelectorAll<HTMLDetailsElement>("details[data-key]")) details.open = this.opened.has(details.dataset.key!);
  }

  private keepingFocus(draw: () => void): void {
    const focused = this.element.contains(document.activeElement) ? document.activeElement!.id : null;
    draw();
    if (focused === null) return;
    const again = focused ? document.getElementById(focused) : null;
    if (again && !(again as HTMLButtonElement).disabled) again.focus();
    else this.focus();
  }

  private condition(part: RulePartShown): HTMLElement | null {
    const {condition} = part;
    if (condition === undefined) return null;
    const set = (text: string) => this.hooks.act({operation: "condition", part: part.number, text});
    const control = countControl(condition, set);
    const input = h("input", {type: "text", id: "rule-condition", value: condition, "aria-label": "How many, written", autocomplete: "off", spellcheck: "false", onchange: () => input.value !== condition && set(input.value)});
    return h("section", {class: "condition"}, h("h3", null, "How many"), control ?? input, control && h("details", {class: "written", "data-key": "condition"}, h("summary", null, "written"), input));
  }

  private group(title: string, actions: Action[], part: RulePartShown): HTMLElement | null {
    const moves = title === "This part" && part.number > 0 && !part.made;
    if (!actions.length && !moves) return null;
    const move = h("button", {type: "button", id: "rule-do-move", onclick: () => this.hooks.move(part.number)}, "move it …", h("kbd", null, "x"));
    return h("section", {class: "rule-actions"}, h("h3", null, title), h("div", {class: "action-list"}, moves && move, actions.map((action) => this.action(action))));
  }

  private action({key, label, about, operation}: Action): HTMLElement {
    return h("button", {type: "button", id: `rule-do-${key}`, title: about, onclick: () => this.hooks.act(operation)}, label, key && h("kbd", null, key === "Delete" ? "Del" : key));
  }

  private text(rule: RuleShown, part: RulePartShown): HTMLElement {
    const input = h("input", {
      type: "text", id: "rule-text", value: part.text.replace(/\s*\n\s*/g, " "), "aria-label": "The text of this part", autocomplete: "off", spellcheck: "false", list: "rule-names",
      onchange: () => this.hooks.act({operation: "text", part: part.number, text: input.value.trim()}),
    });
    return h("details", {class: "written", "data-key": "text"}, h("summary", {id: "rule-do-text"}, "its text ", h("kbd", null, "t")), input,
      h("datalist", {id: "rule-names"}, rule.names.map(({name}) => h("option", {value: name}))));
  }

  // Opens the field of the part's text.
  write(): void {
    const input = this.element.querySelector<HTMLInputElement>("#rule-text");
    if (!input) return;
    (input.closest("details") as HTMLDetailsElement).open = true;
    input.focus();
    input.select();
  }

  // Asks where something goes that is carried, at the chosen part.
  put(rule: RuleShown, part: number, carried: Carried, label: string, chosen: (landing: Landing) => void, away: () => void): void {
    const landings = landingsOn(rule, carried, part);
    fill(this.element,
      h("h2", {class: "part-name"}, `Where does “${label}” go?`),
      h("p", {class: "hint"}, landings.length ? `At the chosen part, ${inFew(rule.parts[part])}:` : "Not there: it would be in itself. Choose another part with the arrows, then Enter."),
      h("div", {class: "action-list"},
        landings.map((landing) => h("button", {type: "button", onclick: () => chosen(landing)}, landing.label)),
        h("button", {type: "button", class: "quiet", onclick: away}, "leave it")));
    this.focus();
  }
}
