// How the tests of the file come out, and which small changes of rules none of them would notice.
import type {Desk} from "./desk";
import {fill, h, withCode} from "./dom";
import {addCase, offsetOf} from "./edits";
import {Refused, Stale, type Note} from "./questions";
import type {CoveragePart, MeasuredCoverage, Tested} from "./requests";

const MOST = 40;

export class Tests {
  readonly element = h("section", {class: "pane tests", "aria-label": "Tests"});
  private coverage = h("section", null);

  constructor(private desk: Desk) {}

  async refresh(): Promise<void> {
    const {answer, notes} = await this.desk.questions.askWithNotes("test", {}, "test");
    const {passed, failed, todo} = answer as Tested;
    const wrong = notes.filter((note) => note.severity !== "note");
    fill(
      this.element,
      passed + failed + todo === 0
        ? [h("p", {class: "lead"}, "This file has no tests yet."), h("p", {class: "hint"}, "Click a plan and say what is to become of it: the case goes into the text, and is asked again at each change.")]
        : h("p", {class: `verdict ${failed ? "gone" : "kept"}`}, h("strong", null, failed ? `${failed} of ${passed + failed + todo} fail.` : `All ${passed + todo} come out as they should.`), todo > 0 && ` ${todo} are marked as still to do.`),
      wrong.length > 0 && h("ul", {class: "findings"}, wrong.map((note) => this.note(note))),
      this.coverage,
    );
    fill(this.coverage, passed + failed > 0 && h("button", {type: "button", onclick: () => void this.cover()}, "What would they not notice?"));
  }

  private note(note: Note): HTMLElement {
    return h("li", {class: note.severity}, h("p", null, withCode(note.message), note.line && this.jump(note.line, note.column ?? 1)), note.help && h("p", {class: "hint"}, withCode(note.help)));
  }

  private jump(line: number, column: number): HTMLElement {
    return h("button", {type: "button", class: "link line", onclick: () => this.desk.editor.goTo(offsetOf(this.desk.file()!.text, line, column))}, `line ${line}`);
  }

  private async cover(): Promise<void> {
    fill(this.coverage, h("p", {class: "hint"}, "Each rule is changed a little, and the tests are asked whether they notice …"));
    try {
      const answer = (await this.desk.questions.ask("coverage", {library: this.desk.library()?.name}, "coverage")) as MeasuredCoverage;
      const parts = answer.rules.flatMap((rule) => rule.parts.filter((part) => part.outcome === "survives" && part.test));
      fill(this.coverage,
        h("p", null, h("strong", null, `${answer.noticed} of ${answer.parts} small changes of the rules are noticed.`), parts.length === 0 && answer.survive === 0 && " No other would keep other plans."),
        parts.length > 0 && h("ul", {class: "findings"}, parts.slice(0, MOST).map((part) => this.part(part))));
    } catch (failure) {
      if (failure instanceof Stale) return;
      if (!(failure instanceof Refused)) throw failure;
      fill(this.coverage, h("p", {class: "trouble", role: "alert"}, withCode(failure.message)));
    }
  }

  private part(part: CoveragePart): HTMLElement {
    const found = /^\s*(match|reject|keep|drop)\s+\[(.*?)\]/s.exec(part.test!);
    return h("li", null,
      h("p", null, h("code", null, part.text), ` ${part.change}${part.to ? ` ${part.to}` : ""}: no test notices`, part.line && this.jump(part.line, part.column ?? 1)),
      found && part.subject && !this.desk.file()!.readOnly && h("button", {type: "button", class: "quiet", onclick: () =>
        this.desk.edit([addCase(this.desk.file()!.text, part.subject!, found[1] as "match", found[2])], "The case stands in the text now.")}, "Add the case that would"));
  }
}
