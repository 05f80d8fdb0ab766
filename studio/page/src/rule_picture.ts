// The picture of a rule: what is pointed at, which part is chosen, and where something that is dragged would land. It is
// drawn by the engine; marks are laid over it.
import {fill, h} from "./dom";
import type {RuleShown} from "./requests";
import type {Box, Landing, Side} from "./rule_drops";
import {depthOf, inFew, isTray} from "./rule_parts";
import {picture} from "./svg";

const MARGIN = 12; // points around the whole
const LEAST_SCALE = 1.45; // pixels a point

// Small rules are drawn larger; a tall one is to be seen as a whole.
function scaleOf({width, height}: Box): number {
  return Math.min(Math.min(3, Math.max(2, 440 / width)), Math.max(1.6, 460 / height));
}

export interface Sign {
  part: number;
  field: string;
  depth: boolean;
}

function boxOf(group: Element): Box | null {
  const rect = group.querySelector(":scope > rect");
  const number = (name: string) => Number(rect!.getAttribute(name));
  return rect && {x: number("x"), y: number("y"), width: number("width"), height: number("height")};
}

export class RulePicture {
  readonly element: HTMLElement;
  boxes = new Map<number, Box>();
  chosen = 0;
  private svg: SVGSVGElement | null = null;
  private rule: RuleShown | null = null;
  private items = h("div", {class: "sr"});
  private stage = h("div", {class: "rule-stage"});
  private frame = h("div", {class: "chosen-frame", hidden: true});
  private mark = h("div", {class: "landing", hidden: true});
  private hint = h("div", {class: "sign-hint", hidden: true, "aria-hidden": "true"});
  readonly grip = h("button", {type: "button", class: "grip", tabindex: "-1", "aria-hidden": "true", title: "drag this part", hidden: true}, "⠿");
  private view: Box = {x: 0, y: 0, width: 1, height: 1};

  constructor() {
    this.element = h("div", {class: "rule-drawing", role: "tree", tabindex: "0", "aria-label": "The rule as a picture"}, this.items, this.stage);
    this.element.addEventListener("pointermove", (event) => this.point(event));
    this.element.addEventListener("pointerleave", () => (this.hint.hidden = true));
  }

  clear(): void {
    this.svg = null;
    this.rule = null;
    this.boxes.clear();
    fill(this.stage);
    fill(this.items);
    this.element.removeAttribute("aria-activedescendant");
  }

  get drawn(): boolean {
    return this.svg !== null;
  }

  // It is being drawn anew.
  busy(is: boolean): void {
    this.element.setAttribute("aria-busy", String(is));
  }

  // What is drawn is of a text that is no more.
  old(is: boolean): void {
    this.element.classList.toggle("old", is);
    this.frame.classList.toggle("gone", is);
    if (is) this.hint.hidden = true;
  }

  show(rule: RuleShown, text: string): void {
    const svg = picture(text, "");
    if (!svg) return this.clear();
    svg.removeAttribute("role");
    svg.removeAttribute("aria-label");
    svg.setAttribute("aria-hidden", "true");
    this.rule = rule;
    this.element.setAttribute("aria-label", `The rule ${rule.rule} as a picture`);
    this.svg = svg;
    this.boxes.clear();
    for (const group of svg.querySelectorAll("g[data-part]")) {
      const part = Number(group.getAttribute("data-part"));
      const box = boxOf(group);
      if (box && !this.boxes.has(part)) this.boxes.set(part, box); // a mirrored half comes behind what is edited
    }
    this.crop(svg);
    fill(this.stage, svg, this.frame, this.grip, this.mark, this.hint);
    fill(this.items, rule.parts.map((part) => h("div", {role: "treeitem", id: `rule-part-${part.number}`, "aria-level": depthOf(rule, part.number) + 1, "aria-selected": "false"}, inFew(part))));
    this.choose(Math.min(this.chosen, rule.parts.length - 1));
  }

  // The name stands above the picture already, on the page.
  private crop(svg: SVGSVGElement): void {
    const whole = this.boxes.get(0);
    if (!whole) return;
    this.view = {x: whole.x - MARGIN, y: whole.y - MARGIN, width: whole.width + 2 * MARGIN, height: whole.height + 2 * MARGIN};
    svg.setAttribute("viewBox", `${this.view.x} ${this.view.y} ${this.view.width} ${this.view.height}`);
    svg.querySelector(":scope > rect")?.remove();
    for (const title of svg.querySelectorAll(":scope > g > text")) title.remove();
    this.stage.style.width = `${this.view.width * scaleOf(this.view)}px`;
    this.stage.style.minWidth = `${this.view.width * LEAST_SCALE}px`;
  }

  choose(part: number): void {
    if (!this.rule?.parts[part]) part = 0;
    this.chosen = part;
    for (const item of this.items.children) item.setAttribute("aria-selected", String(item.id === `rule-part-${part}`));
    this.element.setAttribute("aria-activedescendant", `rule-part-${part}`);
    const box = this.boxes.get(part);
    this.frame.hidden = this.grip.hidden = !box;
    if (!box) return;
    this.lay(this.frame, box);
    this.grip.style.left = this.frame.style.left;
    this.grip.style.top = this.frame.style.top;
    this.reveal();
  }

  // Scrolls, where the picture is wider than its place, so that the chosen part is in it.
  private reveal(): void {
    const place = this.element.getBoundingClientRect();
    const box = this.frame.getBoundingClientRect();
    if (box.width > place.width) return;
    if (box.left < place.left) this.element.scrollLeft -= place.left - box.left + 12;
    else if (box.right > place.right) this.element.scrollLeft += box.right - place.right + 12;
  }

  private lay(mark: HTMLElement, {x, y, width, height}: Box): void {
    const percent = (value: number, of: number) => `${(100 * value) / of}%`;
    mark.style.left = percent(x - this.view.x, this.view.width);
    mark.style.top = percent(y - this.view.y, this.view.height);
    mark.style.width = percent(width, this.view.width);
    mark.style.height = percent(height, this.view.height);
  }

  // A place of the window as one of the picture; null if it is beside the picture.
  placeOf(x: number, y: number): {x: number; y: number} | null {
    const shown = this.svg?.getBoundingClientRect();
    const around = this.element.getBoundingClientRect();
    if (!shown?.width || x < around.left || x > around.right || y < around.top || y > around.bottom) return null;
    return {x: this.view.x + ((x - shown.left) / shown.width) * this.view.width, y: this.view.y + ((y - shown.top) / shown.height) * this.view.height};
  }

  // The part that an event of the pointer is about; null beside the picture.
  partOf(event: Event): number | null {
    if (event.target === this.grip) return this.chosen;
    const group = (event.target as Element).closest?.("g[data-part]");
    return group && this.svg?.contains(group) ? Number(group.getAttribute("data-part")) : null;
  }

  // The sign of a tray that an event is about. Those of a mirrored half follow what is edited.
  signOf(event: Event): Sign | null {
    const group = (event.target as Element).closest?.("g[data-item], g[data-depth]");
    const tray = group?.closest("g[data-part]");
    if (!group || !tray || !this.rule || this.svg?.querySelector(`[data-part="${tray.getAttribute("data-part")}"]`) !== tray) return null;
    const part = Number(tray.getAttribute("data-part"));
    const depth = group.hasAttribute("data-depth");
    const field = this.rule.fields[Number(group.getAttribute(depth ? "data-depth" : "data-item"))];
    return field && isTray(this.rule.parts[part]) ? {part, field: field.name, depth} : null;
  }

  // Says what a sign is about before it is clicked.
  private point(event: PointerEvent): void {
    const sign = event.buttons || this.element.classList.contains("old") ? null : this.signOf(event);
    const group = sign && (event.target as Element).closest("g[data-item], g[data-depth]");
    const box = group && boxOf(group);
    this.hint.hidden = !box;
    if (!box || !sign) return;
    const items = this.rule!.parts[sign.part].items.filter((item) => item.field === sign.field).map((item) => item.text);
    this.hint.textContent = `${sign.field}${sign.depth ? ", its depth" : ""}: ${items.join(", ") || "any"}`;
    this.lay(this.hint, box);
  }

  // Where it would land: a line at a side, or a frame.
  land(landing: Landing | null): void {
    const box = landing && this.boxes.get(landing.part);
    this.mark.hidden = !box;
    if (!box || !landing) return;
    this.mark.className = `landing ${landing.side}`;
    this.lay(this.mark, lineAt(box, landing.side));
    fill(this.mark, h("span", {class: "landing-label"}, landing.label));
  }
}

const APART = 4; // points between a part and the line beside it

function lineAt(box: Box, side: Side): Box {
  switch (side) {
    case "left":
      return {...box, x: box.x - APART, width: 0};
    case "right":
      return {...box, x: box.x + box.width + APART, width: 0};
    case "above":
      return {...box, y: box.y - APART, height: 0};
    case "below":
      return {...box, y: box.y + box.height + APART, height: 0};
    default:
      return box;
  }
}
