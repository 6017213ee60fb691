// How things stand, in words.
import { element, setText } from "../dom";
import { readable } from "../units";
import { faultColumn, linesColumn, logColumns, type State } from "./wire";

const modes = ["no drive", "open loop", "position", "velocity", "braking", "latched fault"];
const inputs = ["Y min", "Y max", "X min", "X max"];
const killBit = 4;
const readyBits: [string, number][] = [
  ["Y", 5],
  ["X", 6],
];
const y = logColumns("y");
const x = logColumns("x");

export class Lamps {
  readonly list = element("dl", "lamps");
  private readonly values = new Map<string, { box: HTMLElement; value: HTMLElement }>();

  constructor() {
    for (const name of ["Run", "Virtual time", "Y", "X", "Fault", "Kill switch", "End-stops", "Amplifiers", "Duty", "Carrier", "Not shown"]) {
      const box = element("div");
      const value = element("dd", "", "none");
      value.dataset.lamp = name;
      box.append(element("dt", "", name), value);
      this.list.append(box);
      this.values.set(name, { box, value });
    }
  }

  show(state: State, row: (number | null)[] | null, truth: (number | null)[] | null, missed: number): void {
    const running = state.phase === "running";
    this.set("Run", state.phase + (running && state.paused ? ", paused" : ""), false);
    this.set("Virtual time", row === null ? "none" : `${row[0]!.toFixed(3)} s`, false);
    const [yMode, xMode] = [row?.[y.mode] ?? 0, row?.[x.mode] ?? 0];
    this.set("Y", modes[yMode] ?? "unknown", yMode >= 4);
    this.set("X", modes[xMode] ?? "unknown", xMode >= 4);
    const fault = row?.[faultColumn] ?? 0;
    this.set("Fault", fault === 0 ? "none" : `${fault} latched`, fault !== 0);
    const lines = truth?.[linesColumn] ?? 0;
    const killed = ((lines >> killBit) & 1) === 1;
    this.set("Kill switch", killed ? "pressed" : "released", killed);
    const tripped = inputs.filter((_, bit) => (lines >> bit) & 1);
    this.set("End-stops", tripped.length === 0 ? "all free" : `${tripped.join(", ")} tripped`, tripped.length > 0);
    const ready = readyBits.map(([name, bit]) => `${name} ${(lines >> bit) & 1 ? "ready" : "not ready"}`);
    this.set("Amplifiers", truth === null ? "none" : ready.join(", "), false);
    this.set("Duty", row === null ? "none" : `${readable(row[y.duty] ?? 0)} / ${readable(row[x.duty] ?? 0)} %`, false);
    this.set("Carrier", state.clock === "real" ? "local socket, wall clock" : "in process, lockstep", false);
    this.set("Not shown", `${state.dropped} rows, ${missed} frames`, false);
  }

  private set(name: string, text: string, on: boolean): void {
    const { box, value } = this.values.get(name)!;
    setText(value, text);
    box.classList.toggle("on", on);
  }
}
