// The form that the file makes, in space: drawn again after each change, turned, and saved as the commands write it. While
// the text is wrong the last one stays, grey.
import type {Desk} from "./desk";
import {fill, h, withCode} from "./dom";
import {FORM_KINDS, namesIn, type Chosen, type FormKind} from "./form_kinds";
import type {FormView, View} from "./form_view";
import {keep} from "./keep";
import {readMesh, type Mesh} from "./mesh";
import {grouped} from "./numbers";
import {Refused, Stale, type Note} from "./questions";
import type {Grown, MadeFile, MeasuredMesh, Placed} from "./requests";
import {Sliders} from "./sliders";
import {picture} from "./svg";

const VIEWS: [View, string][] = [["whole", "Whole"], ["above", "Above"], ["front", "Front"], ["side", "Side"]];
const ZOOM = 1.25;

// What can be chosen beside the drawing, if the text does not say it, too.
const NUMBERS = {
  grid: {label: "Grid", values: [25, 50, 75, 100, 150, 200]},
  steps: {label: "Steps", values: [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10]},
  seed: {label: "Seed", values: [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]},
} as const;

interface Answer {
  surface?: string;
  files?: MadeFile[];
}

const number = (value: number) => grouped(String(value));
const rounded = (value: number) => value.toLocaleString("en-US", {maximumSignificantDigits: 4});
const several = (count: number, one: string, more: string) => `${number(count)} ${count === 1 ? one : more}`;

function canTurn(): boolean {
  return document.createElement("canvas").getContext("webgl2") !== null;
}

export class FormRoom {
  readonly element = h("section", {class: "form-room", "aria-label": "Form", hidden: true});
  private head = h("header", {class: "form-head"});
  private size = h("p", {class: "form-size"});
  private stage = h("div", {class: "form-stage"});
  private flat = h("figure", {class: "form", hidden: true});
  private tools = h("div", {class: "tools form-tools"});
  private nothing = h("div", {class: "form-nothing", hidden: true});
  private facts = h("section", {class: "form-facts", "aria-label": "What it measures"});
  private sliders: Sliders;
  private chosen: Chosen = {};
  private kind: FormKind | null = null;
  private view: Promise<FormView | null> | null = null;
  private any = false; // a form of this file is shown
  private shape = ""; // what can be chosen
  private format = "";

  constructor(private desk: Desk) {
    this.sliders = new Sliders(desk);
    this.element.append(this.head, this.nothing, this.stage, this.flat, this.tools, this.facts, this.sliders.element);
  }

  takes(notation: string): boolean {
    return notation in FORM_KINDS;
  }

  // Another file is shown.
  another(): void {
    this.chosen = {};
    this.any = false;
    this.shape = "";
    this.format = "";
    this.sliders.clear();
    this.nothing.hidden = true;
    this.conceal(true);
    fill(this.head);
    fill(this.facts);
  }

  private conceal(hidden: boolean): void {
    this.stage.hidden = this.tools.hidden = this.facts.hidden = this.size.hidden = hidden;
    if (hidden) this.flat.hidden = true;
  }

  // Asks for the form as the text says it now, and draws it.
  async refresh(): Promise<void> {
    const file = this.desk.file()!;
    this.kind = FORM_KINDS[file.languageId];
    this.renderHead(namesIn(this.kind, file.text));
    const view = this.kind.shown ? await this.turning() : null;
    const question = (this.kind.shown && view ? this.kind.shown : this.kind.drawn)(this.chosen);
    const {answer, notes, bytes} = await this.desk.questions.askWithBytes(question.question, question.request, "form");
    const mesh = view && bytes[0] ? readMesh(bytes[0]) : null;
    this.nothing.hidden = true;
    this.conceal(false);
    this.stage.hidden = !mesh;
    if (mesh) view!.show(mesh, !this.any, (answer as Partial<Grown>).steps === undefined ? null : (answer as Grown).faces);
    else this.showPicture(answer as Answer, file.path);
    this.any = true;
    this.renderTools(mesh !== null);
    this.say(mesh, answer as Answer, notes);
  }

  async settings(): Promise<void> {
    await this.sliders.refresh();
  }

  // Says why there is no form; false if the last one stays, which is said elsewhere.
  refused(failure: Refused): boolean {
    if (this.any || failure.line > 0) return false;
    this.conceal(true);
    fill(this.nothing, h("p", {class: "lead"}, withCode(sentence(failure.message))), failure.help && h("p", {class: "hint"}, withCode(sentence(failure.help))));
    this.nothing.hidden = false;
    return true;
  }

  // ---- the drawing

  private turning(): Promise<FormView | null> {
    this.view ??= this.begin();
    return this.view;
  }

  private async begin(): Promise<FormView | null> {
    if (!canTurn()) return null;
    const {FormView} = await import("./form_view");
    let frames = 0;
    return new FormView(this.stage, "The form in space", () => (this.stage.dataset.frames = String(++frames)), () => {
      this.view = Promise.resolve(null); // it is drawn flat from now on
      this.desk.again();
    });
  }

  private showPicture({files}: Answer, name: string): void {
    const svg = files?.[0]?.text ? picture(files[0].text, name) : null;
    this.flat.hidden = !svg;
    fill(this.flat, svg, svg && h("figcaption", {class: "hint"}, "This browser cannot draw forms that turn, since it has no WebGL; here is a picture."));
  }

  // ---- what is around it

  private renderHead(names: string[]): void {
    if (names.length && !names.includes(this.chosen.name ?? "")) this.chosen.name = this.desk.file()!.languageId === "field" ? names.at(-1) : names[0];
    if (!names.length) this.chosen.name = undefined;
    const shape = JSON.stringify([this.desk.file()!.path, names]);
    if (shape === this.shape) return;
    this.shape = shape;
    const title = names.length > 1
      ? h("select", {id: "form-name", "aria-label": "Form", onchange: (event: Event) => this.choose({name: (event.target as HTMLSelectElement).value}, true)}, names.map((name) => h("option", {value: name, selected: name === this.chosen.name}, name)))
      : names[0] ?? this.desk.file()!.path.split("/").pop();
    fill(this.head, h("h2", {class: "title"}, title), this.size);
    fill(this.tools);
  }

  private choose(chosen: Chosen, anew = false): void {
    Object.assign(this.chosen, chosen);
    if (anew) this.any = false;
    this.desk.again();
  }

  private renderTools(turns: boolean): void {
    if (this.tools.childElementCount) return;
    const kind = this.kind!;
    const look = async (work: (view: FormView) => void) => work((await this.view)!);
    const button = (label: string, title: string, work: (view: FormView) => void) => h("button", {type: "button", class: "quiet", title, "aria-label": title === label ? null : title, onclick: () => void look(work)}, label);
    this.format ||= kind.formats[0];
    fill(this.tools,
      turns && h("div", {class: "form-views", role: "group", "aria-label": "Seen from"},
        VIEWS.map(([view, label]) => button(label, label, (shown) => shown.look(view))),
        button("−", "Smaller", (shown) => shown.zoom(ZOOM)), button("+", "Larger", (shown) => shown.zoom(1 / ZOOM))),
      kind.number && this.numberChoice(kind.number),
      h("div", {class: "form-save end"},
        h("select", {"aria-label": "Saved as", onchange: (event: Event) => (this.format = (event.target as HTMLSelectElement).value)}, kind.formats.map((format) => h("option", {value: format, selected: format === this.format}, format.toUpperCase()))),
        h("button", {type: "button", onclick: () => void this.save()}, "Save a copy")),
      turns && h("p", {class: "hint", id: "form-keys"}, "Drag to turn, right button to move, wheel to zoom; or arrows, Shift and arrows, + and −, and 0."));
  }

  private numberChoice(name: "grid" | "steps" | "seed"): HTMLElement {
    const {label, values} = NUMBERS[name];
    const usual = {grid: "as the text says", steps: "4", seed: "0"}[name];
    return h("label", {class: "form-number"}, `${label} `, h("select", {onchange: (event: Event) => {
      const {value} = event.target as HTMLSelectElement;
      this.choose({[name]: value === "" ? undefined : Number(value)});
    }}, h("option", {value: ""}, usual), values.filter((value) => String(value) !== usual).map((value) => h("option", {value, selected: this.chosen[name] === value}, number(value)))));
  }

  private say(mesh: Mesh | null, answer: Answer, notes: Note[]): void {
    fill(this.size, mesh && `${several(mesh.vertices, "vertex", "vertices")}, ${several((answer as Partial<Grown>).faces ?? mesh.faces, "face", "faces")}`,
      mesh && mesh.groups.length > 1 && `, ${number(mesh.groups.length)} colours`);
    const {parts} = answer as Placed;
    fill(this.facts,
      Array.isArray(parts) ? partsTable(answer as Placed) : "area" in answer ? measures(answer as unknown as MeasuredMesh) : null,
      notes.length > 0 && h("ul", {class: "findings"}, notes.map((note) => h("li", {class: note.severity}, h("p", null, withCode(sentence(note.message))), note.help && h("p", {class: "hint"}, withCode(sentence(note.help)))))));
  }

  // The bytes that the command writes.
  private async save(): Promise<void> {
    const path = this.desk.file()!.path.split("/").pop()!;
    const {question, request} = this.kind!.saved(this.chosen, this.format);
    try {
      const {answer, bytes} = await this.desk.questions.askWithBytes(question, request, "copy");
      const text = (answer as Answer).files?.[0]?.text;
      keep(text ?? bytes[0], `${path.replace(/\.\w+$/, "")}.${this.format}`);
    } catch (failure) {
      if (failure instanceof Stale) return;
      if (!(failure instanceof Refused)) throw failure;
      this.desk.say(sentence(failure.message));
    }
  }
}

function sentence(text: string): string {
  return text ? text[0].toUpperCase() + text.slice(1) + (/[.?!`]$/.test(text) ? "" : ".") : "";
}

function measures({bounds, area, volume, parts, unit}: MeasuredMesh & {unit?: string}): HTMLElement {
  const [low, high] = bounds as unknown as [number[], number[]];
  const of = (power: string) => (unit ? ` ${unit}${power}` : "");
  const rows: [string, string][] = [
    ["Size", `${[0, 1, 2].map((i) => rounded(high[i] - low[i])).join(" × ")}${of("")}`],
    ["Area", rounded(area) + of("²")],
  ];
  if (volume !== undefined) rows.push(["Volume", rounded(volume) + of("³")]);
  if (parts > 1) rows.push(["Parts", number(parts)]);
  return h("dl", null, rows.map(([name, value]) => h("div", null, h("dt", null, name), h("dd", null, value))));
}

function partsTable({parts, figures}: Placed): HTMLElement {
  return h("table", {class: "form-parts"},
    h("thead", null, h("tr", null, h("th", {scope: "col"}, several(figures.elements, "part", "parts")), h("th", {scope: "col", class: "num"}, "how many"))),
    h("tbody", null, parts.map((kind) => h("tr", null, h("th", {scope: "row"}, kind.name || kind.part, kind.name && h("span", {class: "faint"}, ` ${kind.part}`)), h("td", {class: "num"}, number(kind.number))))));
}
