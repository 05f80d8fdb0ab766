// JSON-RPC over a transport: the page's own questions beside the messages of the client of the language server.
import type {Transport, TransportState} from "./transport";

export interface Failure {
  code: number;
  message: string;
  data?: {code?: string; help?: string; line?: number; column?: number; path?: string; hash?: string | null};
}

export const CANCELLED = -32800;
export const MODIFIED = -32801;
export const NO_METHOD = -32601;
export const GONE = -1;

interface Waiting {
  resolve: (result: any) => void;
  reject: (failure: Failure) => void;
}

// The client of the language server counts its requests from 1.
const FIRST_ID = 1_000_000_000;

export class Connection {
  state: TransportState = "opening";
  private waiting = new Map<number, Waiting>();
  private readers = new Set<(text: string) => void>();
  private watchers = new Set<(state: TransportState) => void>();
  private notices = new Map<string, (params: any) => void>();
  private bytes = new Map<number, ArrayBuffer>(); // messages whose answer has not come yet, by their numbers
  private next = FIRST_ID;

  // What the client of the language server takes for its transport.
  readonly languageTransport = {
    send: (text: string) => this.transport.send(text),
    subscribe: (reader: (text: string) => void) => void this.readers.add(reader),
    unsubscribe: (reader: (text: string) => void) => void this.readers.delete(reader),
  };

  constructor(private transport: Transport) {
    transport.onText = (text) => this.take(text);
    transport.onBytes = (bytes) => void this.bytes.set(new DataView(bytes).getUint32(0, true), bytes);
    transport.onState = (state) => this.change(state);
  }

  onState(watcher: (state: TransportState) => void): void {
    this.watchers.add(watcher);
  }

  onNotice(method: string, reader: (params: any) => void): void {
    this.notices.set(method, reader);
  }

  // `begun` is told the request's id, by which it can be cancelled.
  ask(method: string, params: unknown, begun?: (id: number) => void): Promise<any> {
    const id = this.next++;
    begun?.(id);
    return new Promise((resolve, reject) => {
      this.waiting.set(id, {resolve, reject}); // the answer may come before send() has ended
      try {
        this.transport.send(JSON.stringify({jsonrpc: "2.0", id, method, params}));
      } catch {
        this.waiting.delete(id);
        reject({code: GONE, message: "there is no connection"} satisfies Failure);
      }
    });
  }

  // The answer is wanted no more; it comes as an error, or as if nothing had been said.
  cancel(id: number): void {
    if (!this.waiting.has(id)) return;
    try {
      this.transport.send(JSON.stringify({jsonrpc: "2.0", method: "$/cancelRequest", params: {id}}));
    } catch {
      // It went with the connection.
    }
  }

  private take(text: string): void {
    const message = JSON.parse(text);
    if (typeof message.id === "number" && message.id >= FIRST_ID && !("method" in message)) {
      const waiting = this.waiting.get(message.id);
      this.waiting.delete(message.id);
      if (message.result?.bytes) message.result.bytes = message.result.bytes.map((number: number) => this.takeBytes(number));
      if (message.error) waiting?.reject(message.error);
      else waiting?.resolve(message.result);
      return;
    }
    const notice = this.notices.get(message.method);
    if (notice) notice(message.params);
    else for (const reader of this.readers) reader(text);
  }

  // The file in a message of bytes: behind eight of its own.
  private takeBytes(number: number): Uint8Array<ArrayBuffer> {
    const bytes = this.bytes.get(number)!;
    this.bytes.delete(number);
    return new Uint8Array(bytes, 8);
  }

  private change(state: TransportState): void {
    this.state = state;
    if (state !== "open") {
      for (const {reject} of this.waiting.values()) reject({code: GONE, message: "the connection is gone"});
      this.waiting.clear();
      this.bytes.clear();
    }
    for (const watcher of this.watchers) watcher(state);
  }
}
