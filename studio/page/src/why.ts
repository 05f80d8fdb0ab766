// One plan: large, with why its library keeps it or not. What a part of a rule is about is lit in the picture and in the
// text.
import type {Desk} from "./desk";
import {fill, h, withCode} from "./dom";
import {drawPlans, scaled} from "./drawn";
import {addCase, bared, offsetOf} from "./edits";
import {grouped, inWords} from "./numbers";
import {Refused, Stale} from "./questions";
import type {ExplainedClause, ExplainedHouse, ExplainedPlan, ExplainedTree, NearestPlan, TrayStretch} from "./requests";
import {light, picture} from "./svg";

const DEEPEST = 6;

export class Why {
  readonly element: HTMLElement;
  private plan = "";
  private field = h("input", {
    type: "text", class: "plan-field", "aria-label": "The plan, tray by tray", spellcheck: "false", autocomplete: "off", autocapitalize: "off",
  });
  private body = h("div", {class: "why-body"});
  private heading = h("h2", null, "One plan");
  private drawing = h("div", {class: "drawing large"});
  private opener: Element | null = null;

  constructor(private desk: Desk) {
    const form = h("form", {class: "plan-form", onsubmit: (event: Event) => {
      event.preventDefault();
      if (this.field.value.trim()) this.show(this.field.value.trim());
    }}, this.field, h("button", {type: "submit"}, "Why?"));
    this.element = h("aside", {class: "why", hidden: true, "aria-label": "One plan", tabindex: "-1"},
      h("header", null, this.heading, h("button", {type: "button", class: "close", "aria-label": "Close", title: "Close (Escape)", onclick: () => this.close()}, "×")),
      this.drawing, form, this.body);
    this.element.addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.close();
    });
  }

  get open(): boolean {
    return !this.element.hidden;
  }

  show(plan: string): void {
    if (!this.open) this.opener = document.activeElement;
    const literal = /^\s*\[([^\]]*)\]\s*$/.exec(plan);
    this.plan = literal ? literal[1].trim() : plan;
    this.field.value = this.plan;
    this.element.hidden = false;
    this.element.scrollTop = 0;
    this.element.focus({preventScroll: true});
    this.mark();
    void this.refresh();
  }

  close(): void {
    this.element.hidden = true;
    this.plan = "";
    this.desk.editor.unlight();
    this.mark();
    (this.opener as HTMLElement | null)?.focus?.();
  }

  private mark(): void {
    for (const card of document.querySelectorAll("[data-line]")) card.classList.toggle("chosen", this.plan !== "" && card.getAttribute("data-line") === this.plan);
  }

  async refresh(): Promise<void> {
    const library = this.desk.library();
    if (!this.open || !library) return;
    this.element.classList.add("stale");
    this.heading.textContent = library.form ? "One house" : "One plan";
    try {
      if (library.form) await this.house(library.name);
      else await this.explain(library.name);
      this.element.classList.remove("stale");
    } catch (failure) {
      if (failure instanceof Stale) return;
      this.element.classList.remove("stale");
      if (!(failure instanceof Refused)) throw failure;
      this.drawing.replaceChildren();
      fill(this.body, h("p", {class: "trouble", role: "alert"}, withCode(failure.message)), failure.help && h("p", {class: "hint"}, withCode(failure.help)));
    }
  }

  private async explain(library: string): Promise<void> {
    const answer = (await this.desk.questions.ask("explain", {library, plan: `[${this.plan}]`, nearest: 3}, "why")) as ExplainedPlan;
    const drawn = await drawPlans(this.desk, [answer.plan, ...answer.nearest.map((near) => near.plan)], "why");
    const pictures = drawn.each.length ? scaled(drawn.each) : [];
    pictures[0]?.setAttribute("aria-label", `The plan: ${answer.plan}`);
    this.drawing.replaceChildren(...(pictures[0] ? [pictures[0]] : drawn.whole ? [drawn.whole] : []));
    if (document.activeElement !== this.field) this.field.value = answer.plan;
    this.plan = answer.plan;
    this.mark();
    const decides = answer.clauses.filter((clause) => clause.drops);
    const others = answer.clauses.filter((clause) => !clause.drops);
    fill(
      this.body,
      this.verdict(answer, decides),
      this.buttons(answer, decides),
      decides.map((clause) => this.clause(clause, true)),
      answer.nearest.length > 0 && this.nearest(answer, pictures.slice(1)),
      answer.preferences?.length && h("section", null, h("h3", null, `It is worth ${answer.preference}`), h("ul", null, answer.preferences.map((one) => h("li", null, `${one.met ? "✓" : "–"} ${one.doc ?? one.name}, ${one.worth}`)))),
      others.length > 0 && h("details", {class: "others", open: decides.length === 0 && others.length <= 4},
        h("summary", null, decides.length ? `${others.length === 1 ? "Another clause has" : `${others.length} other clauses have`} nothing against it` : `${others.length === 1 ? "The clause" : `All ${others.length} clauses`}, and what ${others.length === 1 ? "it finds" : "they find"}`),
        others.map((clause) => this.clause(clause, false))),
    );
  }

  private verdict(answer: ExplainedPlan, decides: ExplainedClause[]): HTMLElement {
    if (answer.kept)
      return h("p", {class: "verdict kept"}, h("strong", null, "Kept."), answer.rank !== null && ` It is number ${grouped(answer.rank)} of ${answer.library}.`);
    const reasons = answer.too_short_or_long ? "The library has no plan with so many trays." : "";
    const names = decides.map((clause) => clause.doc ?? inWords(clause.name));
    return h("p", {class: "verdict gone"}, h("strong", null, "Gone."), ` ${reasons}`,
      names.length === 1 ? ` One clause leaves it out: ${names[0]}.` : names.length > 1 && ` ${names.length} clauses leave it out.`);
  }

  private buttons(answer: ExplainedPlan, decides: ExplainedClause[]): HTMLElement {
    const watched = this.desk.watched().includes(answer.plan);
    return h("div", {class: "tools"},
      h("button", {type: "button", "aria-pressed": String(watched), onclick: () => {
        this.desk.watch(answer.plan);
        void this.refresh();
      }}, watched ? "Watched" : "Watch this plan"),
      !this.desk.file()!.readOnly && this.caseMaker(answer, decides));
  }

  // The plan as a case of a test: of the library, or of a rule of this file.
  private caseMaker(answer: ExplainedPlan, decides: ExplainedClause[]): HTMLElement {
    const bare = bared(this.desk.file()!.text);
    const rules = (this.desk.shown()?.rules ?? []).filter((rule) => rule.schema && new RegExp(`^[ \\t]*rule\\s+${rule.name}(?![\\w-])`, "m").test(bare));
    const options = [
      h("option", {value: ""}, "as a case of a test …"),
      h("option", {value: "library:keep"}, `${answer.library} must keep it`),
      h("option", {value: "library:drop"}, `${answer.library} must leave it out`),
      ...rules.flatMap(({name}) => [h("option", {value: `match:${name}`}, `${name} must match it`), h("option", {value: `reject:${name}`}, `${name} must not match it`)]),
    ];
    const select = h("select", {"aria-label": "Add the plan as a case of a test", onchange: () => {
      const [verdict, name] = select.value.split(":");
      if (!verdict) return;
      const text = this.desk.file()!.text;
      const by = verdict === "library" && name === "drop" && decides.length === 1 && !decides[0].name.includes("@") ? decides[0].name : undefined;
      const edit = verdict === "library" ? addCase(text, answer.library, name as "keep" | "drop", answer.plan, by) : addCase(text, name, verdict as "match" | "reject", answer.plan);
      this.desk.edit([edit], "The case stands in the text now.");
      select.value = "";
    }}, options);
    return select;
  }

  private nearest(answer: ExplainedPlan, pictures: SVGSVGElement[]): HTMLElement {
    const one = (near: NearestPlan, i: number) => {
      pictures[i]?.setAttribute("aria-hidden", "true");
      return h("li", null, h("button", {type: "button", class: "card", title: near.plan, onclick: () => this.show(near.plan)},
        pictures[i] && h("span", {class: "drawing"}, pictures[i]), h("span", {class: "caption"}, withCode(near.changes ?? near.plan))));
    };
    return h("section", null, h("h3", null, answer.nearest.length === 1 && !answer.more ? "The nearest plan that is kept" : "The nearest plans that are kept"), h("ol", {class: "nearest"}, answer.nearest.map(one)));
  }

  private clause(clause: ExplainedClause, open: boolean): HTMLElement {
    const says = clause.kind === "prune"
      ? clause.matches ? "is pruned, and this plan has it" : "is pruned, and this plan does not have it"
      : clause.matches ? "is required, and is so" : "is required, and is not so";
    const name = inWords(clause.name);
    return h("details", {class: `clause ${clause.drops ? "gone" : "kept"}`, open},
      h("summary", null, h("span", {class: "sign", "aria-hidden": "true"}, clause.drops ? "✕" : "✓"), h("span", null, h("strong", null, clause.doc ?? name), h("span", {class: "hint"}, ` ${clause.doc ? `${name} ` : ""}${says}`))),
      this.tree(clause.why, 0));
  }

  private tree(part: ExplainedTree, depth: number): HTMLElement {
    const children = depth < DEEPEST ? part.parts : [];
    const row = h("div", {class: `part ${part.matched ? "met" : "unmet"}`, tabindex: "0"},
      h("span", {class: "sign", role: "img", "aria-label": part.matched ? "matches" : "does not match"}, part.matched ? "✓" : "–"),
      h("code", null, part.text.replace(/\s+/g, " ")), part.evidence && h("span", {class: "evidence"}, withCode(part.evidence)));
    const on = () => this.light(part);
    const off = () => {
      light(this.drawing.querySelector("svg"), []);
      this.desk.editor.unlight();
    };
    row.addEventListener("pointerenter", on);
    row.addEventListener("focus", on);
    row.addEventListener("pointerleave", off);
    row.addEventListener("blur", off);
    return h("div", {class: "tree"}, row, children.length > 0 && h("div", {class: "parts"}, children.map((child) => this.tree(child, depth + 1))));
  }

  private light(part: ExplainedTree): void {
    const places: TrayStretch[] = part.trays.length ? part.trays : part.closest ? [[part.closest.tray, part.closest.tray]] : part.run ? [part.run.trays] : [];
    light(this.drawing.querySelector("svg"), places);
    const file = this.desk.file()!;
    if (!part.line || (part.file && !part.file.endsWith(file.path))) return;
    const from = offsetOf(file.text, part.line, part.column ?? 1);
    const same = file.text.startsWith(part.text, from);
    const end = same ? from + part.text.length : file.text.indexOf("\n", from);
    this.desk.editor.light(from, end < 0 ? file.text.length : end);
  }

  private async house(library: string): Promise<void> {
    const answer = (await this.desk.questions.ask("explain", {library, house: this.plan}, "why")) as ExplainedHouse;
    const model = await this.desk.questions.ask("house", {house: this.plan, library, files: ["svg"], views: ["axonometric"]}, "why").catch((failure) => {
      if (failure instanceof Refused) return null;
      throw failure;
    });
    const svg = model?.files[0]?.text ? picture(model.files[0].text, "the house") : null;
    this.drawing.replaceChildren(...(svg ? [svg] : []));
    const decides = answer.clauses.filter((clause) => clause.drops);
    fill(
      this.body,
      answer.kept ? h("p", {class: "verdict kept"}, h("strong", null, "Kept."), ` ${answer.library} has this house.`) : h("p", {class: "verdict gone"}, h("strong", null, "Gone."), ` ${decides.map((clause) => inWords(clause.name)).join(", ")}`),
      answer.clauses.map((clause) => h("details", {class: `clause ${clause.drops ? "gone" : "kept"}`, open: clause.drops},
        h("summary", null, h("span", {class: "sign", "aria-hidden": "true"}, clause.drops ? "✕" : "✓"), h("span", null, h("strong", null, inWords(clause.name)), h("span", {class: "hint"}, ` about the ${clause.of}`))),
        clause.why.map((why) => h("p", null, h("code", null, why.question), ` ${why.found.length ? why.found.join(", ") : "finds nothing"}`)))),
      answer.bare.map((cell) => h("p", null, h("strong", null, cell.cell), " can have no tile: ", cell.tiles.map((tile) => `${tile.tile}: ${tile.why}`).join("; "))),
      answer.nearest?.length && h("section", null, h("h3", null, "The nearest houses that are kept"), h("ul", null, answer.nearest.map((near) =>
        h("li", null, h("button", {type: "button", class: "link", onclick: () => this.show(near.house)}, near.where ? `${near.where}: ${near.to} instead of ${near.from}` : (near.changes ?? []).map((step) => `${step.where}: ${step.to}`).join(", ")))))),
    );
  }
}
