// What the language server says in Markdown comes as HTML: elements that carry text are kept, without attributes but the
// classes of colours; everything else is left out.
const ELEMENTS = new Set("P BR CODE PRE EM STRONG B I UL OL LI BLOCKQUOTE HR H1 H2 H3 H4 H5 H6 TABLE THEAD TBODY TR TH TD SPAN DIV DEL".split(" "));
const DROPPED = new Set("SCRIPT STYLE TEMPLATE IFRAME OBJECT EMBED SVG MATH NOSCRIPT".split(" "));

function copy(from: Node, to: Node): void {
  for (const child of from.childNodes) {
    if (child.nodeType === Node.TEXT_NODE) to.appendChild(document.createTextNode(child.nodeValue ?? ""));
    if (child.nodeType !== Node.ELEMENT_NODE) continue;
    const element = child as Element;
    const name = element.tagName.toUpperCase();
    if (DROPPED.has(name)) continue;
    if (!ELEMENTS.has(name)) {
      copy(element, to);
      continue;
    }
    const kept = document.createElement(name);
    const classes = (element.getAttribute("class") ?? "").replace(/[^\w \-ͼ]/g, "");
    if (name === "SPAN" && classes) kept.className = classes;
    copy(element, kept);
    to.appendChild(kept);
  }
}

export function sanitized(html: string): string {
  const parsed = new DOMParser().parseFromString(html, "text/html");
  const holder = document.createElement("div");
  copy(parsed.body, holder);
  return holder.innerHTML;
}
