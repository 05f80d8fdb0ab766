// What a tray asks for, field by field: its values are chosen, denied and joined here, each time as an edit of one item.
import {h} from "./dom";
import type {RulePartShown, TrayField, TrayItem} from "./requests";
import {boundItems, type Tree} from "./rule_parts";
import type {Operation} from "./rule_drops";

export interface Choice {
  denied: boolean;
  values: string[]; // as the field's items are written
}

const plain = (text: string) => text.trim().replace(/\s+/g, " ").toLowerCase();

// "machine dense 4'" without the field's name.
const short = (field: TrayField, item: string) => (plain(item).startsWith(`${plain(field.name)} `) ? item.trim().slice(field.name.length).trim() : item.trim());

// The choice that an item stands for; null if it says more than the values of the field can, such as a range.
export function choiceOf(field: TrayField, items: string[], text: string): Choice | null {
  const all = items.map((item) => plain(short(field, item)));
  let rest = short(field, text);
  const denied = /^not\b/i.test(rest) && !all.includes(plain(rest));
  if (denied) rest = short(field, rest.slice(3)).trim();
  const inParentheses = /^\((.*)\)$/s.exec(rest);
  const words = (inParentheses ? inParentheses[1] : rest).split(/\s+or\s+/i);
  const values: string[] = [];
  for (const word of words) {
    const at = all.indexOf(plain(short(field, word)));
    if (at < 0) return null;
    values.push(items[at]);
  }
  return {denied, values};
}

// The item that says so; empty if nothing is chosen, which is any value.
export function itemOf(field: TrayField, choice: Choice): string {
  if (!choice.values.length) return "";
  const named = choice.values.some((value) => short(field, value) !== value.trim());
  const words = choice.values.map((value) => short(field, value));
  const joined = words.length > 1 && choice.denied ? `(${words.join(" or ")})` : words.join(" or ");
  const said = choice.denied ? `not ${joined}` : joined;
  return named ? `${field.name} ${said}` : said;
}

interface Row {
  field: TrayField;
  items: string[];
  at: number | null; // which item of the tray says something of it
  item: TrayItem | null;
  choice: Choice | null;
}

function rowsOf(rule: Tree, part: RulePartShown): Row[] {
  return rule.fields.flatMap((field): Row[] => {
    const items = [...field.items, ...boundItems(rule, part.number, field.name)];
    const own = part.items.map((item, at) => ({item, at})).filter(({item}) => item.field === field.name);
    if (!own.length) return [{field, items, at: null, item: null, choice: {denied: false, values: []}}];
    return own.map(({item, at}) => ({field, items, at, item, choice: choiceOf(field, items, item.text)}));
  });
}

// The edit that makes an item of this text: of none, the item goes.
function edit(part: number, at: number | null, text: string): Operation | null {
  if (at === null) return text ? {operation: "add", part, text} : null;
  return text ? {operation: "set", part, item: at, text} : {operation: "clear", part, item: at};
}

// A flag's two values are one another's opposite, so nothing can be joined or denied there.
const isFlag = (field: TrayField) => field.items.length === 2 && field.items[1].trim().toLowerCase() === `not ${field.items[0].trim().toLowerCase()}`;

export class Values {
  constructor(private act: (operation: Operation) => void) {}

  // The fields of a tray of the rule.
  show(rule: Tree, part: RulePartShown): HTMLElement {
    const rows = rowsOf(rule, part).map((row, i) => this.row(part.number, row, i));
    const other = part.items.map((item, at) => ({item, at})).filter(({item}) => item.field === undefined);
    return h("div", {class: "values"}, rows, other.map(({item, at}) => this.other(part.number, item, at)));
  }

  private row(part: number, row: Row, i: number): HTMLElement {
    const {field, choice} = row;
    const chosen = choice ?? {denied: false, values: []};
    const change = (next: Choice) => {
      const made = edit(part, row.at, itemOf(field, next));
      if (made) this.act(made);
    };
    const anything = choice !== null && !choice.values.length;
    const flip = (item: string) => {
      if (isFlag(field)) return change({denied: false, values: chosen.values.includes(item) ? [] : [item]});
      const values = row.items.filter((one) => (one === item) !== chosen.values.includes(one));
      change({denied: chosen.denied && values.length > 0, values});
    };
    return h("fieldset", {class: "value-row"},
      h("legend", null, field.name, field.doc && h("span", {class: "doc"}, field.doc)),
      h("div", {class: "value-list"},
        h("button", {type: "button", id: `rule-${i}-any`, "aria-pressed": String(anything), onclick: () => change({denied: false, values: []})}, "any"),
        row.items.map((item, n) => h("button", {type: "button", id: `rule-${i}-${n}`, "aria-pressed": String(chosen.values.includes(item)), onclick: () => flip(item)}, short(field, item))),
        !isFlag(field) && h("button", {
          type: "button", id: `rule-${i}-not`, class: "deny", "aria-pressed": String(chosen.denied), disabled: !chosen.values.length,
          title: "all values but these", onclick: () => change({...chosen, denied: !chosen.denied}),
        }, "not"),
        this.written(part, row.at, row.item?.text ?? "", `rule-${i}-text`, field)));
  }

  // A field for what the values alone cannot say; it is open if that stands there.
  private written(part: number, at: number | null, text: string, id: string, field: TrayField): HTMLElement | null {
    if (isFlag(field)) return null;
    const input = h("input", {type: "text", id, value: text, placeholder: `${field.name} …`, "aria-label": `What is asked of ${field.name}, written`, autocomplete: "off", spellcheck: "false", onchange: () => {
      const made = edit(part, at, input.value.trim());
      if (made && input.value.trim() !== text.trim()) this.act(made);
    }});
    return h("details", {class: "written", "data-key": id}, h("summary", {id: `${id}-open`, title: "a range, or what else the values alone cannot say", "aria-label": `${field.name}, written`}, "…"), input);
  }

  private other(part: number, item: TrayItem, at: number): HTMLElement {
    const input = h("input", {type: "text", id: `rule-item-${at}`, value: item.text, "aria-label": "What is asked, written", autocomplete: "off", spellcheck: "false", onchange: () => {
      const made = edit(part, at, input.value.trim());
      if (made) this.act(made);
    }});
    return h("div", {class: "value-row"}, input);
  }
}
