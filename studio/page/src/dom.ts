// Elements in few words. Text is set as text, never read as HTML.

type Child = Node | string | number | null | undefined | false;
type Attributes = Record<string, unknown>;

export function h<K extends keyof HTMLElementTagNameMap>(tag: K, attributes?: Attributes | null, ...children: (Child | Child[])[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on") && typeof value === "function") element.addEventListener(name.slice(2), value as EventListener);
    else if (name === "value" && "value" in element) (element as unknown as {value: unknown}).value = value;
    else if (value === true) element.setAttribute(name, "");
    else element.setAttribute(name, String(value));
  }
  append(element, ...children);
  return element;
}

export function append(parent: Node, ...children: (Child | Child[])[]): void {
  for (const child of children.flat()) {
    if (child === null || child === undefined || child === false) continue;
    parent.appendChild(typeof child === "object" ? child : document.createTextNode(String(child)));
  }
}

export function fill(parent: Element, ...children: (Child | Child[])[]): void {
  parent.replaceChildren();
  append(parent, ...children);
}

// `text` with what stands between backquotes as code.
export function withCode(text: string): Node[] {
  return text.split("`").map((part, i) => (i % 2 ? h("code", null, part) : document.createTextNode(part)));
}

// Work that follows something that changes often: at once, then again at most so often, and never so often that it is at
// work more than two thirds of the time.
export function paced(work: () => Promise<void>, least: number): {(): void; cancel(): void} {
  let timer = 0;
  let began = -Infinity;
  let took = 0;
  const run = async () => {
    timer = 0;
    began = performance.now();
    await work();
    took = performance.now() - began;
  };
  const start = () => {
    if (timer === 0) timer = window.setTimeout(run, Math.max(0, began + Math.max(least, 1.5 * took) - performance.now()));
  };
  return Object.assign(start, {cancel: () => {
    clearTimeout(timer);
    timer = 0;
  }});
}

export function later(work: () => void, ms: number): {(): void; cancel(): void} {
  let timer = 0;
  const start = () => {
    clearTimeout(timer);
    timer = window.setTimeout(work, ms);
  };
  return Object.assign(start, {cancel: () => clearTimeout(timer)});
}
