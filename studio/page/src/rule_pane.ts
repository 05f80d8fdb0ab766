// A rule as a picture beside its text. The text is the only state: each edit of the picture is one of the text, after
// which the picture is drawn again.
import type {Desk} from "./desk";
import {fill, h, later, withCode} from "./dom";
import {freeName} from "./edits";
import {Refused, Stale} from "./questions";
import type {RuleShown, ShownRule} from "./requests";
import {actionsOn} from "./rule_actions";
import {Drag} from "./rule_drag";
import {landingAt, type Carried, type Operation} from "./rule_drops";
import {Effect} from "./rule_effect";
import {Making} from "./rule_making";
import {Menu} from "./rule_menu";
import {Palette} from "./rule_palette";
import {inFew, isTray} from "./rule_parts";
import {RulePicture} from "./rule_picture";
import {RuleText} from "./rule_text";
import {nextPart} from "./rule_walk";

const FOLLOW_MS = 250;
const KEYS = ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End", "Enter", "Escape", "Delete", "Backspace"];

const HOW = "Drag parts and boxes onto the picture, and what is in it elsewhere. A click on a sign of a tray gives it the next value. Keys: arrows go from part to part, Enter to what can be done with it.";

interface Point {
  x: number;
  y: number;
}

export class RulePane {
  readonly element: HTMLElement;
  private rule: RuleShown | null = null;
  private rules: ShownRule[] = [];
  private name = "";
  private drawnVersion: unknown = null;
  private queue: Promise<void> = Promise.resolve();
  private carried: {what: Carried; label: string} | null = null; // by the keyboard
  private picture = new RulePicture();
  private palette: Palette;
  private menu: Menu;
  private effect: Effect;
  private drag: Drag;
  private head = h("div", {class: "tools rule-head"});
  private making: Making;
  private text: RuleText;
  private message = h("p", {class: "rule-message", role: "status", hidden: true});
  private refusal = h("p", {class: "refusal", role: "alert", hidden: true});
  private bin = h("div", {class: "bin", "aria-hidden": "true"}, "drop it here to remove it");
  private keys = h("p", {class: "hint rule-keys"}, HOW);
  private canvas: HTMLElement;
  private followSoon = later(() => void this.followCursor(), FOLLOW_MS);

  constructor(private desk: Desk) {
    this.text = new RuleText(desk);
    this.making = new Making({
      free: () => freeName(desk.file()?.text ?? "", "my-rule"),
      make: (name) => this.queued(() => this.make(name)),
      shown: (is) => this.head.querySelector("#new-rule")?.setAttribute("aria-expanded", String(is)),
      cancelled: () => this.head.querySelector<HTMLElement>("#new-rule")?.focus(),
    });
    this.palette = new Palette({press: (event, carried, label) => this.press(event, carried, label), put: (carried, label) => this.putAtChosen(carried, label), say: (sentence) => this.say(sentence)});
    this.menu = new Menu({act: (operation) => this.act(operation), move: (part) => this.carry({from: part}, inFew(this.rule!.parts[part])), back: () => this.backToPicture()});
    this.effect = new Effect(desk);
    this.drag = new Drag({
      over: (carried, x, y) => this.over(carried, x, y),
      drop: (carried, x, y) => this.drop(carried, x, y),
      end: () => {
        this.picture.land(null);
        this.canvas.classList.remove("moving");
      },
    });
    this.canvas = h("div", {class: "rule-canvas"}, this.picture.element, this.refusal, this.bin);
    this.element = h("section", {class: "pane rule-pane", "aria-label": "Rule"}, this.head, this.making.element, this.palette.element,
      h("div", {class: "rule-body"}, h("div", {class: "rule-main"}, this.message, this.canvas, this.keys), this.menu.element, this.effect.element));
    this.listen(this.picture.element);
    desk.editor.view.contentDOM.addEventListener("focus", () => this.visible && desk.editor.unlight()); // who writes there needs no light
  }

  private get visible(): boolean {
    return !this.element.hidden && this.element.offsetParent !== null;
  }

  // ---- which rule, and what the text says of it

  // Another file is shown.
  reset(): void {
    this.name = "";
    this.rules = [];
    this.forget();
    this.effect.clear();
    this.making.hide();
  }

  private forget(): void {
    this.rule = null;
    this.drawnVersion = null;
    this.picture.chosen = 0;
    this.picture.clear();
    this.menu.clear();
    this.leaveCarried();
  }

  async choose(name: string): Promise<void> {
    if (name !== this.name) this.forget();
    this.name = name;
    await this.desk.refreshPane();
  }

  // The text is another: the picture comes before all else.
  async follow(): Promise<void> {
    if (this.drawnVersion !== this.text.version) await this.redraw();
  }

  private async redraw(): Promise<void> {
    this.picture.busy(true);
    try {
      await this.text.insist(() => this.draw());
    } catch (failure) {
      if (failure instanceof Refused) this.keepOld(failure);
      else if (!(failure instanceof Stale)) throw failure;
    }
    this.picture.busy(this.rule !== null && this.drawnVersion !== this.text.version);
  }

  // The same with what follows.
  async refresh(): Promise<void> {
    const file = this.desk.file();
    if (!file) return;
    await this.follow();
    this.rules = await this.text.rules();
    if (!this.rule && !this.picture.drawn && this.rules.length) {
      this.name = this.rules[0].name;
      await this.redraw();
    }
    this.renderHead();
    if (!this.rules.length && !this.rule) this.tell("There is no rule in this file yet. Make the first: it begins with any tray.");
    if (this.rule) await this.effect.show(this.rule.rule, this.rules.find((one) => one.name === this.rule!.rule)?.schema);
    else this.effect.clear();
  }

  leave(): void {
    this.desk.editor.unlight();
    this.leaveCarried();
  }

  // The cursor of the editor stands elsewhere.
  cursorMoved(): void {
    if (this.visible) this.followSoon();
  }

  private async followCursor(): Promise<void> {
    if (!this.visible) return;
    try {
      const {rule} = await this.text.atCursor("cursor");
      if (rule !== this.name) await this.choose(rule);
    } catch (failure) {
      if (!(failure instanceof Stale || failure instanceof Refused)) throw failure;
    }
  }

  private async draw(): Promise<void> {
    const {version} = this.text;
    const {rule, svg} = await this.text.shown(this.name);
    this.name = rule.rule;
    this.rule = rule;
    this.drawnVersion = version;
    this.message.hidden = true;
    this.picture.old(false);
    this.picture.show(rule, svg);
    this.palette.element.hidden = this.text.readOnly;
    this.palette.show(rule);
    this.showChosen();
    this.renderHead();
  }

  // There is no picture of what the text says now: the last one stays, in grey. What is wrong with the text is told in the
  // bar above.
  private keepOld(failure: Refused): void {
    const told = failure.line > 0;
    const {drawn} = this.picture;
    this.picture.old(true);
    this.menu.clear();
    this.hideRefusal();
    this.tell(told && drawn ? "This is the picture of the text as it was before." : told ? "There is a picture as soon as the text can be read." : failure.message);
    this.rule = null;
    this.drawnVersion = null;
  }

  private tell(sentence: string): void {
    fill(this.message, withCode(sentence));
    this.message.hidden = false;
  }

  private renderHead(): void {
    const focused = document.activeElement?.id;
    const names = this.rules.map((rule) => rule.name);
    if (this.name && this.rule && !names.includes(this.name)) names.push(this.name);
    const doc = this.rule?.doc;
    fill(this.head,
      names.length > 0 && h("select", {id: "rule-name", "aria-label": "Rule", onchange: (event: Event) => void this.choose((event.target as HTMLSelectElement).value)}, names.map((name) => h("option", {value: name, selected: name === this.name}, name))),
      !this.text.readOnly && h("button", {type: "button", id: "new-rule", "aria-expanded": String(this.making.open), onclick: () => this.making.show(true)}, "New rule"),
      !this.text.readOnly && this.rule && h("button", {type: "button", id: "rule-undo", class: "quiet", onclick: () => this.step(() => this.text.undo())}, "Undo"),
      !this.text.readOnly && this.rule && h("button", {type: "button", id: "rule-redo", class: "quiet", onclick: () => this.step(() => this.text.redo())}, "Redo"),
      doc && h("p", {class: "doc"}, doc));
    if (!names.length && !this.text.readOnly) this.making.show(false);
    if (focused && this.head.querySelector(`#${CSS.escape(focused)}`)) document.getElementById(focused)!.focus();
  }

  // ---- a new rule

  private async make(name: string): Promise<void> {
    const answer = await this.text.create(name);
    if (answer.why_not) return this.making.refuse(answer.why_not);
    this.forget();
    this.text.apply(answer);
    this.name = name;
    this.making.hide();
    await this.redraw();
    this.picture.element.focus({preventScroll: true});
  }

  // ---- edits

  act(operation: Operation, near?: Point): void {
    this.queued(() => this.perform(operation, near));
  }

  // One after another, each on the text that the one before has made.
  private queued(work: () => Promise<void>): void {
    this.queue = this.queue.then(work).catch((failure) => {
      if (failure instanceof Refused) this.refuse(failure.message);
      else if (!(failure instanceof Stale)) queueMicrotask(() => { // what comes next is done all the same
        throw failure;
      });
    });
  }

  private async perform(operation: Operation, near?: Point): Promise<void> {
    if (this.rule && this.drawnVersion !== this.text.version) return this.redraw(); // what was pressed is no more
    if (!this.rule || this.text.readOnly) return;
    this.hideRefusal();
    const answer = await this.text.edit(this.rule.rule, operation);
    if (answer.why_not) return this.refuse(answer.why_not, near);
    this.picture.busy(answer.edits.length > 0);
    this.text.apply(answer);
    if (answer.part !== undefined) this.picture.chosen = answer.part;
    await this.redraw();
  }

  private step(command: () => boolean): void {
    this.hideRefusal();
    this.queued(async () => {
      if (command()) await this.redraw();
    });
  }

  private refuse(why: string, near?: Point): void {
    fill(this.refusal, withCode(`${why[0].toUpperCase()}${why.slice(1)}${/[.!?]$/.test(why) ? "" : "."}`));
    this.refusal.hidden = false;
    const canvas = this.canvas.getBoundingClientRect();
    const frame = this.canvas.querySelector(".chosen-frame")?.getBoundingClientRect();
    const at = near ?? {x: frame?.left ?? canvas.left, y: frame?.bottom ?? canvas.bottom};
    const left = Math.max(0, Math.min(at.x - canvas.left, canvas.width - this.refusal.offsetWidth));
    const top = Math.max(0, Math.min(at.y - canvas.top + 10, canvas.height - 10));
    this.refusal.style.left = `${left}px`;
    this.refusal.style.top = `${top}px`;
  }

  private hideRefusal(): void {
    this.refusal.hidden = true;
  }

  // ---- the chosen part

  private showChosen(): void {
    if (!this.rule) return;
    if (this.carried) this.askWhere();
    else if (this.text.readOnly) this.menu.clear();
    else this.menu.show(this.rule, this.picture.chosen);
    const {utf16_begin: from, utf16_end: to} = this.rule.parts[this.picture.chosen].around;
    const {editor} = this.desk;
    if (this.visible && !editor.view.hasFocus && from !== null && to !== null) editor.light(from, to);
  }

  private choosePart(part: number): void {
    this.hideRefusal();
    this.picture.choose(part);
    if (this.carried) this.say();
    else this.showChosen();
  }

  private backToPicture(): void {
    if (this.carried) this.leaveCarried();
    this.picture.element.focus({preventScroll: true});
  }

  // ---- what is carried by the keyboard

  private putAtChosen(carried: Carried, label: string): void {
    if (this.drag.justEnded || !this.rule) return;
    if ("box" in carried) return this.act({operation: "wrap", part: this.picture.chosen, by: carried.box});
    this.carried = {what: carried, label};
    this.askWhere();
  }

  private carry(what: Carried, label: string): void {
    this.carried = {what, label};
    this.menu.clear();
    this.picture.element.focus({preventScroll: true});
    this.say();
  }

  private askWhere(): void {
    const {what, label} = this.carried!;
    this.menu.put(this.rule!, this.picture.chosen, what, label, (landing) => {
      this.carried = null;
      this.say();
      this.act(landing.operation);
      this.picture.element.focus({preventScroll: true});
    }, () => this.backToPicture());
    this.say();
  }

  private leaveCarried(): void {
    if (!this.carried) return;
    this.carried = null;
    this.say();
    if (this.rule) this.showChosen();
  }

  private say(sentence = ""): void {
    this.keys.textContent = sentence || (this.carried
      ? `“${this.carried.label}” is carried: choose a part with the arrows, Enter says where it can go, Escape leaves it.`
      : HOW);
  }

  // ---- keyboard and pointer

  private listen(picture: HTMLElement): void {
    picture.addEventListener("keydown", (event) => this.key(event));
    picture.addEventListener("pointerdown", (event) => this.pressed(event));
    picture.addEventListener("click", (event) => this.clicked(event));
    picture.addEventListener("contextmenu", (event) => this.opened(event));
    this.element.addEventListener("keydown", (event) => this.undoKey(event));
  }

  private undoKey(event: KeyboardEvent): void {
    if (!(event.ctrlKey || event.metaKey) || event.altKey || (event.target as Element).matches("input")) return;
    const key = event.key.toLowerCase();
    if (key !== "z" && key !== "y") return;
    event.preventDefault();
    if (!this.text.readOnly) this.step(() => (key === "y" || event.shiftKey ? this.text.redo() : this.text.undo()));
  }

  // Keys wait for the edits that the ones before have begun: they are about the picture that these make.
  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || (event.key.length > 1 && !KEYS.includes(event.key))) return;
    event.preventDefault();
    this.queued(() => this.pressedKey(event.key));
  }

  private async pressedKey(key: string): Promise<void> {
    await this.follow();
    if (!this.rule) return;
    const next = nextPart(this.rule, this.picture.chosen, key);
    if (next !== null) this.choosePart(next);
    else if (key === "Enter" || key === " ") this.enter();
    else if (key === "Escape") this.leaveAll();
    else if (!this.carried && !this.text.readOnly) await this.letter(key === "Backspace" ? "Delete" : key);
  }

  private leaveAll(): void {
    this.hideRefusal();
    this.leaveCarried();
  }

  private enter(): void {
    if (this.carried) this.askWhere();
    else this.menu.focus();
  }

  private async letter(key: string): Promise<void> {
    const {chosen} = this.picture;
    if (key === "x" && chosen > 0) this.carry({from: chosen}, inFew(this.rule!.parts[chosen]));
    else if (key === "t") this.menu.write();
    else {
      const action = actionsOn(this.rule!, chosen).find((one) => one.key === key);
      if (action) await this.perform(action.operation);
    }
  }

  private pressed(event: PointerEvent): void {
    const part = this.picture.partOf(event);
    const grip = event.target === this.picture.grip;
    if (!this.rule || this.text.readOnly || part === null || (event.pointerType === "touch" && !grip)) return;
    this.picture.element.focus({preventScroll: true});
    if (part > 0 && !this.rule.parts[part].made) this.press(event, {from: part}, inFew(this.rule.parts[part]));
  }

  private clicked(event: MouseEvent): void {
    if (this.drag.justEnded || !this.rule || event.target === this.picture.grip) return;
    const part = this.picture.partOf(event);
    if (part === null) return;
    this.choosePart(part);
    const sign = this.text.readOnly || this.carried ? null : this.picture.signOf(event);
    if (sign) this.act({operation: "step", part: sign.part, field: sign.field, ...(sign.depth ? {depth: true} : {})}, {x: event.clientX, y: event.clientY});
  }

  private opened(event: MouseEvent): void {
    const part = this.picture.partOf(event);
    if (!this.rule || part === null || !isTray(this.rule.parts[part])) return;
    event.preventDefault();
    this.choosePart(part);
    this.menu.focus();
  }

  private press(event: PointerEvent, carried: Carried, label: string): void {
    if (!this.text.readOnly) this.drag.press(event, carried, label);
  }

  private overBin(x: number, y: number): boolean {
    const {left, right, top, bottom} = this.bin.getBoundingClientRect();
    return x >= left && x <= right && y >= top && y <= bottom;
  }

  private over(carried: Carried, x: number, y: number): void {
    this.hideRefusal();
    this.canvas.classList.toggle("moving", "from" in carried);
    const bin = "from" in carried && this.overBin(x, y);
    this.bin.classList.toggle("on", bin);
    const place = bin ? null : this.picture.placeOf(x, y);
    this.picture.land(place && this.rule ? landingAt(this.rule, this.picture.boxes, carried, place.x, place.y) : null);
  }

  private drop(carried: Carried, x: number, y: number): void {
    if ("from" in carried && this.overBin(x, y)) return this.act({operation: "remove", part: carried.from}, {x, y});
    const place = this.picture.placeOf(x, y);
    const landing = place && this.rule && landingAt(this.rule, this.picture.boxes, carried, place.x, place.y);
    if (landing) this.act(landing.operation, {x, y});
  }
}
