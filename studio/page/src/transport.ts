// How the page and the engines exchange messages: JSON texts both ways, and bytes that go before an answer. A web socket to `tartan studio`; in the
// playground, workers (playground.ts).

export type TransportState = "opening" | "open" | "lost" | "refused";

export interface Transport {
  send(text: string): void;
  close(): void;
  onText: (text: string) => void;
  onBytes: (bytes: ArrayBuffer) => void;
  onState: (state: TransportState) => void;
}

const FIRST_WAIT_MS = 400;
const LONGEST_WAIT_MS = 5000;

// One web socket after another: when one ends, the next is tried, ever more seldom.
export class SocketTransport implements Transport {
  onText: (text: string) => void = () => {};
  onBytes: (bytes: ArrayBuffer) => void = () => {};
  onState: (state: TransportState) => void = () => {};
  private socket: WebSocket | null = null;
  private wait = FIRST_WAIT_MS;
  private timer = 0;
  private ended = false;

  constructor(private address: string, private token: string) {}

  open(): void {
    this.onState("opening");
    let began = false;
    const socket = new WebSocket(this.address, ["tartan.1", `token.${this.token}`]);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.onopen = () => {
      began = true;
      this.wait = FIRST_WAIT_MS;
      this.onState("open");
    };
    socket.onmessage = ({data}) => (typeof data === "string" ? this.onText(data) : this.onBytes(data));
    socket.onclose = () => {
      if (this.socket !== socket || this.ended) return;
      this.socket = null;
      this.onState(began ? "lost" : "refused");
      this.timer = window.setTimeout(() => this.open(), this.wait);
      this.wait = Math.min(LONGEST_WAIT_MS, this.wait * 2);
    };
  }

  // Another server, or the same one started again: its token is another.
  renew(token: string): void {
    this.token = token;
    this.retry();
  }

  retry(): void {
    clearTimeout(this.timer);
    const old = this.socket;
    this.socket = null;
    old?.close();
    this.wait = FIRST_WAIT_MS;
    this.open();
  }

  send(text: string): void {
    if (this.socket?.readyState !== WebSocket.OPEN) throw new Error("there is no connection");
    this.socket.send(text);
  }

  close(): void {
    this.ended = true;
    clearTimeout(this.timer);
    this.socket?.close();
  }
}
