// What the text does to the library since it was last saved: plans that went, plans that came, and the clauses that did
// it.
import type {Desk} from "./desk";
import {fill, h} from "./dom";
import {drawPlans, scaled} from "./drawn";
import {decimal, grouped, inWords, plans as plural} from "./numbers";
import type {Compared, ComparedMeasure, RankedLine} from "./requests";

const EXAMPLES = 5;

export class Changes {
  readonly element = h("section", {class: "pane changes", "aria-label": "What changed"});

  constructor(private desk: Desk) {}

  async refresh(): Promise<void> {
    const file = this.desk.file();
    const library = this.desk.library();
    if (!file || !library) return;
    if (!file.changed) {
      fill(this.element, h("p", {class: "lead"}, "Nothing has changed since the file was saved."), h("p", {class: "hint"}, "Change a rule, and this page shows which plans go and which come."));
      return;
    }
    if (!file.saved.trim()) {
      fill(this.element, h("p", {class: "lead"}, "The file has not been saved yet, so there is nothing to compare with."));
      return;
    }
    const before = file.path.replace(/\.plan$/, ".saved.plan");
    const asked = await this.desk.questions.askWithNotes("diff", {library: library.name, before, sample: EXAMPLES}, "diff", {[before]: file.saved});
    const answer = asked.answer as Compared;
    const total = answer.total;
    const what = library.form ? "house" : "plan";
    fill(
      this.element,
      h("p", {class: "lead"}, "Since the file was saved:"),
      h("dl", {class: "totals"},
        h("div", {class: "gone"}, h("dt", null, "gone"), h("dd", null, grouped(total.removed))),
        h("div", {class: "kept"}, h("dt", null, "new"), h("dd", null, grouped(total.added))),
        h("div", null, h("dt", null, "as before"), h("dd", null, grouped(total.kept)))),
      answer.clauses.length > 0 && h("section", null, h("h2", null, "Which clauses did it"), h("ul", {class: "changed"}, answer.clauses.map((clause) =>
        h("li", null, h("strong", null, inWords(clause.name)), ` is ${clause.change}`,
          clause.removes !== "0" && `, and leaves out ${plural(clause.removes, what)} that ${clause.removes === "1" ? "was" : "were"} kept`,
          clause.adds !== "0" && `, and no longer leaves out ${plural(clause.adds, what)}`, ".")))),
      answer.measures?.length && this.measures(answer.measures),
    );
    await this.examples("Plans that are gone", "gone", answer.plans?.removed ?? []);
    await this.examples("Plans that are new", "kept", answer.plans?.added ?? []);
  }

  private measures(measures: ComparedMeasure[]): HTMLElement {
    const side = (value: string | null, before: string | null) => h("td", {class: "num"}, value === before ? decimal(value) : [decimal(before), " → ", decimal(value)].join(""));
    return h("section", null, h("h2", null, "What that does to measures"), h("table", {class: "by-length"},
      h("thead", null, h("tr", null, h("th", {scope: "col"}, "measure"), ["least", "mean", "most"].map((name) => h("th", {scope: "col", class: "num"}, name)))),
      h("tbody", null, measures.map(({name, unit, before, after}) => h("tr", null, h("th", {scope: "row"}, name, unit && h("span", {class: "faint"}, ` ${unit}`)), side(after.least, before.least), side(after.mean, before.mean), side(after.most, before.most))))));
  }

  private async examples(title: string, kind: string, lines: RankedLine[]): Promise<void> {
    if (!lines.length) return;
    const drawn = await drawPlans(this.desk, lines.map((line) => line.plan), `diff ${kind}`);
    const pictures = drawn.each.length ? scaled(drawn.each) : [];
    this.element.append(h("section", {class: kind}, h("h2", null, title), h("ol", {class: "sheet"}, lines.map(({plan}, i) => {
      pictures[i]?.setAttribute("aria-hidden", "true");
      return h("li", null, h("button", {type: "button", class: "card", title: plan, onclick: () => this.desk.explain(plan)},
        pictures[i] && h("span", {class: "drawing"}, pictures[i]), h("span", {class: "caption"}, kind === "gone" ? "why is it gone?" : "new"), h("span", {class: pictures[i] ? "sr" : "line"}, plan)));
    }))));
  }
}
