// What the operator may do to the run: its pace, the kill switch, the end-stops, any fault, its end.
import { element, setText } from "../dom";
import type { Catalogue, FaultKind } from "./catalogue";
import { button, labelled, select, setOptions, textField } from "./form";
import { speedSelect } from "./start_form";
import { type AxisName, axisNames, type State } from "./wire";

type Send = (message: Record<string, unknown>) => void;

const killFault = "kill_switch pressed";
const endStops = axisNames.flatMap((axis) => [`${axis}_min`, `${axis}_max`]);

export class SteeringBar {
  readonly box = element("section");
  private readonly pauseButton = button("Pause", () => this.togglePause());
  private readonly step = select([
    ["1", "1 ms"],
    ["10", "10 ms"],
    ["100", "100 ms"],
    ["1000", "1 s"],
  ]);
  private readonly speed = speedSelect();
  private readonly kill = button("KILL (K)", () => this.toggleKill(), "kill");
  private readonly stops: HTMLButtonElement[];
  private readonly place = select([]);
  private readonly kind = select([]);
  private readonly parameters = textField();
  private readonly meaning = element("p", "help");
  private readonly all: (HTMLButtonElement | HTMLSelectElement | HTMLInputElement)[];
  private readonly always: HTMLButtonElement[];
  private catalogue: Catalogue | null = null;
  private state: State | null = null;
  private placesOf = ""; // axes

  constructor(private readonly send: Send) {
    this.kill.id = "kill";
    this.step.id = "step-length";
    this.speed.id = "speed";
    this.place.id = "fault-part";
    this.kind.id = "fault-kind";
    this.stops = endStops.map((name) => button(`End-stop ${name.replace("_", " ")}`, () => this.toggleStop(name)));
    this.speed.addEventListener("change", () => send({ do: "speed", speed: Number(this.speed.value) }));
    const stepButton = button("Step (S)", () => this.stepOnce());
    const finish = button("Finish", () => send({ do: "finish" }));
    finish.id = "finish";
    const cut = button("Cut short", () => send({ do: "cut" }));
    const injectButton = button("Inject", () => send({ do: "inject", fault: this.words() }));
    const clearButton = button("Clear fault", () => send({ do: "clear", fault: `${this.place.value} ${this.kind.value}` }));
    const first = element("div", "bar-row");
    first.append(
      this.kill,
      this.pauseButton,
      stepButton,
      labelled("Step", this.step),
      labelled("Speed", this.speed),
      element("span", "gap"),
      finish,
      cut,
    );
    const second = element("div", "bar-row");
    second.append(
      ...this.stops,
      element("span", "gap"),
      labelled("Part", this.place),
      labelled("Fault", this.kind),
      labelled("Parameters", this.parameters),
      injectButton,
      clearButton,
    );
    this.box.append(first, second, this.meaning);
    this.place.addEventListener("change", () => this.showKinds());
    this.kind.addEventListener("change", () => this.showParameters());
    this.always = [finish, cut];
    this.all = [this.kill, this.pauseButton, stepButton, injectButton, clearButton, this.speed, this.step, ...this.stops];
    document.addEventListener("keydown", (event) => this.onKey(event));
  }

  setCatalogue(catalogue: Catalogue): void {
    this.catalogue = catalogue;
    this.showPlaces();
  }

  // Parts of axes that the machine of the last run has; before there is one, those of y and x.
  private showPlaces(): void {
    const limits = this.state?.limits;
    const has = (axis: AxisName) => (limits === undefined ? axis === "y" || axis === "x" : limits[axis]?.exists ?? false);
    const shown = axisNames.filter(has).join("");
    if (shown === this.placesOf || this.catalogue === null) return;
    this.placesOf = shown;
    const isShown = (name: string) => !/\.[yxzabc](_|$)/.test(name) || shown.includes(name.split(".")[1]![0]!);
    setOptions(this.place, this.catalogue.places.filter(({ name }) => isShown(name)).map(({ name }) => [name, name]));
    this.stops.forEach((one, i) => (one.hidden = !shown.includes(endStops[i]![0]!)));
    this.showKinds();
  }

  show(state: State): void {
    this.state = state;
    this.showPlaces();
    const running = state.phase === "running";
    // A clock that does not wait: what is typed, and the end.
    const lockstep = state.clock === "lockstep";
    for (const field of this.all) field.disabled = !running || !lockstep;
    for (const field of this.always) field.disabled = !running;
    this.box.title = running && !lockstep ? "by the wall clock: only the console, Finish and Cut short" : "";
    setText(this.pauseButton, state.paused ? "Go on (space)" : "Pause (space)");
    const pressed = this.isActive(killFault);
    this.kill.setAttribute("aria-pressed", String(pressed));
    setText(this.kill, pressed ? "Release kill (K)" : "KILL (K)");
    this.stops.forEach((one, i) => {
      const held = this.isActive(stopFault(endStops[i]!));
      one.setAttribute("aria-pressed", String(held));
      setText(one, `${held ? "Release" : "Trip"} ${endStops[i]!.replace("_", " ")}`);
    });
    if (running && state.speed !== undefined && document.activeElement !== this.speed) {
      this.speed.value = String(state.speed);
    }
  }

  private isActive(words: string): boolean {
    return this.state?.active_faults?.includes(words) ?? false;
  }

  private toggle(words: string): void {
    this.send({ do: this.isActive(words) ? "clear" : "inject", fault: words });
  }

  private toggleKill(): void {
    this.toggle(killFault);
  }

  private toggleStop(name: string): void {
    this.toggle(stopFault(name));
  }

  private togglePause(): void {
    this.send({ do: this.state?.paused ? "resume" : "pause" });
  }

  private stepOnce(): void {
    this.send({ do: "step", ms: Number(this.step.value) });
  }

  private kinds(): FaultKind[] {
    const part = this.catalogue?.places.find((one) => one.name === this.place.value)?.part;
    return this.catalogue?.faults.filter((one) => one.part === part && one.refused === "") ?? [];
  }

  private showKinds(): void {
    setOptions(
      this.kind,
      this.kinds().map((one) => [one.kind, one.built_in ? `${one.kind} (before the start)` : one.kind]),
    );
    this.showParameters();
  }

  private showParameters(): void {
    const kind = this.kinds().find((one) => one.kind === this.kind.value);
    this.parameters.value = (kind?.parameters ?? []).map((one) => `${one.key}=${one.standard}`).join(" ");
    const ranges = (kind?.parameters ?? []).map((one) => `${one.key} ${one.min} to ${one.max}`).join("; ");
    this.meaning.textContent = kind === undefined ? "" : `${kind.kind}: ${kind.meaning}${ranges === "" ? "" : `; ${ranges}`}`;
  }

  private words(): string {
    return `${this.place.value} ${this.kind.value} ${this.parameters.value}`.trim();
  }

  private onKey(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    const typing = ["INPUT", "SELECT", "TEXTAREA"].includes(target.tagName);
    // On a button or a link, space is that one's.
    const own = event.key === " " && ["BUTTON", "A", "SUMMARY"].includes(target.tagName);
    const steerable = this.state?.phase === "running" && this.state.clock === "lockstep";
    if (typing || own || event.repeat || event.ctrlKey || event.metaKey || event.altKey || !steerable) return;
    const actions: Record<string, () => void> = {
      k: () => this.toggleKill(),
      " ": () => this.togglePause(),
      s: () => this.stepOnce(),
    };
    const action = actions[event.key.toLowerCase()];
    if (action === undefined) return;
    event.preventDefault();
    action();
  }
}

function stopFault(name: string): string {
  return `endstop.${name} stuck_closed`;
}
