// SI in the data, convenient units on the axes. The same steps as harness/report/quantity.cc.

export interface DisplayUnit {
  name: string;
  perSi: number;
}

const choices: Record<string, [from: number, name: string, perSi: number][]> = {
  m: [
    [10, "m", 1],
    [1e-3, "mm", 1e3],
    [0, "µm", 1e6],
  ],
  rad: [
    [0.1, "rad", 1],
    [0, "mrad", 1e3],
  ],
  "m/s": [
    [10, "m/s", 1],
    [1e-3, "mm/s", 1e3],
    [0, "µm/s", 1e6],
  ],
};

export function displayUnit(unitSi: string, largest: number): DisplayUnit {
  for (const [from, name, perSi] of choices[unitSi] ?? []) {
    if (largest >= from) return { name, perSi };
  }
  return { name: unitSi, perSi: 1 };
}

// Four significant digits, a true minus sign, no trailing noise.
export function readable(value: number): string {
  const magnitude = Math.abs(value);
  if (!Number.isFinite(value)) return "none";
  if (magnitude === 0) return "0";
  if (magnitude < 1e-4 || magnitude >= 1e9) return value.toExponential(3);
  const decimals = Math.min(8, Math.max(0, 3 - Math.floor(Math.log10(magnitude))));
  const text = magnitude.toFixed(decimals);
  const trimmed = text.includes(".") ? text.replace(/0+$/, "").replace(/\.$/, "") : text;
  return (value < 0 ? "−" : "") + trimmed;
}

// An axis tick: a round number, which only needs to be freed of binary dust.
export function tickText(value: number): string {
  return String(+value.toFixed(6)).replace("-", "−");
}

export function readableWithUnit(value: number, unit: DisplayUnit): string {
  return unit.name === "" ? readable(value) : `${readable(value)}\u00a0${unit.name}`;
}

// "force_x_N" is in N: the unit is the name's last part.
export function unitOfColumn(name: string): string {
  const units: [suffix: string, unit: string][] = [
    ["_m_per_s", "m/s"],
    ["_rad_per_s", "rad/s"],
    ["_pct", "%"],
    ["_Nm", "N m"],
    ["_Hz", "Hz"],
    ["_rad", "rad"],
    ["_m", "m"],
    ["_N", "N"],
    ["_A", "A"],
    ["_V", "V"],
    ["_s", "s"],
  ];
  return units.find(([suffix]) => name.endsWith(suffix))?.[1] ?? "";
}
