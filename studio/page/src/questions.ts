// Questions about the text that is shown, at its version: an answer about an older text is dropped.
import type {LSPClient} from "@codemirror/lsp-client";
import {CANCELLED, GONE, MODIFIED, type Connection, type Failure} from "./connection";
import type {OpenFile} from "./documents";
import type {Questions as Table} from "./requests";

export interface Note {
  severity: string;
  code: string;
  message: string;
  help?: string;
  path?: string;
  line?: number;
  column?: number;
}

// The answer came too late, or not at all, and a newer question has taken its place.
export class Stale extends Error {}

// The question was answered by saying what is wrong.
export class Refused extends Error {
  readonly code: string;
  readonly help: string;
  readonly line: number;
  readonly column: number;
  readonly path: string; // of the file in which that is
  readonly unknown: boolean;

  constructor(failure: Failure) {
    super(failure.message);
    this.code = failure.data?.code ?? "";
    this.help = failure.data?.help ?? "";
    this.line = failure.data?.line ?? 0;
    this.column = failure.data?.column ?? 0;
    this.path = failure.data?.path ?? "";
    this.unknown = failure.code === -32601;
  }
}

export interface Answered<K extends keyof Table> {
  answer: Table[K]["answer"];
  notes: Note[];
  bytes: Uint8Array<ArrayBuffer>[];
}

export class Questions {
  private asked = new Set<number>();

  constructor(
    private connection: Connection,
    private client: LSPClient,
    private file: () => OpenFile | null,
  ) {}

  // `subject` tells questions of one name apart: a newer one of the same subject ends the older.
  async ask<K extends keyof Table>(name: K, request: Table[K]["request"], subject?: string): Promise<Table[K]["answer"]> {
    return (await this.askWithNotes(name, request, subject)).answer;
  }

  // `texts` are files that only this question names.
  async askWithNotes<K extends keyof Table>(name: K, request: Table[K]["request"], subject?: string, texts?: Record<string, string>): Promise<Answered<K>> {
    return this.send(name, {subject, request, texts});
  }

  // Files that are no text come as bytes, in the order of the answer's files.
  async askWithBytes<K extends keyof Table>(name: K, request: Table[K]["request"], subject?: string): Promise<Answered<K>> {
    return this.send(name, {subject, request, binary: true});
  }

  private async send<K extends keyof Table>(name: K, params: object): Promise<Answered<K>> {
    const file = this.file();
    if (!file || this.connection.state !== "open") throw new Stale();
    this.client.sync();
    const version = file.version;
    await this.client.initializing;
    let own = 0;
    try {
      const result = await this.connection.ask(`tartan/${name}`, {uri: file.uri, version, ...params}, (id) => this.asked.add((own = id)));
      if (this.file() !== file || file.version !== version) throw new Stale();
      return {answer: result.answer, notes: result.notes ?? [], bytes: result.bytes ?? []};
    } catch (failure) {
      if (failure instanceof Stale) throw failure;
      const {code} = failure as Failure;
      if (code === CANCELLED || code === MODIFIED || code === GONE || this.file() !== file || file.version !== version) throw new Stale();
      throw new Refused(failure as Failure);
    } finally {
      this.asked.delete(own);
    }
  }

  // The text is another, or another file is shown: what is still worked on is not worth the time.
  cancel(): void {
    for (const id of this.asked) this.connection.cancel(id);
    this.asked.clear();
  }
}

// For work that nobody waits for: what comes too late, or is refused where there is no place to say so, is left.
export function quietly(work: Promise<unknown>): void {
  work.catch((failure) => {
    if (!(failure instanceof Stale || failure instanceof Refused)) throw failure;
  });
}
