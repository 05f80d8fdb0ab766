// "Add a rule": a sentence of choices that becomes a rule in the text.
import type {Desk} from "./desk";
import {fill, h} from "./dom";
import {addRule, freeName, libraryBlock} from "./edits";
import {PLACES, sentence, trayChoices} from "./sentences";

export class AddRule {
  readonly element: HTMLDialogElement;
  private body = h("div", null);

  constructor(private desk: Desk) {
    this.element = h("dialog", {class: "add-rule", "aria-label": "Add a rule"}, this.body);
    this.element.addEventListener("click", (event) => {
      if (event.target === this.element) this.element.close();
    });
  }

  show(): void {
    const schema = this.desk.schema();
    const library = this.desk.library();
    const text = this.desk.file()?.text ?? "";
    if (!schema || !library || library.form || !libraryBlock(text, library.name)) {
      fill(this.body, h("p", null, "A rule can be added as soon as the text compiles and has a library of plans of its own."), this.foot(null));
      this.element.showModal();
      return;
    }
    const choices = trayChoices(schema);
    const options = choices.map(({label}, i) => h("option", {value: i}, label));
    const verdict = h("select", {"aria-label": "What becomes of such plans"}, h("option", {value: "require"}, "Keep only"), h("option", {value: "prune"}, "Leave out"));
    const one = h("select", {"aria-label": "Which tray"}, options);
    const place = h("select", {"aria-label": "Where it stands"}, PLACES.map(({key, label}) => h("option", {value: key}, label)));
    const other = h("select", {"aria-label": "Which other tray"}, options.map((option) => option.cloneNode(true)));
    const preview = h("pre", {"aria-live": "polite"});
    const made = () => {
      const found = PLACES.find(({key}) => key === place.value)!;
      other.hidden = !found.two;
      const rule = sentence(choices[Number(one.value)], found, choices[Number(other.value)]);
      rule.name = freeName(text, rule.name);
      preview.textContent = `rule ${rule.name} "${rule.doc}" =\n  ${rule.text}\n\n${verdict.value} ${rule.name}`;
      return rule;
    };
    for (const select of [verdict, one, place, other]) select.addEventListener("change", made);
    made();
    fill(
      this.body,
      h("p", {class: "sentence"}, verdict, " plans with a tray that is ", one, " ", place, " ", other),
      h("p", {class: "hint"}, "This is what goes into the text, where you can change it:"),
      preview,
      this.foot(() => {
        const edits = addRule(text, library.name, verdict.value as "require" | "prune", made());
        if (edits) this.desk.edit(edits, "The rule stands in the text now.");
      }),
    );
    this.element.showModal();
  }

  private foot(add: (() => void) | null): HTMLElement {
    return h("div", {class: "foot"},
      h("button", {type: "button", class: "quiet", onclick: () => this.element.close()}, add ? "Cancel" : "Close"),
      add && h("button", {type: "button", class: "primary", onclick: () => {
        this.element.close();
        add();
      }}, "Add it"));
  }
}
