// A run under way: everything that is seen of it and done to it.
import { element } from "../dom";
import { loadCatalogue } from "./catalogue";
import { ConsoleBox } from "./console_box";
import { EventList } from "./event_list";
import { labelled, select, setOptions } from "./form";
import { Histogram } from "./histogram";
import { History } from "./history";
import { Lamps } from "./lamps";
import { Path } from "./path";
import { Plan } from "./plan";
import { Scope } from "./scope";
import { logSpecs, truthSpecs } from "./scope_specs";
import { StartForm } from "./start_form";
import { SteeringBar } from "./steering_bar";
import { type AxisName, axisNames, endStopBit, type Frame, furtherAxes, type Limits, linesColumn, logColumns, rowWidth, type State, truthColumns, truthWidth } from "./wire";

const shown_s = 20; // harness/panel/frames.h sends no more
const stale_s = 0.1; // truth that is older than this does not say where the carriage is now
const patience_ms = 500; // for the browser to draw
const y = logColumns("y");
const x = logColumns("x");
const trueY = truthColumns("y");
const trueX = truthColumns("x");

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
  private readonly result = element("div", "note");
  private readonly scopesHost = element("div", "scopes");
  private readonly axis = select([]);
  private axes = ""; // that it offers
  private readonly plans = element("div");
  private readonly furtherPlans = new Map<AxisName, Plan>();
  private logScopes: Scope[] = [];
  private truthScopes: Scope[] = [];
  private scopesOf = ""; // what they were made for
  private number = 0;
  private missed = 0;
  private state: State | null = null;
  private drawing = false; // with the screen's next picture

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
    left.append(this.card("Machine", this.plans), this.card("State", this.lamps.list), this.console.box, this.events.box);
    const scopes = element("section", "card");
    scopes.append(labelled(`Last ${shown_s} s of virtual time`, this.axis), this.scopesHost);
    const right = element("div", "column");
    right.append(scopes, this.card("", this.path.box), this.card("", this.histogram.box));
    const desk = element("div", "desk");
    desk.append(left, right);
    host.append(this.start.box, this.bar.box, this.trouble, this.result, desk, help);
    this.axis.addEventListener("change", () => this.draw());
    this.plans.append(this.plan.box);
    this.showAxes(["y", "x"]);
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
    if (this.drawing) return;
    this.drawing = true;
    // A browser does not draw a page in the background: it is updated without an animation frame then.
    const late = setTimeout(() => draw(), patience_ms);
    const draw = () => {
      if (!this.drawing) return;
      clearTimeout(late);
      this.drawing = false;
      this.draw();
    };
    requestAnimationFrame(draw);
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
    const state = this.state;
    if (state === null) return;
    const row = this.log.last;
    const truth = this.truth.last;
    this.result.dataset.run = `${this.number}`; // the run that is shown
    this.bar.show(state);
    this.lamps.show(state, row, truth, this.missed);
    if (state.limits !== undefined) this.setLimits(state.limits);
    if (row !== null) this.showPlan(row, truth);
    this.makeScopes();
    for (const scope of this.logScopes) scope.show(this.log.columns);
    for (const scope of this.truthScopes) scope.show(this.truth.columns);
    this.path.show(this.log.columns, y.reference, y.position, x.reference, x.position);
    if (state.exchange_us_bins !== undefined) this.histogram.show(state.exchange_us_bins, state.clock);
    this.showResult(state);
  }

  private setLimits(limits: Limits): void {
    this.plan.box.hidden = !limits.y.exists && !limits.x.exists;
    this.plan.setLimits(limits);
    for (const axis of furtherAxes) {
      const own = limits[axis];
      let plan = this.furtherPlans.get(axis);
      if (own !== undefined && plan === undefined) {
        plan = new Plan(axis);
        this.furtherPlans.set(axis, plan);
        this.plans.append(plan.box);
      }
      if (plan !== undefined) plan.box.hidden = own === undefined;
      if (own !== undefined) plan?.setLimits({ y: own, x: { ...own, exists: false } });
    }
    this.showAxes(axisNames.filter((axis) => limits[axis]?.exists));
  }

  private showAxes(axes: AxisName[]): void {
    if (axes.join("") === this.axes) return;
    const before = this.axis.value as AxisName;
    this.axes = axes.join("");
    setOptions(this.axis, axes.map((axis) => [axis, `axis ${axis}`]));
    if (axes.includes(before)) this.axis.value = before;
  }

  private showFurtherPlans(row: (number | null)[], truth: (number | null)[] | null, isTruth: boolean): void {
    for (const [axis, plan] of this.furtherPlans) {
      const at = logColumns(axis);
      const trueAt = truthColumns(axis);
      plan.show({
        y_m: (isTruth ? truth?.[trueAt.position] : row[at.position]) ?? 0,
        x_m: 0,
        yReference_m: row[at.reference] ?? 0,
        xReference_m: 0,
        yForce_N: truth?.[trueAt.force] ?? 0,
        xForce_N: 0,
        sensor_N: null,
        isTruth,
        lines: ((truth?.[linesColumn] ?? 0) >> endStopBit(axis)) & 3,
      });
    }
  }

  private showPlan(row: (number | null)[], truth: (number | null)[] | null): void {
    const isTruth = truth !== null && (truth[0] ?? 0) > (row[0] ?? 0) - stale_s;
    this.showFurtherPlans(row, truth, isTruth);
    const force = [row[y.force], row[x.force]];
    this.plan.show({
      y_m: (isTruth ? truth[trueY.position] : row[y.position]) ?? 0,
      x_m: (isTruth ? truth[trueX.position] : row[x.position]) ?? 0,
      yReference_m: row[y.reference] ?? 0,
      xReference_m: row[x.reference] ?? 0,
      yForce_N: truth?.[trueY.force] ?? 0,
      xForce_N: truth?.[trueX.force] ?? 0,
      sensor_N: force[0] == null || force[1] == null ? null : { y: force[0], x: force[1] },
      isTruth,
      lines: truth?.[linesColumn] ?? 0,
    });
  }

  private showResult(state: State): void {
    if (state.phase !== "over") {
      this.result.textContent = state.phase === "judging" ? "judging and writing the report" : "";
      return;
    }
    if (this.result.dataset.of === `${state.number}`) return;
    const verdict = state.verdict === "" ? "no verdict" : state.verdict;
    const words = `${state.name}${state.reason === "" ? "" : `: ${state.reason}`} `;
    const timing = state.timing === "" ? [] : [element("pre", "timing", state.timing.trimEnd())];
    this.result.dataset.of = `${state.number}`;
    const link = element("a", "", "open the report");
    link.href = `#folders/${state.folder}`;
    const box = element("div", `verdict ${verdict === "PASS" || verdict === "FAIL" ? verdict.toLowerCase() : "invalid"}`);
    const said = element("p", "", words);
    if (state.folder !== "") said.append(link);
    box.append(element("p", "word", verdict), said);
    this.result.replaceChildren(box, ...timing);
  }

  private makeScopes(): void {
    const axis = this.axis.value as AxisName;
    const followed = this.state?.followed?.[axis] ?? "hybrid";
    const hasForce = this.log.last?.[y.force] != null;
    const turns = this.state?.limits?.[axis]?.turns ?? false;
    const wanted = `${axis} ${followed} ${hasForce} ${turns}`;
    if (wanted === this.scopesOf) return;
    this.scopesOf = wanted;
    this.logScopes = logSpecs(axis, followed, hasForce, turns).map((spec) => new Scope(spec));
    this.truthScopes = truthSpecs(axis, turns).map((spec) => new Scope(spec));
    this.scopesHost.replaceChildren(...[...this.logScopes, ...this.truthScopes].map((scope) => scope.box));
  }

  private card(title: string, content: Element): HTMLElement {
    const card = element("section", "card");
    if (title !== "") card.append(element("h2", "", title));
    card.append(content);
    return card;
  }
}
