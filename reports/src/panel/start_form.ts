// Choosing an experiment, and changing it before it starts.
import { element } from "../dom";
import { type Catalogue, type ExperimentEntry, rangesOf } from "./catalogue";
import { button, checkbox, labelled, select, setOptions, textField } from "./form";

export class StartForm {
  readonly box = element("section");
  private readonly choice = select([]);
  private readonly clock = select([
    ["lockstep", "lockstep"],
    ["real", "wall clock, two processes"],
  ]);
  private readonly speed = speedSelect();
  private readonly go = button("Start", () => this.submit(), "primary");
  private readonly about = element("p", "note");
  private readonly lines = element("div", "script-lines");
  private readonly faults = textField();
  private readonly seed = textField();
  private readonly limit = textField();
  private readonly paused = checkbox("begin paused");
  private readonly hold = checkbox("go on after the script, until finished by hand");
  private catalogue: Catalogue | null = null;

  constructor(private readonly start: (message: Record<string, unknown>) => void) {
    this.go.id = "start";
    this.choice.id = "experiment";
    this.speed.id = "start-speed";
    this.clock.id = "start-clock";
    this.choice.addEventListener("change", () => this.show());
    // A clock that does not wait cannot be paused, and faults are judged beside a reference run of the same bits.
    this.clock.addEventListener("change", () => {
      for (const field of [this.speed, this.paused.box, this.faults]) field.disabled = this.isReal();
    });
    const row = element("div", "bar-row");
    row.append(labelled("Experiment", this.choice), labelled("Clock", this.clock), labelled("Speed", this.speed), this.paused.row, this.hold.row, this.go);
    const options = element("details", "options");
    options.append(
      element("summary", "", "What is typed, faults, seed, time limit"),
      this.lines,
      this.row("Faults, separated by ; (as on the command line, e.g. encoder.y frozen at=2s)", this.faults),
      this.row("Seed", this.seed),
      this.row("Time limit, s", this.limit),
    );
    this.box.append(row, this.about, options);
  }

  setCatalogue(catalogue: Catalogue): void {
    this.catalogue = catalogue;
    setOptions(this.choice, catalogue.experiments.map((one) => [one.name, one.own ? `${one.name} (your file)` : one.name]));
    if (catalogue.experiments.length === 0) this.about.textContent = "There is no experiment: start the panel where fixtures/ or your own experiment files are.";
    const circle = catalogue.experiments.find((one) => one.name === "circle");
    if (circle !== undefined) this.choice.value = circle.name;
    this.show();
  }

  private row(label: string, field: HTMLInputElement): HTMLElement {
    const row = labelled(label, field);
    row.style.marginBottom = "0.4rem";
    return row;
  }

  private chosen(): ExperimentEntry | undefined {
    return this.catalogue?.experiments.find((one) => one.name === this.choice.value);
  }

  private show(): void {
    const entry = this.chosen();
    if (entry === undefined) return;
    const follows = entry.controller ? ` Controller: ${entry.controller}` : "";
    this.about.textContent = entry.trouble ?? `${entry.title}. ${entry.description}${follows}`;
    this.about.classList.toggle("trouble", entry.trouble !== undefined);
    this.go.disabled = entry.trouble !== undefined;
    this.seed.value = String(entry.seed ?? "");
    this.limit.value = String(entry.duration_limit_s ?? "");
    this.lines.replaceChildren(
      ...(entry.lines ?? []).map((line, i) => {
        const box = element("div");
        const field = textField(line);
        field.dataset.index = String(i);
        const ranges = rangesOf(line, this.catalogue!.commands);
        box.append(labelled(`Line ${i + 1}`, field), element("p", "ranges", ranges));
        return box;
      }),
    );
  }

  private isReal(): boolean {
    return this.clock.value === "real";
  }

  private submit(): void {
    const entry = this.chosen();
    if (entry === undefined) return;
    const changed: [number, string][] = [];
    for (const field of this.lines.querySelectorAll<HTMLInputElement>("input")) {
      const index = Number(field.dataset.index);
      if (field.value !== entry.lines[index]) changed.push([index, field.value]);
    }
    const message: Record<string, unknown> = {
      do: "start",
      experiment: entry.name,
      clock: this.clock.value,
      speed: this.isReal() ? 1 : Number(this.speed.value),
      paused: !this.isReal() && this.paused.box.checked,
      hold: this.hold.box.checked,
      lines: changed,
      faults: (this.isReal() ? "" : this.faults.value).split(";").map((words) => words.trim()).filter((words) => words !== ""),
    };
    if (Number(this.seed.value) !== entry.seed) message.seed = Number(this.seed.value);
    if (Number(this.limit.value) !== entry.duration_limit_s) message.duration_limit_s = Number(this.limit.value);
    this.start(message);
    // Space is to pause what has just begun, not to start it again.
    (document.activeElement as HTMLElement | null)?.blur();
  }
}

export function speedSelect(): HTMLSelectElement {
  const field = select([
    ["0.01", "1 % (slow motion)"],
    ["0.1", "10 % (slow motion)"],
    ["1", "real time"],
    ["10", "10 times"],
    ["0", "as fast as it goes"],
  ]);
  field.value = "1";
  return field;
}
