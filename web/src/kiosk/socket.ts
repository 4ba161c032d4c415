// The guidance socket as the kiosk holds it: says hello, comes back by itself, gives up only where that is no use.
import type { ClientMessage, Hello, ServerMessage } from "../generated/protocol";

export interface Listener {
  opened: () => void;
  told: (message: ServerMessage) => void;
  pictured: (message: ArrayBuffer) => void;
  /** `again_ms`: when the next attempt is made, null when none is. */
  closed: (code: number, again_ms: number | null) => void;
}

export const OTHER_VERSION = 4400;
export const KEY_REFUSED = 4401;
export const ROLE_REFUSED = 4403;
export const NO_STATION = 4404;
export const STATION_TAKEN = 4409;

const FINAL: ReadonlySet<number> = new Set([KEY_REFUSED, ROLE_REFUSED, NO_STATION]);
const FIRST_MS = 400;
const LONGEST_MS = 3000;

/** How long to wait before the next attempt; null: asking again would get the same answer. */
export function retryAfter(code: number, attempt: number): number | null {
  if (FINAL.has(code)) return null;
  if (code === STATION_TAKEN) return LONGEST_MS;
  return Math.min(LONGEST_MS, FIRST_MS * 2 ** attempt);
}

export function socketAddress(origin: string, station: string): string {
  return `${origin.replace(/^http/, "ws")}/ws/v1/stations/${encodeURIComponent(station)}/guidance`;
}

export class GuidanceSocket {
  private socket: WebSocket | null = null;
  private attempt = 0;
  private timer: number | undefined;

  constructor(
    private readonly address: string,
    private readonly hello: Hello,
    private readonly listener: Listener,
  ) {}

  connect(): void {
    const socket = new WebSocket(this.address);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => socket.send(JSON.stringify(this.hello));
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => this.hear(event.data);
    socket.onclose = (event) => {
      if (this.socket === socket) this.lose(event.code);
    };
    this.socket = socket;
  }

  /** Says a message if there is somebody to hear it; what is not said is not said later either. */
  say(message: ClientMessage): void {
    if (this.isOpen()) this.socket?.send(JSON.stringify(message));
  }

  sendPicture(message: ArrayBuffer): void {
    if (this.isOpen()) this.socket?.send(message);
  }

  isOpen(): boolean {
    return this.socket?.readyState === WebSocket.OPEN;
  }

  /** Drops a connection that answers no more, and makes a new one. */
  renew(): void {
    const old = this.socket;
    this.socket = null;
    old?.close();
    this.lose(1006);
  }

  close(): void {
    window.clearTimeout(this.timer);
    const old = this.socket;
    this.socket = null;
    old?.close();
  }

  private hear(data: string | ArrayBuffer): void {
    if (typeof data !== "string") {
      this.listener.pictured(data);
      return;
    }
    const message = JSON.parse(data) as ServerMessage;
    if (message.type === "welcome") {
      this.attempt = 0;
      this.listener.opened();
    }
    this.listener.told(message);
  }

  private lose(code: number): void {
    this.socket = null;
    const again_ms = retryAfter(code, this.attempt);
    this.attempt += 1;
    if (again_ms !== null) this.timer = window.setTimeout(() => this.connect(), again_ms);
    this.listener.closed(code, again_ms);
  }
}
