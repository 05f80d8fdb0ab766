// What a rule does to the library that is shown: how many plans it leaves out, and one of them.
import type {Desk} from "./desk";
import {fill, h} from "./dom";
import {drawPlans, scaled} from "./drawn";
import {addClause} from "./edits";
import {grouped} from "./numbers";
import {Refused} from "./questions";
import type {CountedPlans, SampleRequest} from "./requests";

interface Said {
  sentence: (string | HTMLElement)[];
  example: string; // what the plan that is shown is
  from: Partial<SampleRequest> | null; // where it is drawn from
  unused: boolean;
}

const strong = (digits: string | null) => h("strong", null, digits === null ? "too many to count" : grouped(digits));

export class Effect {
  readonly element = h("section", {class: "rule-effect", "aria-label": "What the rule does"});

  constructor(private desk: Desk) {}

  clear(): void {
    fill(this.element);
  }

  // `schema`: of the trays that the rule is about.
  async show(rule: string, schema: string | undefined): Promise<void> {
    const library = this.desk.library();
    const counts = this.desk.counts();
    if (!library || library.form || !counts || this.desk.schema()?.name !== schema) return this.clear();
    const said = this.ofClause(rule, counts) ?? (await this.ofUnused(rule, library.name));
    const plan = said.from && (await this.one(rule, library.name, said.from));
    const drawn = plan ? await drawPlans(this.desk, [plan], "rule example") : null;
    const picture = drawn?.each.length ? scaled(drawn.each)[0] : drawn?.whole;
    picture?.setAttribute("aria-hidden", "true");
    fill(this.element,
      h("p", {class: "rule-count"}, said.sentence),
      said.unused && !this.desk.file()!.readOnly && this.uses(rule, library.name),
      plan && h("button", {type: "button", class: "card", title: plan, onclick: () => this.desk.explain(plan)},
        picture && h("span", {class: "drawing"}, picture), h("span", {class: "caption"}, said.example), h("span", {class: picture ? "sr" : "line"}, plan)));
  }

  private ofClause(rule: string, counts: CountedPlans): Said | null {
    const prune = counts.rules?.find((clause) => clause.name === rule);
    if (prune) {
      const none = prune.prunes === "0";
      return {
        sentence: none ? ["It leaves out no plan."] : ["It leaves out ", strong(prune.prunes), ` of ${grouped(counts.generated ?? "0")} plans`, prune.only === "0" ? ", which other clauses leave out too." : prune.only ? [`, ${grouped(prune.only)} of them alone.`].join("") : "."],
        example: "one that it leaves out", from: none ? null : {generated: true}, unused: false,
      };
    }
    const requirement = counts.requirements?.find((clause) => clause.name === rule);
    return requirement ? {
      sentence: ["Only plans that match it are kept. Of all that there could be, it leaves out ", strong(requirement.keeps_out), "."],
      example: "one that matches", from: {}, unused: false,
    } : null;
  }

  private async ofUnused(rule: string, library: string): Promise<Said> {
    const {kept} = (await this.desk.questions.ask("count", {library, where: [rule], no_effects: true}, "rule")) as CountedPlans;
    return {
      sentence: [`No clause of ${library} asks for it. Of the plans kept, `, strong(kept), kept === "1" ? " matches." : " match."],
      example: "one that matches", from: kept === "0" ? null : {}, unused: true,
    };
  }

  // A plan that matches the rule; null if there is none, or none is found within the limits.
  private async one(rule: string, library: string, from: Partial<SampleRequest>): Promise<string | null> {
    try {
      const found = await this.desk.questions.ask("sample", {library, where: [rule], count: 1, uniform: true, lines: true, ...from}, "rule");
      return "plans" in found ? ((found.plans[0] as {plan?: string} | undefined)?.plan ?? null) : null;
    } catch (failure) {
      if (failure instanceof Refused) return null;
      throw failure;
    }
  }

  private uses(rule: string, library: string): HTMLElement {
    const button = (clause: "require" | "prune", label: string) => h("button", {type: "button", onclick: () => {
      const edit = addClause(this.desk.file()!.text, library, clause, rule);
      if (edit) this.desk.edit([edit], `${library} has a clause more: ${clause} ${rule}.`);
      else this.desk.say(`${library} stands in a file that this one uses, so its clauses are changed there.`);
    }}, label);
    return h("div", {class: "tools"}, button("prune", "Leave such plans out"), button("require", "Keep only such plans"));
  }
}

