// The texts that the messages of an editor describe: opened, changed stretch by stretch, closed.

interface Position {
  line: number;
  character: number;
}

interface Change {
  range?: {start: Position; end: Position};
  text: string;
}

export interface KnownText {
  languageId: string;
  version: number;
  text: string;
}

function offset(text: string, {line, character}: Position): number {
  let at = 0;
  for (let n = 0; n < line; n++) {
    const end = text.indexOf("\n", at);
    if (end < 0) return text.length;
    at = end + 1;
  }
  return Math.min(text.length, at + character);
}

export class Texts {
  readonly known = new Map<string, KnownText>();

  // Takes a message; those that are about other things change nothing.
  take(message: {method?: string; params?: any}): void {
    const document = message.params?.textDocument;
    if (message.method === "textDocument/didOpen") this.known.set(document.uri, {languageId: document.languageId, version: document.version, text: document.text});
    if (message.method === "textDocument/didClose") this.known.delete(document.uri);
    const text = message.method === "textDocument/didChange" ? this.known.get(document.uri) : undefined;
    if (!text) return;
    text.version = document.version;
    for (const change of message.params.contentChanges as Change[])
      text.text = change.range ? text.text.slice(0, offset(text.text, change.range.start)) + change.text + text.text.slice(offset(text.text, change.range.end)) : change.text;
  }

  // The messages that make another reader know the same.
  opening(): string[] {
    return [...this.known].map(([uri, {languageId, version, text}]) =>
      JSON.stringify({jsonrpc: "2.0", method: "textDocument/didOpen", params: {textDocument: {uri, languageId, version, text}}}));
  }
}
