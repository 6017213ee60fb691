// What the bench sends and takes. harness/panel/frames.cc and steering.h are the other end.

export interface AxisLimits {
  exists: boolean;
  hall_min_m: number;
  hall_max_m: number;
  hard_min_m: number;
  hard_max_m: number;
  soft_min_m: number; // as the controller believes
  soft_max_m: number;
}

export interface State {
  phase: "idle" | "running" | "judging" | "over";
  number: number;
  name: string;
  title: string;
  folder: string;
  verdict: string;
  reason: string;
  dropped: number;
  speed?: number;
  paused?: boolean;
  holds?: boolean;
  broken?: string[];
  trouble?: string;
  limits?: { y: AxisLimits; x: AxisLimits };
  exchange_us_bins?: number[];
}

export interface BenchEvent {
  time_s: number;
  side: string;
  kind: string;
  axis?: string;
  code?: number;
  text?: string;
  value?: number;
  lines?: number;
}

// Columns of a row: time, then five figures and the mode of y and of x, then the fault.
export const rowWidth = 14;
// Columns of a truth row: time, then four figures of y and of x, then the input lines.
export const truthWidth = 10;

export interface Frame {
  kind: "frame";
  state: State;
  rows: (number | null)[][];
  truth: (number | null)[][];
  events: BenchEvent[];
  console: string;
}

type Message = Frame | { kind: "refused"; why: string } | { kind: "missed"; frames: number };

export interface Listener {
  onFrame(frame: Frame): void;
  onRefused(why: string): void;
  onMissed(frames: number): void;
  onConnection(state: "open" | "lost"): void;
}

export class Wire {
  private socket: WebSocket | null = null;

  constructor(private readonly listener: Listener) {
    this.connect();
  }

  send(message: Record<string, unknown>): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
    else this.listener.onRefused("not connected: the bench did not hear that");
  }

  private connect(): void {
    const socket = new WebSocket(`ws://${location.host}/live`);
    socket.onopen = () => this.listener.onConnection("open");
    socket.onmessage = (event) => this.hear(JSON.parse(String(event.data)) as Message);
    socket.onclose = () => {
      this.listener.onConnection("lost");
      setTimeout(() => this.connect(), 1500);
    };
    this.socket = socket;
  }

  private hear(message: Message): void {
    if (message.kind === "frame") this.listener.onFrame(message);
    else if (message.kind === "refused") this.listener.onRefused(message.why);
    else this.listener.onMissed(message.frames);
  }
}
