// A rule as the text has it: its parts and its picture are asked, and edits go into the editor, each as one step of undo.
import {isolateHistory, redo, undo} from "@codemirror/commands";
import type {Desk} from "./desk";
import {Refused, Stale} from "./questions";
import type {ChangedRule, RuleShown, ShownRule} from "./requests";
import type {Operation} from "./rule_drops";

const TRIES = 4;

export class RuleText {
  constructor(private desk: Desk) {}

  // What is there now; another object after each change.
  get version(): unknown {
    return this.desk.file()?.current;
  }

  get readOnly(): boolean {
    return this.desk.file()?.readOnly ?? true;
  }

  get cursor(): number {
    return this.desk.editor.view.state.selection.main.head;
  }

  // What is asked anew after a change of the text ends all questions before; that is no reason to leave one that is about
  // the same text.
  async insist<T>(work: () => Promise<T>): Promise<T> {
    for (let i = 1; ; i++) {
      const {version} = this;
      try {
        return await work();
      } catch (failure) {
        if (!(failure instanceof Stale) || i === TRIES || this.version !== version) throw failure;
      }
    }
  }

  async rules(): Promise<ShownRule[]> {
    return (await this.desk.questions.ask("schema", {}, "rules")).rules.filter((rule) => rule.schema);
  }

  atCursor(subject: string): Promise<RuleShown> {
    return this.desk.questions.ask("rule_tree", {at: this.cursor}, subject);
  }

  // Of a rule that has another name by now, and without a name, that in which the cursor stands.
  async tree(name: string): Promise<RuleShown> {
    if (!name) return this.atCursor("rule");
    try {
      return await this.desk.questions.ask("rule_tree", {rule: name}, "rule");
    } catch (failure) {
      if (!(failure instanceof Refused)) throw failure;
      return this.atCursor("rule").catch((other) => {
        throw other instanceof Refused ? failure : other;
      });
    }
  }

  private async svg(rule: string): Promise<string> {
    return (await this.desk.questions.ask("rule_draw", {rule, format: "svg"}, "rule")).files[0]?.text ?? "";
  }

  // Its parts and its picture, asked at once where the name is known.
  async shown(name: string): Promise<{rule: RuleShown; svg: string}> {
    const drawn = name ? this.svg(name) : null;
    drawn?.catch(() => {});
    const rule = await this.tree(name);
    return {rule, svg: await (drawn && rule.rule === name ? drawn : this.svg(rule.rule))};
  }

  edit(rule: string, operation: Operation): Promise<ChangedRule> {
    return this.insist(() => this.desk.questions.ask("rule_edit", {rule, ...operation}, "rule"));
  }

  create(rule: string): Promise<ChangedRule> {
    return this.edit(rule, {operation: "new", at: this.cursor});
  }

  apply({edits}: ChangedRule): void {
    const {view} = this.desk.editor;
    const {doc} = view.state;
    const place = ({line, character}: {line: number; character: number}) => doc.line(line + 1).from + character;
    const changes = edits.map(({range, newText}) => ({from: place(range.start), to: place(range.end), insert: newText}));
    if (changes.length) view.dispatch({changes, annotations: isolateHistory.of("full"), userEvent: "input.picture"});
  }

  // Did that change anything?
  undo(): boolean {
    return undo(this.desk.editor.view);
  }

  redo(): boolean {
    return redo(this.desk.editor.view);
  }
}
