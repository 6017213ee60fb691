// The tank from above: carriage and end-effector where they truly are, the reference as a ring, the
// chains' force and the force sensor's as arrows, end-stops and hard ends.
import { element, setText } from "../dom";
import { Arrow } from "./arrow";
import type { AxisLimits } from "./wire";

const svgNs = "http://www.w3.org/2000/svg";
const width = 640;
const margin = 12;

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
  lines: number; // hall Y min, Y max, X min, X max by bit
}

export class Plan {
  readonly box = element("figure");
  private readonly svg = document.createElementNS(svgNs, "svg");
  private scale = 1;
  private height = 100;
  private limits: { y: AxisLimits; x: AxisLimits } | null = null;
  private readonly beam = shape("rect", { class: "beam", width: 14 });
  private readonly effector = shape("circle", { class: "effector", r: 7 });
  private readonly aim = shape("circle", { class: "aim", r: 11 });
  private readonly chain = new Arrow("force");
  private readonly sensor = new Arrow("force sensed", 28);
  private readonly caption = element("figcaption", "help");
  private halls: SVGElement[] = [];

  constructor() {
    this.svg.setAttribute("class", "plan");
    this.svg.setAttribute("role", "img");
    this.svg.setAttribute("aria-label", "Plan view of the tank");
    this.box.append(this.svg, this.caption);
  }

  setLimits(limits: { y: AxisLimits; x: AxisLimits }): void {
    const key = JSON.stringify(limits);
    if (this.limits !== null && JSON.stringify(this.limits) === key) return;
    this.limits = limits;
    this.draw(limits);
  }

  private right(y_m: number): number {
    return margin + (y_m - this.limits!.y.hard_min_m) * this.scale;
  }

  private down(x_m: number): number {
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
    this.halls = [
      this.vertical("hall", limits.y.hall_min_m, top, bottom),
      this.vertical("hall", limits.y.hall_max_m, top, bottom),
      this.horizontal("hall", limits.x.hall_min_m, left, right),
      this.horizontal("hall", limits.x.hall_max_m, left, right),
    ];
    const soft = shape("rect", {
      class: "soft",
      x: this.right(limits.y.soft_min_m),
      y: this.down(limits.x.soft_max_m),
      width: Math.max(0, (limits.y.soft_max_m - limits.y.soft_min_m) * this.scale),
      height: Math.max(0, (limits.x.soft_max_m - limits.x.soft_min_m) * this.scale),
    });
    this.beam.setAttribute("y", String(top));
    this.beam.setAttribute("height", String(bottom - top));
    this.svg.replaceChildren(
      shape("rect", { class: "wall", x: left, y: top, width: right - left, height: bottom - top }),
      soft,
      ...this.halls,
      this.beam,
      this.aim,
      this.chain.group,
      this.sensor.group,
      this.effector,
    );
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
    const x = this.right(pose.y_m);
    const y = this.down(pose.x_m);
    this.beam.setAttribute("x", String(x - 7));
    this.effector.setAttribute("cx", String(x));
    this.effector.setAttribute("cy", String(y));
    this.aim.setAttribute("cx", String(this.right(pose.yReference_m)));
    this.aim.setAttribute("cy", String(this.down(pose.xReference_m)));
    this.chain.show(x, y, pose.yForce_N, pose.xForce_N);
    this.sensor.show(x, y, pose.sensor_N?.y ?? 0, pose.sensor_N?.x ?? 0);
    setText(
      this.caption,
      "Y right, X up; bar, dot: carriage, end-effector " +
        (pose.isTruth ? "(truth)" : "(as the controller has it)") +
        "; ring: reference; arrow: chains' force" +
        (pose.sensor_N === null ? "" : "; dotted: sensor's") +
        "; dashed: end-stops; shaded: soft limits",
    );
    this.halls.forEach((hall, bit) =>
      hall.setAttribute("class", (pose.lines >> bit) & 1 ? "hall tripped" : "hall"),
    );
  }
}
