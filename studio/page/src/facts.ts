// How many plans there are, by their length, what each clause does, and what is said of the rules.
import type {Desk} from "./desk";
import {fill, h, withCode} from "./dom";
import {bar, drawPlans, scaled} from "./drawn";
import {counted, grouped, inWords, percent, rounded, share} from "./numbers";
import {offsetOf} from "./edits";
import type {CheckFinding, CountedHouses, CountedPlans, ShownLibrary} from "./requests";

interface Clause {
  name: string;
  doc: string;
  verb: string;
  out: string | null | undefined;
  only: string | null | undefined;
}

function called(name: string): {label: string; line: number} {
  const line = Number(/@(\d+)/.exec(name)?.[1] ?? 0);
  return {label: inWords(name), line};
}

const escaped = (name: string) => name.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");

// The rule's beginning, where it stands in this text.
function ruleIn(text: string, name: string): RegExpExecArray | null {
  return new RegExp(`^[ \\t]*rule\\s+(${escaped(name)})(?![\\w-])`, "m").exec(text);
}

export class Facts {
  readonly element: HTMLElement;
  private lengths = h("section", {"aria-label": "By length"});
  private clauses = h("section", {"aria-label": "Clauses"});
  private warnings = h("section", {"aria-label": "Warnings"});

  constructor(private desk: Desk) {
    this.element = h("aside", {class: "facts", "aria-label": "Counts"}, this.lengths, this.clauses, this.warnings);
  }

  clear(): void {
    fill(this.lengths);
    fill(this.clauses);
    fill(this.warnings);
  }

  count(library: ShownLibrary, answer: CountedPlans): void {
    const most = answer.by_length.reduce((max, row) => (row.kept !== null && BigInt(row.kept) > BigInt(max) ? row.kept : max), "0");
    fill(
      this.lengths,
      h("h2", null, "By number of trays"),
      h("table", {class: "lengths"},
        h("thead", {class: "sr"}, h("tr", null, h("th", {scope: "col"}, "trays"), h("th", {scope: "col"}, "share"), h("th", {scope: "col"}, "kept"), h("th", {scope: "col"}, "of those generated"))),
        h("tbody", null, answer.by_length.map((row) =>
          h("tr", {title: `${counted(row.kept)} of ${counted(row.generated)} generated`},
            h("th", {scope: "row"}, row.length), h("td", {class: "bar-cell"}, bar(share(row.kept, most))),
            h("td", {class: "num"}, counted(row.kept)), h("td", {class: "num faint"}, percent(row.kept, row.generated)))))),
    );
    const doc = (name: string) => library.clauses.find((clause) => clause.name === name)?.doc ?? "";
    this.list([
      ...(answer.requirements ?? []).map((clause) => ({name: clause.name, doc: doc(clause.name), verb: clause.name === "total" ? "bounds" : "requires", out: clause.keeps_out, only: clause.only})),
      ...(answer.rules ?? []).map((clause) => ({name: clause.name, doc: doc(clause.name), verb: "prunes", out: clause.prunes, only: clause.only})),
    ], "plans");
  }

  houses(library: ShownLibrary, answer: CountedHouses): void {
    const most = Object.values(answer.by_length).reduce((max, digits) => (BigInt(digits) > BigInt(max) ? digits : max), "0");
    const row = (name: string, digits: string) => h("tr", null, h("th", {scope: "row"}, name), h("td", {class: "bar-cell"}, bar(share(digits, most))), h("td", {class: "num"}, grouped(digits)));
    fill(
      this.lengths,
      h("h2", null, "Houses by number of trays"),
      h("table", {class: "lengths"}, h("tbody", null, Object.entries(answer.by_length).map(([name, digits]) => row(name, digits)))),
      Object.entries(answer.by_section).map(([choice, values]) => [
        h("h2", null, choice),
        h("table", {class: "lengths"}, h("tbody", null, Object.entries(values).map(([name, digits]) => row(name, digits)))),
      ]).flat(),
    );
    this.list(library.clauses.map(({name, doc, kind}) => ({name, doc: doc ?? "", verb: kind === "prune" ? "prunes" : "requires", out: answer.kept_out?.[name], only: answer.only?.[name]})), "houses");
  }

  private list(clauses: Clause[], what: string): void {
    if (!clauses.length) {
      fill(this.clauses, h("h2", null, "Clauses"), h("p", {class: "hint"}, `The library has no clause yet, so all ${what} that it generates are kept. “Add a rule” makes the first.`));
      return;
    }
    const sorted = [...clauses].sort((a, b) => (a.only && b.only ? (BigInt(b.only) > BigInt(a.only) ? 1 : BigInt(b.only) < BigInt(a.only) ? -1 : 0) : 0));
    fill(
      this.clauses,
      h("h2", null, "What each clause does"),
      h("table", {class: "clauses"},
        h("thead", null, h("tr", null, h("th", {scope: "col"}, "clause"), h("th", {scope: "col", class: "num", title: `${what} that no other clause leaves out, and all that it does`}, "leaves out alone"))),
        h("tbody", null, sorted.map((clause) => this.clause(clause)))),
    );
  }

  private clause({name, doc, verb, out, only}: Clause): HTMLElement {
    const {label, line} = called(name);
    return h("tr", {class: only === "0" ? "idle" : ""},
      h("th", {scope: "row"},
        h("button", {type: "button", class: "link", onclick: () => this.jump(name, line)}, label),
        h("span", {class: `verb ${verb}`}, verb),
        !line && ruleIn(this.desk.file()!.text, name) && h("button", {type: "button", class: "link picture-of", "aria-label": `${name} as a picture`, onclick: () => this.desk.showRule(name)}, "picture"),
        doc && h("span", {class: "doc"}, doc)),
      h("td", {class: "num", title: only && out ? `${grouped(only)} of ${grouped(out)}` : null},
        only === undefined ? "" : only === "0" ? "nothing" : rounded(only), out !== undefined && h("span", {class: "of"}, `of ${rounded(out)}`)));
  }

  private jump(name: string, line: number): void {
    const text = this.desk.file()!.text;
    if (line) {
      const at = offsetOf(text, line, 1);
      this.desk.editor.goTo(at);
      return;
    }
    const found = ruleIn(text, name) ?? new RegExp(`(?<![\\w-])(${escaped(name)})(?![\\w-])`).exec(text);
    if (!found) return this.desk.say(`${name} stands in a file that this one uses.`);
    const at = found.index + found[0].length - found[1].length;
    this.desk.editor.goTo(at, at + found[1].length);
  }

  // Findings with the plans that prove them: a note that ends in a plan has it behind its last colon.
  async check(findings: CheckFinding[]): Promise<void> {
    const own = findings.filter((finding) => finding.severity !== "note");
    if (!own.length) return fill(this.warnings);
    const witnesses = own.map((finding) => finding.notes.map((note) => /: ([^:]+(?::[^:\s][^:]*)*)$/.exec(note.message)?.[1] ?? "").find((text) => text.includes(" | ")) ?? "");
    const rows = own.map((finding, i) => this.finding(finding, witnesses[i]));
    fill(this.warnings, h("h2", null, own.length === 1 ? "One thing to look at" : `${own.length} things to look at`), h("ul", {class: "findings"}, rows.map((row) => row.element)));
    const plans = witnesses.filter((plan) => plan);
    if (!plans.length) return;
    const drawn = await drawPlans(this.desk, plans, "witnesses");
    if (!drawn.each.length) return;
    const pictures = scaled(drawn.each);
    for (const svg of pictures) svg.setAttribute("aria-hidden", "true");
    let n = 0;
    own.forEach((_finding, i) => witnesses[i] && rows[i].place.replaceChildren(pictures[n++]));
  }

  private finding(finding: CheckFinding, witness: string): {element: HTMLElement; place: HTMLElement} {
    const place = h("span", {class: "drawing"});
    const element = h("li", {class: finding.severity},
      h("p", null, withCode(finding.message), finding.line && h("button", {
        type: "button", class: "link line",
        onclick: () => this.desk.editor.goTo(offsetOf(this.desk.file()!.text, finding.line!, finding.column ?? 1), offsetOf(this.desk.file()!.text, finding.end_line ?? finding.line!, finding.end_column ?? 1)),
      }, `line ${finding.line}`)),
      witness && h("button", {type: "button", class: "card witness", title: witness, onclick: () => this.desk.explain(witness)}, place, h("span", {class: "sr"}, `for example ${witness}`)),
      finding.help && h("p", {class: "hint"}, withCode(finding.help)));
    return {element, place};
  }
}
