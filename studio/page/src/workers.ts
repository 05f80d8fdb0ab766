// The engines in two workers of this page, in place of a server: one is the language server, one answers questions. The
// files are in this page. What takes too long is ended by ending its worker; another one is started from the module that
// is compiled already, and is told the texts.
import {Texts} from "./texts";
import type {Transport, TransportState} from "./transport";

interface Asked {
  id: number;
  method: string;
  params: {uri?: string; subject?: string};
  text: string;
}

export interface HeldFiles {
  texts: Map<string, string>; // by path
  open: string;
  changed: () => void; // one was written
}

const GRACE_MS = 250; // an ended question may come to its end by itself

const CANCELLED = -32800;

async function hashOf(text: string): Promise<string> {
  const digest = await crypto.subtle.digest("SHA-256", new TextEncoder().encode(text));
  return [...new Uint8Array(digest)].slice(0, 16).map((byte) => byte.toString(16).padStart(2, "0")).join("");
}

export class WorkerTransport implements Transport {
  onText: (text: string) => void = () => {};
  onBytes: (bytes: ArrayBuffer) => void = () => {};
  onState: (state: TransportState) => void = () => {};
  private module: WebAssembly.Module | null = null;
  private language: Worker | null = null;
  private desk: Worker | null = null;
  private texts = new Texts();
  private waiting: Asked[] = []; // the first is being worked on
  private working = false;
  private ended = new Set<number>(); // ids that have had their answer
  private hashes = new Map<string, string>();

  constructor(private files: HeldFiles) {}

  async open(): Promise<void> {
    this.onState("opening");
    try {
      this.module = await WebAssembly.compileStreaming(fetch("engine.wasm"));
    } catch {
      this.onState("refused");
      return;
    }
    for (const [path, text] of this.files.texts) this.hashes.set(path, await hashOf(text));
    this.language = this.start("language", (text) => this.onText(text));
    this.desk = this.startDesk();
    this.onState("open");
  }

  private startDesk(): Worker {
    return this.start("desk", (text, bytes) => this.answered(text, bytes));
  }

  private start(role: "language" | "desk", take: (text: string, bytes: ArrayBuffer[]) => void): Worker {
    const worker = new Worker("worker.js", {type: "module"});
    worker.onmessage = ({data}) => {
      if (typeof data === "string") take(data, []);
      else if (data.answer) take(data.answer, data.bytes);
      else if (data.failed) this.onState("lost");
    };
    worker.onerror = () => this.onState("lost");
    worker.postMessage({module: this.module, files: Object.fromEntries([...this.files.texts].map(([path, text]) => [`/${path}`, text])), languages: [role]});
    return worker;
  }

  close(): void {
    this.language?.terminate();
    this.desk?.terminate();
  }

  send(text: string): void {
    if (!this.language || !this.desk) throw new Error("the engines have not begun");
    const message = JSON.parse(text);
    if (/^tartan\/(files|read|write|watch)$/.test(message.method)) void this.file(message);
    else if (typeof message.method === "string" && message.method.startsWith("tartan/")) this.ask({...message, text});
    else if (message.method === "$/cancelRequest" && this.waiting.some(({id}) => id === message.params.id)) this.cancel(message.params.id);
    else {
      this.texts.take(message);
      this.language.postMessage(text);
      if (/^textDocument\/did(Open|Change|Close)$/.test(message.method)) this.desk.postMessage(text);
    }
  }

  // ---- questions, one at a time

  private ask(asked: Asked): void {
    const same = this.waiting.filter((other) => other.method === asked.method && other.params.uri === asked.params.uri && other.params.subject === asked.params.subject);
    for (const {id} of same) this.cancel(id);
    this.waiting.push(asked);
    this.next();
  }

  private next(): void {
    if (this.working || !this.waiting.length) return;
    this.working = true;
    this.desk!.postMessage(this.waiting[0].text);
  }

  private answered(text: string, bytes: ArrayBuffer[]): void {
    const {id} = JSON.parse(text) as {id: number};
    if (this.waiting[0]?.id !== id) return;
    this.waiting.shift();
    this.working = false;
    if (!this.ended.delete(id)) {
      bytes.forEach(this.onBytes);
      this.onText(text);
    }
    this.next();
  }

  private cancel(id: number): void {
    if (this.ended.has(id)) return;
    this.onText(JSON.stringify({jsonrpc: "2.0", id, error: {code: CANCELLED, message: "cancelled"}}));
    if (!this.working || this.waiting[0].id !== id) {
      this.waiting = this.waiting.filter((other) => other.id !== id);
      return;
    }
    this.ended.add(id);
    window.setTimeout(() => {
      if (this.working && this.waiting[0]?.id === id) this.again();
    }, GRACE_MS);
  }

  private again(): void {
    this.desk!.terminate();
    this.ended.delete(this.waiting.shift()!.id);
    this.working = false;
    this.desk = this.startDesk();
    for (const opening of this.texts.opening()) this.desk.postMessage(opening);
    this.next();
  }

  // ---- files, which are in this page

  private async file({id, method, params}: {id: number; method: string; params: {path: string; text: string}}): Promise<void> {
    const answer = (result: unknown) => this.onText(JSON.stringify({jsonrpc: "2.0", id, result}));
    const {texts} = this.files;
    if (method === "tartan/files")
      answer({folder: "in this page", readOnly: false, open: this.files.open, cut: false, files: [...texts].map(([path, text]) => ({path, size: text.length, notation: path.split(".").pop()}))});
    else if (method === "tartan/watch") answer(null);
    else if (method === "tartan/read") {
      const text = texts.get(params.path);
      if (text === undefined) this.onText(JSON.stringify({jsonrpc: "2.0", id, error: {code: -32803, message: `there is no file ${params.path}`}}));
      else answer({path: params.path, text, hash: this.hashes.get(params.path)});
    } else {
      texts.set(params.path, params.text);
      const hash = await hashOf(params.text);
      this.hashes.set(params.path, hash);
      for (const worker of [this.language, this.desk]) worker?.postMessage({path: `/${params.path}`, text: params.text});
      answer({path: params.path, hash});
      this.files.changed();
    }
  }
}
