// What the scopes of one axis show.
import type { LineRole } from "../theme";
import type { Line, ScopeSpec } from "./scope";
import { type AxisName, type Estimator, logColumns, truthColumns } from "./wire";

type Columns = ReturnType<typeof logColumns>;

// In thousandths of the unit.
function difference(a: (number | null)[], b: (number | null)[]): (number | null)[] {
  return a.map((value, i) => (value === null || b[i] == null ? null : (value - b[i]!) * 1e3));
}

// Positions from where the controller's zero was last set: those before are in another frame.
function inThisFrame(columns: (number | null)[][], at: number): (number | null)[] {
  const jump_m = 0.02; // in a tick: 20 m/s at 1 kHz
  const values = columns[at]!;
  for (let i = values.length - 1; i > 0; --i) {
    const [before, after] = [values[i - 1], values[i]];
    if (before != null && after != null && Math.abs(after - before) > jump_m) return values.map((value, j) => (j < i ? null : value));
  }
  return values;
}

// The one that the control law follows is drawn solid, the others by its side.
function estimates(axis: AxisName, followed: Estimator, shown: (at: Columns, estimator: Estimator) => Line["of"]): Line[] {
  const at = logColumns(axis);
  const others: LineRole[] = ["second", "third"];
  const all: Estimator[] = ["frequency", "period", "hybrid"];
  return all.map((estimator) => ({
    label: estimator === followed ? `${estimator} (followed)` : estimator,
    role: estimator === followed ? "measured" : others.shift()!,
    of: shown(at, estimator),
  }));
}

const itself = (at: Columns, estimator: Estimator): Line["of"] => (c) => c[at[estimator]]!;
const lessReference = (at: Columns, estimator: Estimator): Line["of"] => (c) => difference(c[at[estimator]]!, c[at.referenceSpeed]!);

export function logSpecs(axis: AxisName, followed: Estimator, hasForce: boolean, turns: boolean): ScopeSpec[] {
  const at = logColumns(axis);
  const length = turns ? "rad" : "m";
  const force: ScopeSpec = {
    title: "Force sensor (measured)",
    unit: "N",
    lines: [{ label: "force", role: "measured", of: (c) => c[at.force]! }],
  };
  return [
    {
      title: "Position",
      unit: length,
      lines: [
        { label: "reference", role: "reference", of: (c) => inThisFrame(c, at.reference) },
        { label: "motor side", role: "measured", of: (c) => inThisFrame(c, at.position) },
      ],
    },
    {
      title: "Tracking error, motor side",
      unit: `m${length}`,
      lines: [{ label: "error", role: "measured", of: (c) => difference(c[at.reference]!, c[at.position]!) }],
    },
    {
      title: "Velocity, by each estimator",
      unit: `${length}/s`,
      lines: [{ label: "reference", role: "reference", of: (c) => c[at.referenceSpeed]! }, ...estimates(axis, followed, itself)],
    },
    { title: "Velocity less reference", unit: `m${length}/s`, lines: estimates(axis, followed, lessReference) },
    { title: "Duty", unit: "%", lines: [{ label: "duty", role: "measured", of: (c) => c[at.duty]! }] },
    ...(hasForce && (axis === "y" || axis === "x") ? [force] : []),
  ];
}

export function truthSpecs(axis: AxisName, turns: boolean): ScopeSpec[] {
  const at = truthColumns(axis);
  return [
    { title: "Load speed (truth)", unit: turns ? "rad/s" : "m/s", lines: [{ label: "speed", role: "truth", of: (c) => c[at.speed]! }] },
    { title: "Motor current (truth)", unit: "A", lines: [{ label: "current", role: "truth", of: (c) => c[at.current]! }] },
    turns
      ? { title: "Torque on the load (truth)", unit: "N m", lines: [{ label: "torque", role: "truth", of: (c) => c[at.force]! }] }
      : { title: "Force on the load (truth)", unit: "N", lines: [{ label: "force", role: "truth", of: (c) => c[at.force]! }] },
  ];
}
