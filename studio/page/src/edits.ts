// Edits of a text of rules that the page makes: where a clause, a case of a test or another value goes.

export interface Edit {
  from: number;
  to: number;
  insert: string;
}

// A place that the engines tell (lines and columns from 1, columns in bytes of UTF-8) as an offset into the text.
export function offsetOf(text: string, line: number, column: number): number {
  let begin = 0;
  for (let n = 1; n < line; n++) {
    const end = text.indexOf("\n", begin);
    if (end < 0) return text.length;
    begin = end + 1;
  }
  let bytes = column - 1;
  let at = begin;
  while (bytes > 0 && at < text.length && text[at] !== "\n") {
    const code = text.codePointAt(at)!;
    bytes -= code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    at += code < 0x10000 ? 1 : 2;
  }
  return at;
}

// The text with blanks for comments and quoted texts, so that offsets stay: what a reader of brackets may look at.
export function bared(text: string): string {
  const blank = (part: string) => part.replace(/[^\n]/g, " ");
  return text.replace(/#[^\n]*|(^|[^\d'’′ \t])([ \t]*)"(?:\\.|[^"\\\n])*"|[“„][^”“\n]*[”“]/gm, (whole, before) =>
    before === undefined ? blank(whole) : before + blank(whole.slice(before.length)),
  );
}

// The offset of the brace that closes the one at `open`; -1 if there is none.
function closing(bare: string, open: number): number {
  let depth = 0;
  for (let i = open; i < bare.length; i++) {
    if (bare[i] === "{") depth++;
    else if (bare[i] === "}" && --depth === 0) return i;
  }
  return -1;
}

const escaped = (name: string) => name.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");

interface Block {
  begin: number;
  open: number;
  close: number;
}

function block(text: string, head: RegExp): Block | null {
  const bare = bared(text);
  for (const match of bare.matchAll(head)) {
    const open = bare.indexOf("{", match.index);
    const close = open < 0 ? -1 : closing(bare, open);
    if (close >= 0) return {begin: match.index + match[0].length - match[0].trimStart().length, open, close};
  }
  return null;
}

// A line more before the brace that closes a block.
function lineBefore(text: string, {open, close}: Block, line: string): Edit {
  const begin = text.lastIndexOf("\n", close - 1) + 1;
  if (begin > open && /^\s*$/.test(text.slice(begin, close))) return {from: begin, to: begin, insert: `  ${line}\n`};
  const inside = text.slice(0, close).replace(/\s+$/, "").length;
  return {from: inside, to: close, insert: `\n  ${line}\n`};
}

export function libraryBlock(text: string, name: string): Block | null {
  return block(text, new RegExp(`^[ \\t]*library\\s+${escaped(name)}(?![\\w-])[^{}]*`, "gim"));
}

// The edits that give a library a new rule: the rule before it, its name as a clause inside. Null if the library does
// not stand in this text.
export function addRule(text: string, library: string, clause: "require" | "prune", rule: {name: string; doc: string; text: string}): Edit[] | null {
  const found = libraryBlock(text, library);
  if (!found) return null;
  const doc = rule.doc.replace(/["\\]/g, "'");
  return [
    {from: found.begin, to: found.begin, insert: `rule ${rule.name} "${doc}" =\n  ${rule.text}\n\n`},
    lineBefore(text, found, `${clause} ${rule.name}`),
  ];
}

// The edit that gives a library one clause more. Null if the library does not stand in this text.
export function addClause(text: string, library: string, clause: "require" | "prune", rule: string): Edit | null {
  const found = libraryBlock(text, library);
  return found && lineBefore(text, found, `${clause} ${rule}`);
}

// The edit that adds a case to the test of a rule or library, or such a test at the end.
export function addCase(text: string, subject: string, verdict: "match" | "reject" | "keep" | "drop", plan: string, by?: string): Edit {
  const line = `${verdict.padEnd(verdict === "match" || verdict === "reject" ? 6 : 4)} [${plan}]${by ? ` by ${by}` : ""}`;
  const found = block(text, new RegExp(`^[ \\t]*test\\s+${escaped(subject)}\\s*(?=\\{)`, "gim"));
  if (found) return lineBefore(text, found, line);
  const body = text.replace(/\s+$/, "");
  return {from: body.length, to: text.length, insert: `${body ? "\n\n" : ""}test ${subject} {\n  ${line}\n}\n`};
}

// A name that nothing in the text has yet.
export function freeName(text: string, wanted: string): string {
  const bare = bared(text);
  const taken = (name: string) => new RegExp(`(?<![\\w-])${escaped(name)}(?![\\w-])`).test(bare);
  if (!taken(wanted)) return wanted;
  let n = 2;
  while (taken(`${wanted}-${n}`)) n++;
  return `${wanted}-${n}`;
}

export function applied(text: string, edits: Edit[]): string {
  return [...edits].sort((a, b) => b.from - a.from).reduce((made, {from, to, insert}) => made.slice(0, from) + insert + made.slice(to), text);
}
