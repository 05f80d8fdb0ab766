// The params of the file as sliders and choices: what is chosen becomes the default in the text, as one step that can be
// undone.
import {isolateHistory} from "@codemirror/commands";
import {Transaction} from "@codemirror/state";
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

export function written(value: number, range: Range): string {
  const text = value.toFixed(range.places);
  return (range.places ? text.replace(/\.?0+$/, "") : text) + range.unit;
}

interface Place {
  from: number;
  text: string; // as it is there now
}

export class Sliders {
  readonly element = h("section", {class: "sliders", "aria-label": "Settings", hidden: true});
  private shape = "";
  private places = new Map<string, Place>();
  private rows = new Map<string, {set: (text: string) => void}>();
  private unknown = false;
  private sliding = ""; // the one that is being moved

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

  private show(settings: ShownSetting[]): void {
    const text = this.desk.file()!.text;
    for (const {name, utf16_begin: from, utf16_end: to} of settings) {
      if (name !== this.sliding && from !== null && to !== null) this.places.set(name, {from, text: text.slice(from, to)});
    }
    const shape = JSON.stringify([this.desk.file()!.readOnly, settings.map(({name, doc, least, most, words, value}) => [name, doc, least, most, words && [...words].sort(), words ? null : rangeOf({value, least, most})])]);
    if (shape !== this.shape) this.build(settings);
    this.shape = shape;
    for (const {name, value} of settings) if (name !== this.sliding) this.rows.get(name)?.set(value);
    this.element.hidden = settings.length === 0;
  }

  private build(settings: ShownSetting[]): void {
    this.rows.clear();
    fill(this.element, settings.map((setting) => (setting.words ? this.choice(setting) : this.number(setting))));
  }

  private label(setting: ShownSetting): HTMLElement {
    return h("span", {class: "label", title: setting.doc}, setting.doc ?? setting.name);
  }

  private choice(setting: ShownSetting): HTMLElement {
    const select = h("select", {disabled: this.desk.file()!.readOnly, onchange: () => this.word(setting, select.value)}, [...(setting.words ?? [])].sort().map((word) => h("option", {value: word}, word)));
    this.rows.set(setting.name, {set: (text) => (select.value = text)});
    return h("label", {class: "setting"}, this.label(setting), select);
  }

  private number(setting: ShownSetting): HTMLElement {
    const range = rangeOf(setting);
    const readOnly = this.desk.file()!.readOnly;
    if (!range) {
      const field = h("input", {type: "text", size: 8, disabled: readOnly, onchange: () => this.put(setting.name, field.value, true)});
      this.rows.set(setting.name, {set: (text) => (field.value = text)});
      return h("label", {class: "setting"}, this.label(setting), field);
    }
    const output = h("output", null);
    const slider = h("input", {type: "range", min: range.from, max: range.to, step: range.step, disabled: readOnly});
    let before = "";
    slider.addEventListener("input", () => {
      if (!this.sliding) before = this.places.get(setting.name)?.text ?? "";
      this.sliding = setting.name;
      output.textContent = written(Number(slider.value), range);
      this.put(setting.name, output.textContent, false);
    });
    slider.addEventListener("change", () => {
      this.sliding = "";
      const now = written(Number(slider.value), range);
      if (before && before !== now) {
        this.put(setting.name, before, false);
        this.put(setting.name, now, true);
      }
    });
    this.rows.set(setting.name, {set: (text) => {
      slider.value = String(parseFloat(text));
      output.textContent = text;
    }});
    return h("label", {class: "setting"}, this.label(setting), slider, output);
  }

  // The default is the first of the words, whose place is that of all of them.
  private word(setting: ShownSetting, word: string): void {
    const place = this.places.get(setting.name);
    if (!place) return;
    const words = place.text.split(/\s*\|\s*/);
    if (words.includes(word)) this.put(setting.name, [word, ...words.filter((other) => other !== word)].join(" | "), true);
  }

  // While a slider moves its steps are no history; where it stops is.
  private put(name: string, value: string, history: boolean): void {
    const place = this.places.get(name);
    const file = this.desk.file();
    if (!place || !file || !value) return;
    const to = place.from + place.text.length;
    if (file.text.slice(place.from, to) !== place.text || place.text === value) return;
    this.desk.editor.view.dispatch({
      changes: {from: place.from, to, insert: value},
      annotations: history ? isolateHistory.of("full") : Transaction.addToHistory.of(false), userEvent: "input.setting",
    });
    const grown = value.length - place.text.length;
    for (const other of this.places.values()) if (other.from > place.from) other.from += grown;
    place.text = value;
  }
}
