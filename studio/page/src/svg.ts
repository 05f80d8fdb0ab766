// Pictures of the engines. Their text is parsed apart from the page and copied node by node: elements and attributes
// that are not listed here stay outside, references point into the same picture alone, and styles become attributes,
// as the page's policy has no inline styles.

const NAMESPACE = "http://www.w3.org/2000/svg";

const ELEMENTS = new Set(
  ("svg g defs symbol use title desc path rect circle ellipse line polyline polygon text tspan clipPath mask pattern " +
    "linearGradient radialGradient stop").split(" "),
);

const ATTRIBUTES = new Set(
  ("id viewBox preserveAspectRatio width height x y x1 y1 x2 y2 cx cy r rx ry fx fy d points dx dy rotate transform offset " +
    "clipPathUnits maskUnits maskContentUnits patternUnits patternContentUnits patternTransform gradientUnits " +
    "gradientTransform spreadMethod overflow textLength lengthAdjust " +
    "fill fill-opacity fill-rule stroke stroke-width stroke-opacity stroke-linecap stroke-linejoin stroke-miterlimit " +
    "stroke-dasharray stroke-dashoffset clip-path clip-rule mask opacity stop-color stop-opacity color display visibility " +
    "font-family font-size font-weight font-style font-stretch text-anchor dominant-baseline letter-spacing xml:space " +
    "shape-rendering text-rendering vector-effect " +
    "data-plan data-tray data-part data-item data-depth data-bar data-point data-house role aria-label").split(" "),
);

let pictures = 0;

function copyAttribute(to: Element, name: string, value: string, prefix: string): void {
  if (name === "data-style") {
    for (const declaration of value.split(";")) {
      const colon = declaration.indexOf(":");
      if (colon > 0) copyAttribute(to, declaration.slice(0, colon).trim(), declaration.slice(colon + 1).trim(), prefix);
    }
    return;
  }
  if (name === "href" || name === "xlink:href") {
    if (/^#[\w.:-]+$/.test(value)) to.setAttribute("href", `#${prefix}${value.slice(1)}`);
    return;
  }
  if (!ATTRIBUTES.has(name)) return;
  if (name === "id") value = prefix + value;
  else if (/url/i.test(value)) {
    const inside = /^url\(\s*["']?#([\w.:-]+)["']?\s*\)$/.exec(value);
    if (!inside) return;
    value = `url(#${prefix}${inside[1]})`;
  }
  to.setAttribute(name, value);
}

function copyNode(from: Node, prefix: string): Node | null {
  if (from.nodeType === Node.TEXT_NODE || from.nodeType === Node.CDATA_SECTION_NODE) return document.createTextNode(from.nodeValue ?? "");
  if (from.nodeType !== Node.ELEMENT_NODE) return null;
  const element = from as Element;
  if (element.namespaceURI !== NAMESPACE || !ELEMENTS.has(element.localName)) return null;
  const copy = document.createElementNS(NAMESPACE, element.localName);
  for (const {name, value} of element.attributes) copyAttribute(copy, name, value, prefix);
  for (const child of element.childNodes) {
    const copied = copyNode(child, prefix);
    if (copied) copy.appendChild(copied);
  }
  return copy;
}

// The picture as an element of the page; null if the text is none. `name` is what it is called for those who do not see
// it.
export function picture(text: string, name: string): SVGSVGElement | null {
  // Styles have another name while the text is parsed: the policy holds for the parsed document, too, and tells of each.
  const parsed = new DOMParser().parseFromString(text.replace(/ style=(["'])/g, " data-style=$1"), "image/svg+xml");
  if (parsed.querySelector("parsererror") || parsed.documentElement.localName !== "svg") return null;
  const copy = copyNode(parsed.documentElement, `p${++pictures}-`) as SVGSVGElement | null;
  if (!copy) return null;
  if (!copy.hasAttribute("viewBox") && copy.hasAttribute("width"))
    copy.setAttribute("viewBox", `0 0 ${parseFloat(copy.getAttribute("width")!)} ${parseFloat(copy.getAttribute("height")!)}`);
  copy.removeAttribute("width");
  copy.removeAttribute("height");
  copy.setAttribute("role", "img");
  copy.setAttribute("aria-label", name);
  return copy;
}

export interface Card {
  svg: SVGSVGElement;
  width: number;
  height: number;
}

// The plans of a sheet, each as a picture of its own, in their order; an empty list if the sheet does not say which of
// its parts are plans. What they share, such as hatches, goes along with each of which it is asked.
export function cards(sheet: SVGSVGElement): Card[] {
  const groups = [...sheet.querySelectorAll("g[data-plan]")].filter((group) => !group.parentElement!.closest("g[data-plan]"));
  if (!groups.length) return [];
  const stage = document.createElement("div");
  stage.className = "stage";
  stage.appendChild(sheet);
  document.body.appendChild(stage);
  const shared = new Map<string, Element>();
  for (const element of sheet.querySelectorAll("[id]")) shared.set(element.id, element);
  groups.forEach(bared);
  const found = groups.map((group) => card(group as SVGGElement, sheet, shared));
  stage.remove();
  return found;
}

// A plan that is given this for its number has none: the page says below the picture which one it is.
export const NO_NUMBER = "·";

// Takes off what only a sheet needs: the number with the word before it, and the rectangle of nothing that is as large as
// the plan's part of the sheet.
function bared(group: Element): void {
  for (const child of group.querySelectorAll("text"))
    if (child.textContent?.trim() === NO_NUMBER) {
      if (child.previousElementSibling?.localName === "text") child.previousElementSibling.remove();
      child.remove();
    }
  for (const child of group.children) if (child.localName === "rect" && child.getAttribute("fill-opacity") === "0") child.remove();
}

const MARGIN = 4;

function card(group: SVGGElement, sheet: SVGSVGElement, shared: Map<string, Element>): Card {
  const svg = document.createElementNS(NAMESPACE, "svg");
  const box = boxOf(group);
  const width = box.width + 2 * MARGIN;
  const height = box.height + 2 * MARGIN;
  svg.setAttribute("viewBox", `${box.x - MARGIN} ${box.y - MARGIN} ${width} ${height}`);
  svg.setAttribute("role", "img");
  const defs = document.createElementNS(NAMESPACE, "defs");
  const copied = wrapped(group, sheet);
  for (const id of needed(copied, shared)) defs.appendChild(shared.get(id)!.cloneNode(true));
  if (defs.childNodes.length) svg.appendChild(defs);
  svg.appendChild(copied);
  return {svg, width, height};
}

function boxOf(group: SVGGElement): DOMRect {
  const box = group.getBBox();
  const to = group.getCTM();
  if (!to) return box;
  const corners = [
    [box.x, box.y],
    [box.x + box.width, box.y],
    [box.x, box.y + box.height],
    [box.x + box.width, box.y + box.height],
  ].map(([x, y]) => new DOMPoint(x, y).matrixTransform(to));
  const root = (group.ownerSVGElement!.getCTM() ?? new DOMMatrix()).inverse();
  const points = corners.map((point) => point.matrixTransform(root));
  const xs = points.map((point) => point.x);
  const ys = points.map((point) => point.y);
  return new DOMRect(Math.min(...xs), Math.min(...ys), Math.max(...xs) - Math.min(...xs), Math.max(...ys) - Math.min(...ys));
}

// A copy of the group within copies of the groups that it stands in, whose transforms and styles are its own, too.
function wrapped(group: Element, sheet: SVGSVGElement): Element {
  let copy = group.cloneNode(true) as Element;
  for (let above = group.parentElement; above && above !== (sheet as Element); above = above.parentElement) {
    const around = above.cloneNode(false) as Element;
    around.removeAttribute("clip-path");
    around.appendChild(copy);
    copy = around;
  }
  return copy;
}

// The ids that an element's references, and those of what they refer to, need.
function needed(element: Element, shared: Map<string, Element>): Set<string> {
  const found = new Set<string>();
  const look = (one: Element) => {
    for (const {name, value} of one.attributes) {
      const id = name === "href" ? value.slice(1) : /^url\(#(.+)\)$/.exec(value)?.[1];
      if (!id || found.has(id) || !shared.has(id) || element.querySelector(`#${CSS.escape(id)}`)) continue;
      found.add(id);
      walk(shared.get(id)!);
    }
  };
  const walk = (one: Element) => {
    look(one);
    one.querySelectorAll("*").forEach(look);
  };
  walk(element);
  return found;
}

// Lets the bars of a histogram, the points of a front, or the houses of a sheet be clicked. What stands beside the picture
// has the same as buttons: they are what the keyboard reaches.
export function clicked(chart: Element, kind: "bar" | "point" | "house", take: (number: number) => void): void {
  for (const group of chart.querySelectorAll(`[data-${kind}]`))
    group.addEventListener("click", () => take(Number(group.getAttribute(`data-${kind}`))));
}

// Lights trays of a plan's picture, by their numbers from 1; the picture counts from 0.
export function light(svg: Element | null, stretches: [number, number][]): void {
  for (const tray of svg?.querySelectorAll("[data-tray]") ?? []) {
    const number = Number(tray.getAttribute("data-tray")) + 1;
    tray.classList.toggle("lit", stretches.some(([first, last]) => first <= number && number <= last));
  }
}
