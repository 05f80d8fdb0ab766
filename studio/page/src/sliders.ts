// What may be set in the file as sliders and choices: the params of rules about plans, the numbers of other notations by
// what they belong to. What is chosen stands in the text, as one step that can be undone.
import {isolateHistory, undo} from "@codemirror/commands";
import type {Text} from "@codemirror/state";
import type {Desk} from "./desk";
import {fill, h} from "./dom";
import {Refused} from "./questions";
import type {ShownSetting} from "./requests";

export interface Range {
  from: number;
  to: number;
  step: number;
  places: number;
  unit: string;
}

const VALUE = /^\s*(-?\d+(?:\.\d+)?)\s*('|[a-z]+[23]?|%)?\s*$/;

// The numbers between which a slider goes; null for what is no plain number with a unit, such as 7'-9".
export function rangeOf(setting: Pick<ShownSetting, "value" | "least" | "most">): Range | null {
  const value = VALUE.exec(setting.value);
  const from = setting.least === undefined ? null : VALUE.exec(setting.least);
  const to = setting.most === undefined ? null : VALUE.exec(setting.most);
  if (!value || (setting.least !== undefined && !from) || (setting.most !== undefined && !to)) return null;
  const unit = value[2] ?? "";
  const least = from ? Number(from[1]) : Math.min(0, Number(value[1]) * 2);
  const most = to ? Number(to[1]) : Math.max(Number(value[1]) * 2, 10);
  if ((from && (from[2] ?? "") !== unit) || (to && (to[2] ?? "") !== unit) || most <= least) return null;
  const places = Math.max(...[value[1], from?.[1] ?? "", to?.[1] ?? ""].map((text) => text.split(".")[1]?.length ?? 0));
  const fine = unit === "m" ? Math.max(1, places) : places;
  return {from: least, to: most, step: 10 ** -fine, places: fine, unit};
}

// A number that nothing bounds: from 0 to twice of it, in a hundred steps or so; whole ones in steps of 1.
export function rangeAbout(value: string): Range | null {
  const read = VALUE.exec(value);
  if (!read) return null;
  const places = read[1].split(".")[1]?.length ?? 0;
  const far = 2 * Math.abs(Number(read[1])) || 10;
  const most = places ? far : Math.max(far, 10);
  const fine = places ? Math.max(places, Math.ceil(-Math.log10(most / 40))) : 0;
  const sign = read[1].startsWith("-") ? -1 : 1;
  return {from: sign < 0 ? -most : 0, to: sign < 0 ? 0 : most, step: 10 ** -fine, places: fine, unit: read[2] ?? ""};
}

export function within({from, to, places, unit}: Range, text: string): boolean {
  const read = VALUE.exec(text);
  return read !== null && (read[2] ?? "") === unit && Number(read[1]) >= from && Number(read[1]) <= to && (read[1].split(".")[1]?.length ?? 0) <= places;
}

const MANY = 12; // numbers that are all shown at once

// Its own name, also among others that are called alike.
interface Named extends ShownSetting {
  key: string;
  label: string;
}

function named(settings: ShownSetting[]): Named[] {
  const all = settings.map((setting) => ({...setting, like: JSON.stringify([setting.part ?? "", setting.name])}));
  const count = new Map<string, number>();
  for (const {like} of all) count.set(like, (count.get(like) ?? 0) + 1);
  const met = new Map<string, number>();
  return all.map(({like, ...setting}) => {
    const nth = (met.get(like) ?? 0) + 1;
    met.set(like, nth);
    return {...setting, key: `${like}${nth}`, label: setting.doc ?? (count.get(like)! > 1 ? `${setting.name} ${nth}` : setting.name)};
  });
}

export function written(value: number, range: Range): string {
  const text = value.toFixed(range.places);
  return (range.places ? text.replace(/\.?0+$/, "") : text) + range.unit;
}

// What is shown of a setting.
interface Row {
  set: (text: string) => void;
  holds: (text: string) => boolean; // can it show that, too?
}

interface Place {
  from: number;
  text: string; // as it is there now
}

export class Sliders {
  readonly element = h("section", {class: "sliders", "aria-label": "Settings", hidden: true});
  private shape = "";
  private places = new Map<string, Place>();
  private rows = new Map<string, Row>();
  private unknown = false;
  private sliding = ""; // the one that is being moved
  private last: {before: string; after: Text} | null = null; // what was put, and the text with it

  constructor(private desk: Desk) {}

  clear(): void {
    this.element.hidden = true;
    this.shape = "";
  }

  async refresh(): Promise<void> {
    if (this.unknown) return;
    try {
      this.show((await this.desk.questions.ask("settings", {}, "settings")).settings);
    } catch (failure) {
      if (!(failure instanceof Refused)) throw failure;
      this.unknown = failure.unknown;
      if (this.unknown) this.clear();
    }
  }

  private show(found: ShownSetting[]): void {
    const text = this.desk.file()!.text;
    const settings = named(found);
    for (const {key: name, utf16_begin: from, utf16_end: to} of settings) {
      if (name !== this.sliding && from !== null && to !== null) this.places.set(name, {from, text: text.slice(from, to)});
    }
    const shape = JSON.stringify([this.desk.file()!.readOnly, settings.map(({key, doc, least, most, words}) => [key, doc, least, most, words && [...words].sort()])]);
    const fit = settings.every(({key, value}) => key === this.sliding || this.rows.get(key)?.holds(value));
    if (shape !== this.shape || !fit) this.build(settings);
    this.shape = shape;
    for (const {key, value} of settings) if (key !== this.sliding) this.rows.get(key)?.set(value);
    this.element.hidden = settings.length === 0;
  }

  private build(settings: Named[]): void {
    const row = (setting: Named) => (setting.words ? this.choice(setting) : this.number(setting));
    this.rows.clear();
    if (settings.every(({part}) => part === undefined)) return fill(this.element, settings.map(row));
    const parts = new Map<string, Named[]>();
    for (const setting of settings) parts.set(setting.part ?? "", [...(parts.get(setting.part ?? "") ?? []), setting]);
    const open = new Set([...this.element.querySelectorAll("details")].filter((one) => one.open).map((one) => one.dataset.part));
    let shown = 0;
    fill(this.element, [...parts].map(([part, own]) => h("details", {class: "part-settings", "data-part": part, open: (shown += own.length) <= MANY || open.has(part)},
      h("summary", null, part || "the file"), h("div", null, own.map(row)))));
  }

  private label(setting: Named): HTMLElement {
    return h("span", {class: "label", title: setting.doc}, setting.label);
  }

  private choice(setting: Named): HTMLElement {
    const select = h("select", {disabled: this.desk.file()!.readOnly, onchange: () => this.word(setting.key, select.value)}, [...(setting.words ?? [])].sort().map((word) => h("option", {value: word}, word)));
    this.rows.set(setting.key, {set: (text) => (select.value = text), holds: () => true});
    return h("label", {class: "setting"}, this.label(setting), select);
  }

  private number(setting: Named): HTMLElement {
    const range = setting.part === undefined ? rangeOf(setting) : setting.least === undefined && setting.most === undefined ? rangeAbout(setting.value) : rangeOf(setting);
    const readOnly = this.desk.file()!.readOnly;
    if (!range) {
      const field = h("input", {type: "text", size: 8, disabled: readOnly, onchange: () => this.put(setting.key, field.value)});
      this.rows.set(setting.key, {set: (text) => (field.value = text), holds: () => true});
      return h("label", {class: "setting"}, this.label(setting), field);
    }
    const output = h("output", null);
    const slider = h("input", {type: "range", min: range.from, max: range.to, step: range.step, disabled: readOnly});
    slider.addEventListener("input", () => {
      const again = this.sliding === setting.key;
      this.sliding = setting.key;
      output.textContent = written(Number(slider.value), range);
      this.put(setting.key, output.textContent, again);
    });
    slider.addEventListener("change", () => (this.sliding = ""));
    this.rows.set(setting.key, {
      set: (text) => {
        slider.value = String(parseFloat(text));
        output.textContent = text;
      },
      holds: (text) => within(range, text),
    });
    return h("label", {class: "setting"}, this.label(setting), slider, output);
  }

  // The default is the first of the words, whose place is that of all of them.
  private word(key: string, word: string): void {
    const place = this.places.get(key);
    if (!place) return;
    const words = place.text.split(/\s*\|\s*/);
    if (words.includes(word)) this.put(key, [word, ...words.filter((other) => other !== word)].join(" | "));
  }

  // `again`: in the place of what was put last, so that a slider that was moved is one step to undo.
  private put(key: string, value: string, again = false): void {
    const place = this.places.get(key);
    const file = this.desk.file();
    if (!place || !file || !value) return;
    const {view} = this.desk.editor;
    if (again && this.last?.after === view.state.doc) {
      undo({state: view.state, dispatch: (transaction) => view.dispatch(Object.assign(transaction, {scrollIntoView: false}))});
      this.stands(place, this.last.before);
    }
    const to = place.from + place.text.length;
    this.last = null;
    if (file.text.slice(place.from, to) !== place.text || place.text === value) return;
    view.dispatch({changes: {from: place.from, to, insert: value}, annotations: isolateHistory.of("full"), userEvent: "input.setting"});
    this.last = {before: place.text, after: view.state.doc};
    this.stands(place, value);
  }

  private stands(place: Place, text: string): void {
    const grown = text.length - place.text.length;
    for (const other of this.places.values()) if (other.from > place.from) other.from += grown;
    place.text = text;
  }
}
