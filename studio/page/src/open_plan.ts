// An open plan: of each tray what is chosen already, and how many plans each other choice still leaves.
import type {Desk} from "./desk";
import {fill, h} from "./dom";
import {bar} from "./drawn";
import {counted, grouped, share} from "./numbers";
import {quietly} from "./questions";
import type {Completed, ShownField, ShownSchema, TrayChoices} from "./requests";

type Tray = Record<string, string>; // by field the spelling of the value that is chosen

// An item of a tray specifier for a value that is spelled as in plan lines.
export function item(field: ShownField, spelling: string): string {
  if (field.kind === "flag") return spelling === "-" ? `not ${field.name}` : field.name;
  return `${field.name} ${spelling.replace(":", " ")}`;
}

export function pattern(schema: ShownSchema, trays: Tray[]): string {
  return trays.map((tray) => {
    const items = schema.fields.filter((field) => tray[field.name] !== undefined).map((field) => item(field, tray[field.name]));
    return items.length ? `tray(${items.join(", ")})` : "?";
  }).join(" | ");
}

export class OpenPlan {
  readonly element: HTMLElement;
  private trays: Tray[] = [];
  private chosen = 0;

  constructor(private desk: Desk) {
    this.element = h("section", {class: "pane open-plan", "aria-label": "Open plan"});
  }

  reset(): void {
    this.trays = [];
    this.chosen = 0;
  }

  private again(): void {
    void this.desk.refreshPane();
  }

  async refresh(): Promise<void> {
    const library = this.desk.library();
    const schema = this.desk.schema();
    if (!library || !schema) return;
    const bounds = library.trays ?? [1, 9];
    if (!this.trays.length) this.trays = Array.from({length: bounds[0] || 1}, () => ({}));
    for (const tray of this.trays) for (const name of Object.keys(tray)) if (!schema.fields.some((field) => field.name === name && field.values.some((value) => value.spelling === tray[name]))) delete tray[name];
    this.chosen = Math.min(this.chosen, this.trays.length - 1);
    const answer = (await this.desk.questions.ask("complete", {library: library.name, pattern: pattern(schema, this.trays)}, "open")) as Completed;
    const many = answer.plans ?? answer.houses ?? "0";
    const others = await this.others(library.name, schema);
    const focused = document.activeElement?.id;
    fill(
      this.element,
      h("p", {class: "lead"}, "Choose what trays are; the numbers say how many plans each choice leaves."),
      h("div", {class: "tools"},
        h("strong", {class: "left", role: "status"}, `${grouped(many)} ${many === "1" ? "plan" : "plans"} left`),
        h("button", {id: "tray-fewer", type: "button", class: "quiet", disabled: this.trays.length <= Math.max(1, bounds[0]), onclick: () => {
          this.trays.pop();
          this.again();
        }}, "One tray fewer"),
        h("button", {id: "tray-more", type: "button", class: "quiet", disabled: this.trays.length >= bounds[1], onclick: () => {
          this.trays.push({});
          this.again();
        }}, "One tray more"),
        h("button", {id: "tray-none", type: "button", class: "quiet", onclick: () => {
          this.trays = this.trays.map(() => ({}));
          this.again();
        }}, "Start again"),
        many === "1" && h("button", {id: "tray-why", type: "button", onclick: () => this.desk.explain(this.only(schema, answer))}, "Show it"),
        answer.houses === undefined && many !== "0" && many !== "1" && h("button", {id: "tray-show", type: "button", class: "quiet", onclick: () => quietly(this.one(library.name, schema))}, "Show the first")),
      answer.why_none && h("p", {class: "trouble"}, answer.why_none),
      h("ol", {class: "trays", "aria-label": "Trays"}, this.trays.map((tray, i) => h("li", null, this.tab(tray, i, schema)))),
      this.fields(schema, {...answer.trays[this.chosen], ...others}),
    );
    if (focused) document.getElementById(focused)?.focus();
  }

  // Of each field that is chosen in this tray: what its other values would leave.
  private async others(library: string, schema: ShownSchema): Promise<TrayChoices> {
    const found: TrayChoices = {};
    for (const name of Object.keys(this.trays[this.chosen])) {
      const trays = this.trays.map((tray) => ({...tray}));
      delete trays[this.chosen][name];
      const answer = (await this.desk.questions.ask("complete", {library, pattern: pattern(schema, trays)}, `open ${name}`)) as Completed;
      found[name] = answer.trays[this.chosen]?.[name] ?? {};
    }
    return found;
  }

  private tab(tray: Tray, i: number, schema: ShownSchema): HTMLElement {
    const words = schema.fields.filter((field) => tray[field.name] !== undefined).map((field) => item(field, tray[field.name]));
    return h("button", {id: `tray-${i}`, type: "button", class: "tray", "aria-pressed": String(i === this.chosen), onclick: () => {
      this.chosen = i;
      this.again();
    }}, h("span", {class: "number"}, i + 1), words.length ? words.map((word) => h("span", null, word)) : h("span", {class: "faint"}, "anything"));
  }

  private fields(schema: ShownSchema, choices: TrayChoices): HTMLElement {
    const tray = this.trays[this.chosen];
    return h("div", {class: "fields"}, schema.fields.map((field) => {
      const counts = choices[field.name] ?? {};
      const most = Object.values(counts).reduce((max, digits) => (BigInt(digits) > BigInt(max) ? digits : max), "0");
      return h("fieldset", null, h("legend", null, field.name, field.doc && h("span", {class: "doc"}, field.doc)),
        field.values.map((value) => {
          const chosen = tray[field.name] === value.spelling;
          const many = counts[value.spelling] ?? counts[value.name];
          const label = field.kind === "flag" ? (value.spelling === "-" ? `not ${field.name}` : field.name) : value.spelling.replace(":", " ");
          return h("button", {
            id: `value-${field.name}-${value.spelling}`, type: "button", class: "choice", "aria-pressed": String(chosen), disabled: !chosen && many === "0",
            onclick: () => {
              if (chosen) delete tray[field.name];
              else tray[field.name] = value.spelling;
              this.again();
            },
          }, h("span", null, label), bar(share(many, most)), h("span", {class: "num"}, many === undefined ? "" : counted(many)));
        }));
    }));
  }

  // The one plan that is left, field by field.
  private only(schema: ShownSchema, answer: Completed): string {
    return answer.trays.map((choices) => schema.fields.map((field) => field.values.find((value) => (choices[field.name]?.[value.spelling] ?? "0") !== "0")?.spelling ?? "").join(" ")).join(" | ");
  }

  // Fills what is open with the first choice that leaves a plan, tray by tray.
  private async one(library: string, schema: ShownSchema): Promise<void> {
    const trays = this.trays.map((tray) => ({...tray}));
    for (let i = 0; i < trays.length; i++) {
      for (const field of schema.fields) {
        if (trays[i][field.name] !== undefined) continue;
        const answer = (await this.desk.questions.ask("complete", {library, pattern: pattern(schema, trays)}, "first")) as Completed;
        const value = field.values.find((one) => (answer.trays[i]?.[field.name]?.[one.spelling] ?? "0") !== "0") ?? field.values.find((one) => trays[i][field.name] === undefined && one);
        if (value) trays[i][field.name] = value.spelling;
      }
    }
    this.desk.explain(trays.map((tray) => schema.fields.map((field) => tray[field.name]).join(" ")).join(" | "));
  }
}
