// A run under way: everything that is seen of it and done to it.
import { element } from "../dom";
import { loadCatalogue } from "./catalogue";
import { ConsoleBox } from "./console_box";
import { EventList } from "./event_list";
import { labelled, select } from "./form";
import { Histogram } from "./histogram";
import { History } from "./history";
import { Lamps } from "./lamps";
import { Path } from "./path";
import { Plan } from "./plan";
import { Scope, type ScopeSpec } from "./scope";
import { StartForm } from "./start_form";
import { SteeringBar } from "./steering_bar";
import { type Frame, rowWidth, type State, truthWidth } from "./wire";

const shown_s = 20;

function difference(a: (number | null)[], b: (number | null)[]): (number | null)[] {
  return a.map((value, i) => (value === null || b[i] == null ? null : (value - b[i]!) * 1e3));
}

// Columns of an axis begin here (wire.ts).
function logSpecs(first: number): ScopeSpec[] {
  return [
    {
      title: "Position",
      unit: "m",
      lines: [
        { label: "reference", role: "reference", of: (c) => c[first]! },
        { label: "motor side", role: "measured", of: (c) => c[first + 1]! },
      ],
    },
    {
      title: "Tracking error, motor side",
      unit: "mm",
      lines: [{ label: "error", role: "measured", of: (c) => difference(c[first]!, c[first + 1]!) }],
    },
    {
      title: "Velocity",
      unit: "m/s",
      lines: [
        { label: "reference", role: "reference", of: (c) => c[first + 2]! },
        { label: "BBMC's estimate", role: "measured", of: (c) => c[first + 3]! },
      ],
    },
    { title: "Duty", unit: "%", lines: [{ label: "duty", role: "measured", of: (c) => c[first + 4]! }] },
  ];
}

function truthSpecs(first: number): ScopeSpec[] {
  return [
    { title: "Carriage speed (truth)", unit: "m/s", lines: [{ label: "speed", role: "truth", of: (c) => c[first + 1]! }] },
    { title: "Motor current (truth)", unit: "A", lines: [{ label: "current", role: "truth", of: (c) => c[first + 2]! }] },
    { title: "Chain force (truth)", unit: "N", lines: [{ label: "force", role: "truth", of: (c) => c[first + 3]! }] },
  ];
}

export class RunView {
  private readonly log = new History(rowWidth, shown_s);
  private readonly truth = new History(truthWidth, shown_s);
  private readonly plan = new Plan();
  private readonly path = new Path();
  private readonly histogram = new Histogram();
  private readonly lamps = new Lamps();
  private readonly console: ConsoleBox;
  private readonly events = new EventList();
  private readonly start: StartForm;
  private readonly bar: SteeringBar;
  private readonly trouble = element("p", "trouble");
  private readonly result = element("p", "note");
  private readonly scopesHost = element("div", "scopes");
  private readonly axis = select([
    ["y", "Y axis"],
    ["x", "X axis"],
  ]);
  private logScopes: Scope[] = [];
  private truthScopes: Scope[] = [];
  private number = 0;
  private missed = 0;
  private state: State | null = null;
  private drawing = false;

  constructor(host: HTMLElement, send: (message: Record<string, unknown>) => void, onRefused: (why: string) => void) {
    this.start = new StartForm((message) => {
      this.tell("");
      send(message);
    });
    this.bar = new SteeringBar((message) => {
      this.tell("");
      send(message);
    });
    this.console = new ConsoleBox((text) => send({ do: "type", text }));
    this.trouble.setAttribute("role", "alert");
    this.trouble.hidden = true;
    this.result.id = "result";
    const help = element("p", "help", "Keys, outside of fields: K presses and releases the kill switch, space pauses, S steps.");
    const left = element("div", "column");
    left.append(this.card("Tank", this.plan.svg), this.card("State", this.lamps.list), this.console.box, this.events.box);
    const scopes = element("section", "card");
    scopes.append(labelled(`Last ${shown_s} s of virtual time`, this.axis), this.scopesHost);
    const right = element("div", "column");
    right.append(scopes, this.card("", this.path.box), this.card("", this.histogram.box));
    const desk = element("div", "desk");
    desk.append(left, right);
    host.append(this.start.box, this.bar.box, this.trouble, this.result, desk, help);
    this.axis.addEventListener("change", () => this.makeScopes());
    this.makeScopes();
    loadCatalogue().then(
      (catalogue) => {
        this.start.setCatalogue(catalogue);
        this.bar.setCatalogue(catalogue);
        document.documentElement.dataset.panel = "ready";
      },
      (error) => onRefused(String(error)),
    );
  }

  tell(why: string): void {
    this.trouble.textContent = why;
    this.trouble.hidden = why === "";
  }

  addMissed(frames: number): void {
    this.missed += frames;
  }

  take(frame: Frame): void {
    if (frame.state.number !== this.number) this.beginRun(frame.state.number);
    this.state = frame.state;
    this.log.add(frame.rows);
    this.truth.add(frame.truth);
    this.console.add(frame.console);
    this.events.add(frame.events);
    if (frame.state.trouble) this.tell(frame.state.trouble);
    if (!this.drawing) {
      this.drawing = true;
      requestAnimationFrame(() => this.draw());
    }
  }

  private beginRun(number: number): void {
    this.number = number;
    this.missed = 0;
    this.log.clear();
    this.truth.clear();
    this.console.clear();
    this.events.clear();
  }

  private draw(): void {
    this.drawing = false;
    const state = this.state;
    if (state === null) return;
    const row = this.log.last;
    const truth = this.truth.last;
    this.bar.show(state);
    this.lamps.show(state, row, truth, this.missed);
    if (state.limits !== undefined) this.plan.setLimits(state.limits);
    if (row !== null && truth !== null) {
      this.plan.show({
        y_m: truth[1] ?? 0,
        x_m: truth[5] ?? 0,
        yReference_m: row[1] ?? 0,
        xReference_m: row[7] ?? 0,
        yForce_N: truth[4] ?? 0,
        xForce_N: truth[8] ?? 0,
        lines: truth[9] ?? 0,
      });
    }
    for (const scope of this.logScopes) scope.show(this.log.columns);
    for (const scope of this.truthScopes) scope.show(this.truth.columns);
    this.path.show(this.log.columns, 1, 2, 7, 8);
    if (state.exchange_us_bins !== undefined) this.histogram.show(state.exchange_us_bins);
    this.showResult(state);
  }

  private showResult(state: State): void {
    if (state.phase !== "over") {
      this.result.textContent = state.phase === "judging" ? "judging and writing the report" : "";
      return;
    }
    if (this.result.dataset.of === `${state.number}`) return;
    const verdict = state.verdict === "" ? "no verdict" : state.verdict;
    const words = `${state.name}: ${verdict}${state.reason === "" ? "" : ` (${state.reason})`} `;
    this.result.dataset.of = `${state.number}`;
    const link = element("a", "", "open the report");
    link.href = `#folders/${state.folder}`;
    this.result.replaceChildren(element("strong", "", words), ...(state.folder === "" ? [] : [link]));
  }

  private makeScopes(): void {
    const y = this.axis.value === "y";
    this.logScopes = logSpecs(y ? 1 : 7).map((spec) => new Scope(spec));
    this.truthScopes = truthSpecs(y ? 1 : 5).map((spec) => new Scope(spec));
    this.scopesHost.replaceChildren(...[...this.logScopes, ...this.truthScopes].map((scope) => scope.box));
    if (this.state !== null) this.draw();
  }

  private card(title: string, content: Element): HTMLElement {
    const card = element("section", "card");
    if (title !== "") card.append(element("h2", "", title));
    card.append(content);
    return card;
  }
}
