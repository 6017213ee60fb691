// How things stand, in words.
import { element, setText } from "../dom";
import { readable } from "../units";
import { axisNames, endStopBit, faultColumn, furtherAxes, linesColumn, logColumns, planarAxes, type AxisName, type State } from "./wire";

const modes = ["no drive", "open loop", "position", "velocity", "braking", "latched fault"];
const killBit = 4;
const readyBits: [string, number][] = [
  ["y", 5],
  ["x", 6],
];
const furtherReadyBit = 15; // of all further axes in series

export class Lamps {
  readonly list = element("dl", "lamps");
  private readonly values = new Map<string, { box: HTMLElement; value: HTMLElement }>();

  constructor() {
    for (const name of ["Run", "Virtual time", ...axisNames, "Fault", "Kill switch", "End-stops", "Amplifiers", "Duty", "Carrier", "Not shown"]) {
      this.add(name);
    }
  }

  show(state: State, row: (number | null)[] | null, truth: (number | null)[] | null, missed: number): void {
    const running = state.phase === "running";
    this.set("Run", state.phase + (running && state.paused ? ", paused" : ""), false);
    this.set("Virtual time", row === null ? "none" : `${row[0]!.toFixed(3)} s`, false);
    const further = furtherAxes.filter((axis) => state.limits?.[axis]?.exists);
    const shown = [...planarAxes, ...further];
    this.showModes(shown, row);
    const fault = row?.[faultColumn] ?? 0;
    this.set("Fault", fault === 0 ? "none" : `${fault} latched`, fault !== 0);
    const lines = truth?.[linesColumn] ?? 0;
    const killed = ((lines >> killBit) & 1) === 1;
    this.set("Kill switch", killed ? "pressed" : "released", killed);
    const tripped = axisNames.flatMap((axis) => ["min", "max"].filter((_, end) => (lines >> (endStopBit(axis) + end)) & 1).map((end) => `${axis} ${end}`));
    this.set("End-stops", tripped.length === 0 ? "all free" : `${tripped.join(", ")} tripped`, tripped.length > 0);
    const bits: typeof readyBits = further.length === 0 ? readyBits : [...readyBits, [further.join(" "), furtherReadyBit]];
    const ready = bits.map(([name, bit]) => `${name} ${(lines >> bit) & 1 ? "ready" : "not ready"}`);
    this.set("Amplifiers", truth === null ? "none" : ready.join(", "), false);
    const duties = shown.map((axis) => readable(row?.[logColumns(axis).duty] ?? 0));
    this.set("Duty", row === null ? "none" : `${duties.join(" / ")} %`, false);
    this.set("Carrier", state.clock === "real" ? "local socket, wall clock" : "in process, lockstep", false);
    this.set("Not shown", `${state.dropped} rows, ${missed} frames`, false);
  }

  private showModes(axes: AxisName[], row: (number | null)[] | null): void {
    for (const axis of axisNames) {
      this.values.get(axis)!.box.hidden = !axes.includes(axis);
      if (!axes.includes(axis)) continue;
      const mode = row?.[logColumns(axis).mode] ?? 0;
      this.set(axis, modes[mode] ?? "unknown", mode >= 4);
    }
  }

  private add(name: string): void {
    const box = element("div");
    const value = element("dd", "", "none");
    value.dataset.lamp = name;
    box.append(element("dt", "", name), value);
    this.list.append(box);
    this.values.set(name, { box, value });
  }

  private set(name: string, text: string, on: boolean): void {
    const { box, value } = this.values.get(name)!;
    setText(value, text);
    box.classList.toggle("on", on);
  }
}
