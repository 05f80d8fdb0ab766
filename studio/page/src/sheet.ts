// The sheet of plans that follows typing: a sample whose seed stays, the first ones, or the best by a measure.
import type {Desk} from "./desk";
import {fill, h} from "./dom";
import {drawPlans, drawing, scaled, type Drawn} from "./drawn";
import {decimal, grouped, plans as plural} from "./numbers";
import {keep} from "./keep";
import {Refused, Stale} from "./questions";
import type {BestHouses, FoundHouses, FoundPlans} from "./requests";
import {clicked} from "./svg";

const PLANS = 12;
const HOUSES = 6;

interface Shown {
  line: string;
  rank?: string;
  value?: string;
}

export class Sheet {
  readonly element: HTMLElement;
  private grid = h("ol", {class: "sheet", "aria-label": "Plans of the library"});
  private tools = h("div", {class: "tools"});
  private seed = 0;
  private way = "sample"; // or first, least:MEASURE, most:MEASURE
  private where: {text: string; label: string} | null = null;

  constructor(
    private desk: Desk,
    private again: () => void,
  ) {
    this.element = h("section", {class: "sheet-pane", "aria-label": "Plans"}, this.tools, this.grid);
  }

  showWhere(text: string, label: string): void {
    this.where = {text, label};
    this.again();
  }

  reset(): void {
    this.where = null;
    this.way = "sample";
    this.seed = 0;
    this.grid.replaceChildren();
  }

  private renderTools(): void {
    const measures = (this.desk.shown()?.measures ?? []).filter((measure) => (this.desk.library()?.form ? measure.form : measure.schema));
    const ways: [string, string][] = [["sample", "Some at random"], ["first", "The first ones"]];
    if (this.desk.library()?.preferences?.length) ways.push(["most:preference", "Those preferred most"]);
    for (const {name} of measures) ways.push([`least:${name}`, `Least ${name}`], [`most:${name}`, `Most ${name}`]);
    if (!ways.some(([way]) => way === this.way)) this.way = "sample";
    const focused = document.activeElement?.id;
    fill(
      this.tools,
      h("select", {
        id: "sheet-way", "aria-label": "Which plans are shown", value: undefined,
        onchange: (event: Event) => {
          this.way = (event.target as HTMLSelectElement).value;
          this.again();
        },
      }, ways.map(([way, label]) => h("option", {value: way, selected: way === this.way}, label))),
      this.way === "sample" && h("button", {
        id: "sheet-others", type: "button", class: "quiet", title: "Draw another sample",
        onclick: () => {
          this.seed++;
          this.again();
        },
      }, "Others"),
      this.where && h("button", {
        type: "button", class: "chip", "aria-label": `Only plans with ${this.where.label}; show all again`,
        onclick: () => {
          this.where = null;
          this.again();
        },
      }, this.where.label, h("span", {"aria-hidden": "true"}, " ×")),
      this.saver(),
    );
    if (focused) document.getElementById(focused)?.focus();
  }

  // What can be taken along, as the commands write it.
  private saver(): HTMLElement {
    const library = this.desk.library()!;
    const name = this.desk.file()!.path.split("/").pop()!.replace(/\.plan$/, "");
    const select = h("select", {id: "sheet-save", class: "end", "aria-label": "Save a copy of", onchange: () => {
      const what = select.value;
      select.value = "";
      this.save(what, library.name, name).catch((failure) => {
        if (failure instanceof Refused) this.desk.say(`${failure.message}.`);
        else if (!(failure instanceof Stale)) throw failure;
      });
    }}, h("option", {value: ""}, "Save a copy …"), h("option", {value: "svg"}, "the plans as a sheet (.svg)"), h("option", {value: "html"}, "a report (.html)"),
      !library.form && h("option", {value: "pl"}, "the rules in Prolog (.pl)"));
    return select;
  }

  private async save(what: string, library: string, name: string): Promise<void> {
    const {questions} = this.desk;
    const where = this.where ? [this.where.text] : undefined;
    const count = this.desk.library()!.form ? HOUSES : PLANS;
    const measure = /^(least|most):(.+)/.exec(this.way);
    const which = measure ? {best: count, by: [{measure: measure[2], most: measure[1] === "most"}]} : {sample: count, seed: this.seed};
    const answer = what === "svg"
      ? await questions.ask("draw", {library, where, ...which, format: "svg"}, "copy")
      : what === "html" ? await questions.ask("report", {library, where}, "copy") : await questions.ask("export", {library, where, as: "prolog"}, "copy");
    const text = answer.files[0]?.text;
    if (text !== undefined) keep(text, `${name}.${what}`);
  }

  private async houses(library: string, where: string[] | undefined): Promise<Shown[]> {
    const {questions} = this.desk;
    const measure = /^(least|most):(.+)/.exec(this.way);
    const request = {library, where, count: HOUSES};
    if (measure)
      return ((await questions.ask("best", {...request, by: [{measure: measure[2], most: measure[1] === "most"}]}, "sheet")) as BestHouses).houses.map(({house, value}) => ({line: house, value}));
    const found = this.way === "first"
      ? await questions.ask("enumerate", {library, where, limit: HOUSES}, "sheet")
      : await questions.ask("sample", {...request, seed: this.seed}, "sheet");
    return (found as FoundHouses).houses.map(({house, plan_rank, variant}) => ({line: house, rank: `${plan_rank}:${variant}`}));
  }

  private async plans(library: string, where: string[] | undefined): Promise<Shown[]> {
    const {questions} = this.desk;
    const measure = /^(least|most):(.+)/.exec(this.way);
    const request = {library, where, lines: true};
    const found = measure
      ? await questions.ask("best", {...request, count: PLANS, by: [{measure: measure[2], most: measure[1] === "most"}]}, "sheet")
      : this.way === "first"
        ? await questions.ask("enumerate", {...request, limit: PLANS}, "sheet")
        : await questions.ask("sample", {...request, count: PLANS, seed: this.seed}, "sheet");
    return (found as FoundPlans).plans.map(({plan, rank, value}) => ({line: plan!, rank, value}));
  }

  async refresh(): Promise<void> {
    const library = this.desk.library();
    if (!library) return;
    this.renderTools();
    const where = this.where ? [this.where.text] : undefined;
    const shown = library.form ? await this.houses(library.name, where) : await this.plans(library.name, where);
    if (!shown.length) {
      fill(this.grid, h("li", {class: "none"}, this.where ? `No plan has ${this.where.label}.` : this.nothing()));
      this.grid.classList.add("empty");
      return;
    }
    const drawn = library.form ? await this.drawHouses(library.name, where) : await drawPlans(this.desk, shown.map((plan) => plan.line), "sheet");
    this.grid.classList.remove("empty");
    this.grid.classList.toggle("of-houses", Boolean(library.form));
    if (drawn.each.length === shown.length) {
      const pictures = scaled(drawn.each);
      fill(this.grid, shown.map((plan, i) => this.card(plan, pictures[i])));
    } else {
      if (drawn.whole && library.form) clicked(drawn.whole, "house", (number) => this.desk.explain(shown[number].line));
      fill(this.grid, drawn.whole && h("li", {class: "whole"}, drawn.whole), shown.map((plan) => this.card(plan, null)));
    }
  }

  // The first ones are not drawn: no picture can be asked of houses by their numbers.
  private async drawHouses(library: string, where: string[] | undefined): Promise<Drawn> {
    if (this.way === "first") return {each: [], whole: null};
    const measure = /^(least|most):(.+)/.exec(this.way);
    const which = measure ? {best: HOUSES, by: [{measure: measure[2], most: measure[1] === "most"}]} : {sample: HOUSES, seed: this.seed};
    return drawing(this.desk, {library, where, ...which}, "sheet", "houses of the library");
  }

  private nothing(): string {
    return "No plan is left: the clauses together keep every plan out. The table of clauses says which of them does how much.";
  }

  private card(plan: Shown, svg: SVGSVGElement | null): HTMLElement {
    const unit = this.desk.shown()?.measures.find((measure) => this.way.endsWith(`:${measure.name}`))?.unit ?? "";
    const caption = plan.value !== undefined
      ? `${decimal(plan.value)}${unit ? ` ${unit}` : ""}`
      : plan.rank !== undefined ? `no. ${plan.rank.includes(":") ? plan.rank : grouped(plan.rank)}` : "";
    svg?.setAttribute("aria-hidden", "true");
    svg?.removeAttribute("role");
    return h("li", null, h("button", {
      type: "button", class: "card", title: plan.line, "data-line": plan.line,
      onclick: () => this.desk.explain(plan.line),
    }, svg && h("span", {class: "drawing"}, svg), h("span", {class: "caption"}, caption), h("span", {class: svg ? "sr" : "line"}, plan.line)));
  }
}

export function keptSentence(kept: string | null, generated: string | null): string {
  return `${plural(kept)} kept of ${generated === null ? "more than can be counted" : grouped(generated)} generated`;
}
