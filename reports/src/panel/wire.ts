// What the bench sends and takes. harness/panel/frames.cc and steering.h are the other end.

export interface AxisLimits {
  exists: boolean;
  hall_min_m: number;
  hall_max_m: number;
  hard_min_m: number;
  hard_max_m: number;
  soft_min_m: number; // as the controller believes
  soft_max_m: number;
  turns: boolean; // read rad for m
}

export type Limits = { y: AxisLimits; x: AxisLimits } & Partial<Record<AxisName, AxisLimits>>;

export type Estimator = "frequency" | "period" | "hybrid";

export interface State {
  phase: "idle" | "running" | "judging" | "over";
  number: number;
  name: string;
  title: string;
  clock: "lockstep" | "real";
  timing: string; // by the wall clock, over: how both loops kept time
  folder: string;
  verdict: string;
  reason: string;
  dropped: number;
  speed?: number;
  paused?: boolean;
  holds?: boolean;
  active_faults?: string[];
  trouble?: string;
  limits?: Limits; // y, x, and the further axes that the machine has
  followed?: Partial<Record<AxisName, Estimator>>; // by the control law
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

export type AxisName = "y" | "x" | "z" | "a" | "b" | "c";
export const furtherAxes: AxisName[] = ["z", "a", "b", "c"];
export const planarAxes: AxisName[] = ["y", "x"];
export const axisNames: AxisName[] = [...planarAxes, ...furtherAxes];

// Columns of a row: time, then of y and of x what logColumns names, then the fault and the force
// sensor's y and x; of a machine with further axes, then the same of each of these.
const ofFurther = 22;
const perAxis = 9;
export const rowWidth = ofFurther + perAxis * furtherAxes.length;
export const faultColumn = 19;
// Columns of a truth row: time, then of y and of x what truthColumns names, then the input lines;
// of a machine with further axes, then the same of each of these.
const truthOfFurther = 10;
const truthPerAxis = 4;
export const truthWidth = truthOfFurther + truthPerAxis * furtherAxes.length;
export const linesColumn = 9;

function firstColumn(axis: AxisName, further: number, each: number): number {
  if (axis === "y") return 1;
  return axis === "x" ? 1 + each : further + each * furtherAxes.indexOf(axis);
}

// The bit of an axis' end-stop at min among the input lines; that at max is the next.
export function endStopBit(axis: AxisName): number {
  if (axis === "y") return 0;
  return axis === "x" ? 2 : 7 + 2 * furtherAxes.indexOf(axis);
}

export function logColumns(axis: AxisName) {
  const first = firstColumn(axis, ofFurther, perAxis);
  return {
    reference: first,
    position: first + 1,
    referenceSpeed: first + 2,
    speed: first + 3,
    duty: first + 4,
    mode: first + 5,
    frequency: first + 6,
    period: first + 7,
    hybrid: first + 8,
    force: axis === "y" ? 20 : 21, // of y and x alone
  };
}

export function truthColumns(axis: AxisName) {
  const first = firstColumn(axis, truthOfFurther, truthPerAxis);
  return { position: first, speed: first + 1, current: first + 2, force: first + 3 };
}

export interface Frame {
  kind: "frame";
  state: State;
  rows: (number | null)[][];
  truth: (number | null)[][];
  events: BenchEvent[];
  console: string;
}

type Message = Frame | { kind: "heard" } | { kind: "refused"; why: string } | { kind: "missed"; frames: number };

export interface Listener {
  onFrame(frame: Frame): void;
  onRefused(why: string): void;
  onMissed(frames: number): void;
  onConnection(state: "open" | "lost"): void;
}

export class Wire {
  private socket: WebSocket | null = null;
  private readonly unanswered: string[] = []; // commands, in order

  constructor(private readonly listener: Listener) {
    this.connect();
  }

  send(message: Record<string, unknown>): void {
    if (this.socket?.readyState === WebSocket.OPEN) {
      this.socket.send(JSON.stringify(message));
      this.unanswered.push(String(message.do));
    } else this.listener.onRefused("not connected: the bench did not hear that");
  }

  private connect(): void {
    const socket = new WebSocket(`ws://${location.host}/live`);
    socket.onopen = () => this.listener.onConnection("open");
    socket.onmessage = (event) => this.hear(JSON.parse(String(event.data)) as Message);
    socket.onclose = () => {
      this.listener.onConnection("lost");
      const unheard = this.unanswered.splice(0);
      if (unheard.length > 0) this.listener.onRefused(`the connection broke: the bench may not have heard: ${unheard.join(", ")}`);
      setTimeout(() => this.connect(), 1500);
    };
    this.socket = socket;
  }

  private hear(message: Message): void {
    if (message.kind === "frame") {
      this.listener.onFrame(message);
      return;
    }
    if (message.kind === "missed") {
      this.listener.onMissed(message.frames);
      return;
    }
    this.unanswered.shift();
    if (message.kind === "refused") this.listener.onRefused(message.why);
  }
}
