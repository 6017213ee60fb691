// diagnosis.json (schema towbench/diagnosis/1) as `towbench diagnose` writes it.

export interface Sized {
  value: number;
  ci95?: [number, number] | null;
  ci99?: [number, number] | null;
}

export interface Cause {
  effect: string;
  axis: string;
  meaning: string;
  parameters: Record<string, Sized>;
  p_value: number | null;
  gain_heldout_pct: Sized | null;
  indistinguishable_from: string[];
  separating_experiment: { motion: string; separates_from: string } | null;
}

export interface Side {
  force_error_rms_N: number;
  relative_force_error_pct: number;
}

export interface Diagnosis {
  schema: string;
  verdict: string[];
  findings: { name: string; fatal: boolean; sentence: string }[];
  causes?: Cause[];
  parameters?: Record<string, Sized & { unit: string; supplied: number; indistinguishable_from: string[] }>;
  unexplained?: { coordinate: string; share_of_residual_pct: number; rms_N: number; p_value: number } | null;
  not_testable?: { effect: string; why: string; needs: string }[];
  rejected?: { effect: string; p_value: number; gain_heldout_pct: Sized }[];
  heldout?: { baseline: Side; extended: Side; gain_pct: Sized; same_session: boolean };
}

export const knownSchema = "towbench/diagnosis/1";
