// Plans that somebody likes and wants to keep an eye on: whether the library still has each, and if not, which clause
// took it out.
import type {Desk} from "./desk";
import {fill, h} from "./dom";
import {drawPlans, scaled} from "./drawn";
import {inWords} from "./numbers";
import {Refused, quietly} from "./questions";

export class Watched {
  readonly element = h("section", {class: "watched", "aria-label": "Plans that you watch", hidden: true});
  private path = "";
  plans: string[] = [];

  constructor(private desk: Desk) {}

  private key(): string {
    return `tartan.watched.${this.desk.file()?.path}`;
  }

  toggle(plan: string): void {
    this.load();
    this.plans = this.plans.includes(plan) ? this.plans.filter((one) => one !== plan) : [...this.plans, plan];
    sessionStorage.setItem(this.key(), JSON.stringify(this.plans));
    quietly(this.refresh());
  }

  private load(): void {
    const path = this.desk.file()?.path ?? "";
    if (path === this.path) return;
    this.path = path;
    this.plans = JSON.parse(sessionStorage.getItem(this.key()) ?? "[]") as string[];
  }

  async refresh(): Promise<void> {
    this.load();
    const library = this.desk.library();
    this.element.hidden = !this.plans.length || !library || Boolean(library.form);
    if (this.element.hidden || !library) return;
    const states = await this.states(library.name);
    const readable = this.plans.filter((_plan, i) => states[i] !== null);
    const drawn = readable.length ? await drawPlans(this.desk, readable, "watched") : {each: [], whole: null};
    const pictures = drawn.each.length ? scaled(drawn.each) : [];
    fill(this.element, h("h2", null, "Plans that you watch"), h("ol", {class: "sheet"}, this.plans.map((plan, i) => this.card(plan, states[i], pictures[readable.indexOf(plan)] ?? null))));
  }

  // Of each plan what drops it; null of one that is none any more.
  private async states(library: string): Promise<(string[] | null)[]> {
    const ask = async (plans: string[]) => (await this.desk.questions.ask("prune", {library, plans}, "watched")).plans.map((plan) => plan.dropped_by ?? []);
    try {
      return await ask(this.plans);
    } catch (failure) {
      if (!(failure instanceof Refused)) throw failure;
    }
    const states: (string[] | null)[] = [];
    for (const plan of this.plans) {
      try {
        states.push((await ask([plan]))[0]);
      } catch (failure) {
        if (!(failure instanceof Refused)) throw failure;
        states.push(null);
      }
    }
    return states;
  }

  private card(plan: string, state: string[] | null, svg: SVGSVGElement | null): HTMLElement {
    const gone = state === null || state.length > 0;
    const why = state === null ? "no plan any more: its trays have changed" : state.length ? `gone, by ${state.map(inWords).join(", ")}` : "kept";
    svg?.setAttribute("aria-hidden", "true");
    return h("li", null, h("button", {type: "button", class: `card ${gone ? "gone" : "kept"}`, title: plan, "data-line": plan, onclick: () => this.desk.explain(plan)},
      svg && h("span", {class: "drawing"}, svg), h("span", {class: "caption"}, why), h("span", {class: svg ? "sr" : "line"}, plan)));
  }
}
