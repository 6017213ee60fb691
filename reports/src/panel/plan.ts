// The machine from above: the load of one axis or two where it truly is, the reference as a ring, the
// drives' force and the force sensor's as arrows, end-stops and hard ends; a joint as a dial.
import { element, setText } from "../dom";
import { Arrow } from "./arrow";
import type { AxisLimits } from "./wire";

const svgNs = "http://www.w3.org/2000/svg";
const width = 640;
const margin = 12;
const radius = 110; // of a joint's dial

function shape(tag: string, attributes: Record<string, number | string>): SVGElement {
  const made = document.createElementNS(svgNs, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  return made;
}

export interface PlanPose {
  y_m: number;
  x_m: number;
  yReference_m: number;
  xReference_m: number;
  yForce_N: number;
  xForce_N: number;
  sensor_N: { y: number; x: number } | null; // null: the rig has none
  isTruth: boolean; // y and x; else where the controller takes the motor side to be
  lines: number; // by bit: end-stops at min and max of y, then of x
}

export class Plan {
  readonly box = element("figure");
  private readonly svg = document.createElementNS(svgNs, "svg");
  private scale = 1;
  private height = 100;
  private limits: { y: AxisLimits; x: AxisLimits } | null = null;
  private readonly arm = shape("line", { class: "arm" });
  private readonly beam = shape("rect", { class: "beam", width: 14 });
  private readonly effector = shape("circle", { class: "effector", r: 7 });
  private readonly aim = shape("circle", { class: "aim", r: 11 });
  private readonly transmission = new Arrow("force");
  private readonly sensor = new Arrow("force sensed", 28);
  private readonly caption = element("figcaption", "help");
  private halls: SVGElement[] = [];

  // `name`: of the axis that stands in the first's place where it is drawn alone.
  constructor(private readonly name = "y") {
    this.svg.setAttribute("class", "plan");
    this.svg.setAttribute("role", "img");
    this.svg.setAttribute("aria-label", "Where the machine is");
    this.box.append(this.svg, this.caption);
  }

  setLimits(limits: { y: AxisLimits; x: AxisLimits }): void {
    const key = JSON.stringify(limits);
    if (this.limits !== null && JSON.stringify(this.limits) === key) return;
    this.limits = limits;
    if (limits.y.turns) this.drawDial(limits.y);
    else this.draw(limits);
  }

  private right(y_m: number): number {
    return margin + (y_m - this.limits!.y.hard_min_m) * this.scale;
  }

  private down(x_m: number): number {
    if (!this.limits!.x.exists) return this.height / 2;
    return this.height - margin - (x_m - this.limits!.x.hard_min_m) * this.scale;
  }

  private draw(limits: { y: AxisLimits; x: AxisLimits }): void {
    const long = limits.y.hard_max_m - limits.y.hard_min_m || 1;
    const across = limits.x.exists ? limits.x.hard_max_m - limits.x.hard_min_m : long / 8;
    this.scale = (width - 2 * margin) / long;
    this.height = across * this.scale + 2 * margin;
    this.svg.setAttribute("viewBox", `0 0 ${width} ${this.height.toFixed(0)}`);
    const left = this.right(limits.y.hard_min_m);
    const right = this.right(limits.y.hard_max_m);
    const top = margin;
    const bottom = this.height - margin;
    const along = [limits.y.hall_min_m, limits.y.hall_max_m].map((at) => this.vertical("hall", at, top, bottom));
    const athwart = limits.x.exists ? [limits.x.hall_min_m, limits.x.hall_max_m] : [];
    this.halls = [...along, ...athwart.map((at) => this.horizontal("hall", at, left, right))];
    const soft = shape("rect", {
      class: "soft",
      x: this.right(limits.y.soft_min_m),
      y: limits.x.exists ? this.down(limits.x.soft_max_m) : top,
      width: Math.max(0, (limits.y.soft_max_m - limits.y.soft_min_m) * this.scale),
      height: limits.x.exists ? Math.max(0, (limits.x.soft_max_m - limits.x.soft_min_m) * this.scale) : bottom - top,
    });
    this.beam.setAttribute("y", String(top));
    this.beam.setAttribute("height", String(bottom - top));
    this.svg.replaceChildren(
      shape("rect", { class: "wall", x: left, y: top, width: right - left, height: bottom - top }),
      soft,
      ...this.halls,
      this.beam,
      this.aim,
      this.transmission.group,
      this.sensor.group,
      this.effector,
    );
  }

  // A joint: its arm hangs at 0 and turns to the right towards max.
  private drawDial(limits: AxisLimits): void {
    this.height = 2 * (radius + margin);
    this.svg.setAttribute("viewBox", `0 0 ${width} ${this.height}`);
    this.halls = [limits.hall_min_m, limits.hall_max_m].map((at) => this.spoke("hall", at));
    const ends = [limits.hard_min_m, limits.hard_max_m].map((at) => this.spoke("wall", at));
    const rim = shape("circle", { class: "wall", cx: width / 2, cy: this.height / 2, r: radius });
    this.svg.replaceChildren(rim, ...ends, ...this.halls, this.arm, this.aim, this.effector);
  }

  private tip(angle_rad: number): { x: number; y: number } {
    return { x: width / 2 + radius * Math.sin(angle_rad), y: this.height / 2 + radius * Math.cos(angle_rad) };
  }

  private spoke(name: string, angle_rad: number): SVGElement {
    const { x, y } = this.tip(angle_rad);
    return shape("line", { class: name, x1: width / 2, y1: this.height / 2, x2: x, y2: y });
  }

  private showDial(pose: PlanPose): void {
    const at = this.tip(pose.y_m);
    const wanted = this.tip(pose.yReference_m);
    this.arm.setAttribute("x1", String(width / 2));
    this.arm.setAttribute("y1", String(this.height / 2));
    this.arm.setAttribute("x2", String(at.x));
    this.arm.setAttribute("y2", String(at.y));
    for (const [mark, place] of [[this.effector, at], [this.aim, wanted]] as const) {
      mark.setAttribute("cx", String(place.x));
      mark.setAttribute("cy", String(place.y));
    }
    const degrees = ((pose.y_m * 180) / Math.PI).toFixed(1);
    const whose = pose.isTruth ? "truth" : "as the controller has it";
    setText(this.caption, `${this.name} at ${degrees}° (${whose}), 0 is down; ring: reference; dashed: end-stops; solid: hard ends`);
  }

  private vertical(name: string, y_m: number, top: number, bottom: number): SVGElement {
    const x = this.right(y_m);
    return shape("line", { class: name, x1: x, x2: x, y1: top, y2: bottom });
  }

  private horizontal(name: string, x_m: number, left: number, right: number): SVGElement {
    const y = this.down(x_m);
    return shape("line", { class: name, x1: left, x2: right, y1: y, y2: y });
  }

  show(pose: PlanPose): void {
    if (this.limits === null) return;
    this.halls.forEach((hall, bit) =>
      hall.setAttribute("class", (pose.lines >> bit) & 1 ? "hall tripped" : "hall"),
    );
    if (this.limits.y.turns) {
      this.showDial(pose);
      return;
    }
    const x = this.right(pose.y_m);
    const y = this.down(pose.x_m);
    this.beam.setAttribute("x", String(x - 7));
    this.effector.setAttribute("cx", String(x));
    this.effector.setAttribute("cy", String(y));
    this.aim.setAttribute("cx", String(this.right(pose.yReference_m)));
    this.aim.setAttribute("cy", String(this.down(pose.xReference_m)));
    this.transmission.show(x, y, pose.yForce_N, pose.xForce_N);
    this.sensor.show(x, y, pose.sensor_N?.y ?? 0, pose.sensor_N?.x ?? 0);
    setText(
      this.caption,
      (this.limits.x.exists ? "y right, x up; bar, dot: carriage, end-effector " : `${this.name} right; bar and dot: the load `) +
        (pose.isTruth ? "(truth)" : "(as the controller has it)") +
        "; ring: reference; arrow: drive's force" +
        (pose.sensor_N === null ? "" : "; dotted: sensor's") +
        "; dashed: end-stops; shaded: soft limits",
    );
  }
}
