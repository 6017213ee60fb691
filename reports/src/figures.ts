// Which plots a run has, from the columns that its table has. No drawing here.
import { type AxisLimits, extentOf, type RunData, type Table } from "./data";
import type { LineRole } from "./theme";
import { unitOfColumn } from "./units";

export interface Curve {
  label: string;
  role: LineRole;
  values: Float64Array;
}

export interface Figure {
  id: string;
  title: string;
  unit: string; // SI, or "%", or "" for a count
  axis: string; // "y" or another axis, or "": whose events and states it shows
  curves: Curve[];
  held: boolean; // a value holds until the next: drawn in steps where single ticks can be told apart
  zero: boolean; // zero belongs to the scale
  showLargest: boolean;
  guides: { value: number; label: string }[]; // SI
  empty: string; // said instead of a plot when no curve has a value
}

type Wanted = [column: string, label: string, role: LineRole];

function curves(table: Table, axis: string, wanted: Wanted[]): Curve[] {
  return wanted.flatMap(([column, label, role]) => {
    const values = table.columns.get(`${axis}_${column}`);
    return values === undefined ? [] : [{ label, role, values }];
  });
}

// Limits are drawn where the carriage came near them; elsewhere they would only flatten the curves.
function limitGuides(limits: AxisLimits | undefined, drawn: Curve[]): Figure["guides"] {
  const named: [number | undefined, string][] = [
    [limits?.hall_min_m, "end-stop switch (min)"],
    [limits?.hall_max_m, "end-stop switch (max)"],
    [limits?.hard_min_m, "hard end (min)"],
    [limits?.hard_max_m, "hard end (max)"],
  ];
  const extents = drawn.flatMap((curve) => extentOf(curve.values) ?? []);
  if (extents.length === 0) return [];
  const low = Math.min(...extents.map((e) => e.min));
  const high = Math.max(...extents.map((e) => e.max));
  const near = Math.max((high - low) / 10, 0.02);
  return named.flatMap(([value, label]) =>
    typeof value === "number" && value > low - near && value < high + near
      ? [{ value, label }]
      : [],
  );
}

export function axisFigures(run: RunData, axis: string): Figure[] {
  const { table } = run;
  const length = run.limits[axis]?.turns ? "rad" : "m";
  const plain = { axis, held: false, zero: false, showLargest: false, guides: [], empty: "" };
  const position = curves(table, axis, [
    ["carriage_m", "carriage (truth)", "truth"],
    ["position_m", "motor side", "measured"],
    ["reference_m", "reference", "reference"],
  ]);
  const carriage = curves(table, axis, [["carriage_m", "carriage (truth)", "truth"]]);
  const camera = curves(table, axis, [["camera_m", "camera", "measured"]]);
  const figures: Figure[] = [
    {
      ...plain,
      id: `${axis}-position`,
      title: "Reference and position",
      unit: length,
      curves: position,
      guides: limitGuides(run.limits[axis], position),
    },
    {
      ...plain,
      id: `${axis}-error`,
      title: "Tracking error",
      unit: length,
      zero: true,
      showLargest: true,
      empty: "No tracking error: the axis never followed a reference in this run.",
      curves: curves(table, axis, [
        ["carriage_error_m", "carriage side (truth)", "truth"],
        ["error_m", "motor side", "measured"],
      ]),
    },
    {
      ...plain,
      id: `${axis}-velocity`,
      title: "Velocity",
      unit: `${length}/s`,
      zero: true,
      curves: curves(table, axis, [
        ["carriage_speed_m_per_s", "carriage (truth)", "truth"],
        ["velocity_m_per_s", "estimate", "measured"],
        ["reference_velocity_m_per_s", "reference", "reference"],
      ]),
    },
    {
      ...plain,
      id: `${axis}-duty`,
      title: "Duty",
      unit: "%",
      held: true,
      zero: true,
      curves: curves(table, axis, [["duty_pct", "duty", "measured"]]),
    },
    {
      ...plain,
      id: `${axis}-current`,
      title: "Motor current",
      unit: "A",
      zero: true,
      curves: curves(table, axis, [["current_A", "amplifier's monitor", "measured"]]),
    },
    {
      ...plain,
      id: `${axis}-camera`,
      title: "Carriage by the camera, when its frame arrives",
      unit: length,
      held: true,
      curves: camera.length > 0 ? [...carriage, ...camera] : [],
    },
    {
      ...plain,
      id: `${axis}-edges`,
      title: "Encoder edges per tick",
      unit: "",
      held: true,
      zero: true,
      curves: curves(table, axis, [["edges", "A and B edges", "measured"]]),
    },
  ];
  return figures.filter((figure) => figure.curves.length > 0);
}

// Every other column, one plot each: those of a force sensor, say.
export function otherFigures(run: RunData): Figure[] {
  const known = /^(time_s|fault|[yxzabc]_.*)$/;
  return [...run.table.columns]
    .filter(([name]) => !known.test(name))
    .map(([name, values]) => ({
      id: name,
      title: name.replace(/_/g, " "),
      unit: unitOfColumn(name),
      axis: "",
      curves: [{ label: name, role: "measured" as const, values }],
      held: false,
      zero: true,
      showLargest: false,
      guides: [],
      empty: `${name} holds no value in this run.`,
    }));
}

// An axis that neither moved nor was driven nor asked to move.
export function stoodStill(table: Table, axis: string): boolean {
  const flat = (column: string) => {
    const values = table.columns.get(`${axis}_${column}`);
    const extent = values === undefined ? null : extentOf(values);
    return extent === null || extent.min === extent.max;
  };
  const duty = table.columns.get(`${axis}_duty_pct`);
  const driven = duty !== undefined && duty.some((value) => value !== 0 && !Number.isNaN(value));
  return flat("position_m") && flat("reference_m") && flat("carriage_m") && !driven;
}
