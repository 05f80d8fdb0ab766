// The room on the right: the library of the file that is shown, asked anew after each change.
import {AddRule} from "./add_rule";
import {Changes} from "./changes";
import type {Desk} from "./desk";
import {fill, h, withCode} from "./dom";
import {offsetOf} from "./edits";
import {Facts} from "./facts";
import {FormRoom} from "./form_room";
import {Measures} from "./measures";
import {counted, grouped} from "./numbers";
import {OpenPlan} from "./open_plan";
import {Refused, Stale} from "./questions";
import {RulePane} from "./rule_pane";
import type {CountedHouses, CountedPlans, ShownFile, ShownLibrary} from "./requests";
import {Sheet} from "./sheet";
import {Sliders} from "./sliders";
import {Tests} from "./tests_pane";
import {Watched} from "./watched";
import {Why} from "./why";

interface Pane {
  key: string;
  label: string;
  element: HTMLElement;
  refresh: () => Promise<void>;
}

export class LibraryRoom {
  readonly element = h("section", {class: "library", "aria-label": "Library"});
  readonly addRule: AddRule;
  readonly why: Why;
  readonly watchedPlans: Watched;
  private forms: FormRoom;
  shown: ShownFile | null = null;
  library: ShownLibrary | null = null;
  counts: CountedPlans | null = null; // of the library, as it was when it was last counted
  readonly rule: RulePane;
  private head = h("header", {class: "library-head"});
  private trouble = h("div", {class: "trouble-bar", role: "status", hidden: true});
  private content = h("div", {class: "content"});
  private plain = h("section", {class: "plain", hidden: true});
  private sliders: Sliders;
  readonly sheet: Sheet;
  private facts: Facts;
  private panes: Pane[];
  private pane = "plans";
  private tabs = h("div", {class: "tabs", role: "tablist", "aria-label": "The library"});
  private before = ""; // the pane that was shown before there was no library
  private wanted = ""; // the library that was chosen, by its name
  private run = 0;

  constructor(private desk: Desk) {
    this.sliders = new Sliders(desk);
    this.sheet = new Sheet(desk, () => void this.attempt(() => this.sheet.refresh(), this.sheet.element));
    this.facts = new Facts(desk);
    this.addRule = new AddRule(desk);
    this.why = new Why(desk);
    this.watchedPlans = new Watched(desk);
    this.rule = new RulePane(desk);
    this.forms = new FormRoom(desk);
    const measures = new Measures(desk);
    const open = new OpenPlan(desk);
    const changes = new Changes(desk);
    const tests = new Tests(desk);
    const plans = h("div", {class: "plans-pane"}, h("div", {class: "main-column"}, this.watchedPlans.element, this.sheet.element), this.facts.element);
    this.panes = [
      {key: "plans", label: "Plans", element: plans, refresh: async () => {}},
      {key: "rule", label: "Rule", element: this.rule.element, refresh: () => this.rule.refresh()},
      {key: "measures", label: "Measures", element: measures.element, refresh: () => measures.refresh()},
      {key: "open", label: "Open plan", element: open.element, refresh: () => open.refresh()},
      {key: "changes", label: "What changed", element: changes.element, refresh: () => changes.refresh()},
      {key: "tests", label: "Tests", element: tests.element, refresh: () => tests.refresh()},
    ];
    this.resetPanes = () => open.reset();
    for (const pane of this.panes) {
      pane.element.id = `pane-${pane.key}`;
      pane.element.setAttribute("role", "tabpanel");
      pane.element.setAttribute("aria-labelledby", `tab-${pane.key}`);
    }
    this.renderTabs();
    append(this.content, [this.head, this.sliders.element, this.tabs, ...this.panes.map((pane) => pane.element)]);
    append(this.element, [this.trouble, this.content, this.forms.element, this.plain, this.why.element]);
  }

  private resetPanes: () => void;

  private renderTabs(): void {
    fill(this.tabs, this.panes.map((pane) => h("button", {
      type: "button", role: "tab", id: `tab-${pane.key}`, "aria-controls": `pane-${pane.key}`, "aria-selected": String(pane.key === this.pane), tabindex: pane.key === this.pane ? "0" : "-1",
      onclick: () => this.choose(pane.key),
      onkeydown: (event: KeyboardEvent) => {
        const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
        if (!step) return;
        const next = this.panes[(this.panes.indexOf(pane) + step + this.panes.length) % this.panes.length];
        this.choose(next.key);
        document.getElementById(`tab-${next.key}`)!.focus();
      },
    }, pane.label)));
    for (const pane of this.panes) pane.element.hidden = pane.key !== this.pane;
  }

  choose(key: string): void {
    if (this.pane === "rule" && key !== "rule") this.rule.leave();
    this.pane = key;
    this.element.dataset.pane = key;
    for (const tab of this.tabs.children) {
      const on = tab.id === `tab-${key}`;
      tab.setAttribute("aria-selected", String(on));
      tab.setAttribute("tabindex", on ? "0" : "-1");
    }
    for (const pane of this.panes) pane.element.hidden = pane.key !== key;
    void this.refreshPane();
  }

  async refreshPane(): Promise<void> {
    const pane = this.panes.find((one) => one.key === this.pane)!;
    await this.attempt(pane.refresh, pane.element);
  }

  schemaOf(library: ShownLibrary | null): string | undefined {
    if (!library?.form) return library?.schema;
    return this.schemaOf(this.shown?.libraries.find((one) => one.name === library.plans) ?? null);
  }

  // Another file is shown.
  another(): void {
    this.run++;
    this.shown = null;
    this.library = null;
    this.wanted = "";
    this.sliders.clear();
    this.sheet.reset();
    this.facts.clear();
    this.counts = null;
    this.forms.another();
    this.resetPanes();
    this.rule.reset();
    if (this.why.open) this.why.close();
    this.trouble.hidden = true;
    fill(this.head);
    this.content.classList.add("waiting");
  }

  // The text is another: what is shown is faded until it is known what is so now.
  async refresh(): Promise<void> {
    const file = this.desk.file();
    if (!file) return;
    const run = ++this.run;
    this.desk.questions.cancel();
    const plan = file.languageId === "plan" && !file.standard;
    const form = this.showsForm;
    this.content.hidden = !plan;
    this.forms.element.hidden = !form;
    this.plain.hidden = plan || form;
    if (!plan && !form) return this.other();
    this.element.classList.add("stale");
    try {
      if (plan && this.pane === "rule") await this.rule.follow();
      await (form ? this.form(run) : this.ask(run));
      this.fresh();
    } catch (failure) {
      if (failure instanceof Stale || run !== this.run) return;
      if (!(failure instanceof Refused)) throw failure;
      if (form && this.forms.refused(failure)) return this.fresh();
      this.element.classList.add("wrong");
      this.say(failure);
    }
  }

  // Does the file make a form, and no plans?
  get showsForm(): boolean {
    const file = this.desk.file();
    return file !== null && !file.standard && this.forms.takes(file.languageId);
  }

  private async form(run: number): Promise<void> {
    await this.forms.refresh();
    this.fresh();
    await this.forms.settings();
    if (run !== this.run) throw new Stale();
  }

  // What is largest is as the text says now; the rest follows.
  private fresh(): void {
    this.trouble.hidden = true;
    this.element.classList.remove("stale", "wrong");
  }

  private async ask(run: number): Promise<void> {
    const {questions} = this.desk;
    this.shown = await questions.ask("schema", {used: true}, "file");
    const own = (await questions.ask("schema", {}, "own")).libraries;
    const libraries = own.length ? own : this.shown.libraries;
    this.library = libraries.find((one) => one.name === this.wanted) ?? libraries.at(-1) ?? null;
    this.content.classList.remove("waiting");
    if (!this.library) return this.withoutLibrary();
    this.panes[0].element.classList.remove("no-library");
    this.element.classList.remove("without-library");
    this.tabs.hidden = false;
    if (this.before) this.choose(this.before);
    this.before = "";
    const steps = [
      () => this.attempt(() => this.sheet.refresh(), this.sheet.element),
      () => this.count(this.library!, libraries),
      async () => this.fresh(),
      () => this.attempt(() => this.sliders.refresh(), this.sliders.element),
      () => this.attempt(() => this.watchedPlans.refresh(), this.watchedPlans.element),
      () => this.why.refresh(),
      () => this.refreshPane(),
      () => this.attempt(async () => this.facts.check((await questions.ask("check", {}, "check")).findings), this.facts.element),
    ];
    for (const step of steps) {
      await step();
      if (run !== this.run) throw new Stale();
    }
  }

  private withoutLibrary(): void {
    fill(this.head, h("div", {class: "name"}, h("h2", {class: "title"}, "No library yet")), h("p", {class: "doc"}, "The text compiles, but nothing in it says which plans there are. A library does, such as this:"),
      h("pre", null, `library plans using ${this.shown?.schemas.at(-1)?.name ?? "SCHEMA"} {\n  trays 3..5\n}`));
    this.sheet.reset();
    this.facts.clear();
    this.counts = null;
    this.element.classList.add("without-library");
    this.tabs.hidden = !this.shown?.schemas.length;
    if (this.tabs.hidden) return this.panes.forEach((pane) => (pane.element.hidden = true));
    if (this.pane !== "rule") this.before = this.pane;
    this.choose("rule");
  }

  private async count(library: ShownLibrary, libraries: ShownLibrary[]): Promise<void> {
    const {questions} = this.desk;
    const answer = await questions.ask("count", {library: library.name, clauses: Boolean(library.form) || undefined}, "count");
    this.panes.forEach((pane) => (pane.element.hidden = pane.key !== this.pane));
    if (library.form) {
      const houses = answer as CountedHouses;
      this.renderHead(library, libraries, houses.houses, ["houses", `on ${counted(houses.plans_with_houses ?? houses.plans)} plans`]);
      this.counts = null;
      this.facts.houses(library, houses);
    } else {
      const plans = answer as CountedPlans;
      this.renderHead(library, libraries, plans.kept, [plans.kept === "1" ? "plan kept" : "plans kept", `of ${counted(plans.generated)} generated`]);
      this.counts = plans;
      this.facts.count(library, plans);
    }
  }

  private renderHead(library: ShownLibrary, libraries: ShownLibrary[], count: string | null, [what, of]: [string, string]): void {
    const focused = document.activeElement?.id;
    const own = !library.form && !this.desk.file()!.readOnly;
    fill(
      this.head,
      h("div", {class: "name"},
        libraries.length > 1
          ? h("h2", {class: "title"}, h("select", {id: "library-name", "aria-label": "Library", onchange: (event: Event) => {
            this.wanted = (event.target as HTMLSelectElement).value;
            this.sheet.reset();
            this.resetPanes();
            void this.refresh();
          }}, libraries.map(({name}) => h("option", {value: name, selected: name === library.name}, name))))
          : h("h2", {class: "title"}, library.name),
        library.doc && h("p", {class: "doc"}, library.doc)),
      h("p", {class: "count", role: "status"}, h("strong", {id: "count"}, count === null ? "too many to count" : grouped(count)), " ", h("span", {class: "what"}, `${what} `, h("span", {class: "of"}, of))),
      h("div", {class: "actions"},
        own && h("button", {id: "add-rule", type: "button", onclick: () => this.addRule.show()}, "Add a rule"),
        !library.form && h("button", {id: "ask-plan", type: "button", class: "quiet", onclick: () => this.askPlan()}, "Ask about a plan")),
    );
    if (focused) document.getElementById(focused)?.focus();
  }

  // Any plan can be asked about: the drawer begins with the first one that is shown, to be changed.
  private askPlan(): void {
    const first = this.sheet.element.querySelector("[data-line]")?.getAttribute("data-line");
    const length = this.library?.trays?.[0] ?? 1;
    const defaults = this.desk.schema()?.fields.map((field) => field.values[0].spelling).join(" ") ?? "";
    this.why.show(first ?? Array.from({length}, () => defaults).join(" | "));
    this.why.element.querySelector("input")?.select();
    this.why.element.querySelector("input")?.focus();
  }

  // Runs a question of one part: what is wrong is told there, and what comes too late is left.
  private async attempt(work: () => Promise<void>, place: HTMLElement): Promise<void> {
    place.querySelector(":scope > .refused")?.remove();
    try {
      await work();
    } catch (failure) {
      if (failure instanceof Stale) return;
      if (!(failure instanceof Refused)) throw failure;
      place.prepend(h("p", {class: "trouble refused", role: "alert"}, withCode(failure.message), failure.help && h("span", {class: "hint"}, " ", withCode(failure.help))));
    }
  }

  private say(failure: Refused): void {
    const file = this.desk.file()!;
    const elsewhere = failure.path !== "" && !failure.path.endsWith(file.path);
    fill(this.trouble,
      h("p", null, h("strong", null, failure.line ? `${elsewhere ? `${failure.path}, line` : "Line"} ${failure.line}: ` : ""), withCode(failure.message), failure.help && h("span", {class: "hint"}, " ", withCode(failure.help))),
      failure.line > 0 && !elsewhere && h("button", {type: "button", onclick: () => this.desk.editor.goTo(offsetOf(file.text, failure.line, failure.column || 1))}, "Show it"));
    this.trouble.hidden = false;
  }

  // A file of the standard library, or of a notation that makes nothing to be drawn.
  private other(): void {
    const file = this.desk.file()!;
    if (file.standard) {
      const before = this.desk.before();
      fill(this.plain, h("h2", {class: "title"}, file.path), h("p", {class: "lead"}, "This file comes with Tartan. Other files use it by its name:"), h("pre", null, `use "${file.path.replace(/\.\w+$/, "")}"`),
        before && h("p", null, h("button", {type: "button", onclick: before.show}, `Back to ${before.path}`)));
      return;
    }
    const about = file.languageId === "bnf" ? "Sentences of this grammar are not shown on this page yet. `tartan map` maps genomes to them." : "This page knows no questions about such a file.";
    fill(this.plain, h("h2", {class: "title"}, file.path), h("p", {class: "lead"}, withCode(about)), h("p", {class: "hint"}, "Everything that the editor says of the text is there all the same: findings, words, definitions."));
  }
}

function append(parent: Element, children: Element[]): void {
  parent.append(...children);
}
