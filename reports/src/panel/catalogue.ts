// What there is to choose from: experiments, faults, and BBMC's commands with their ranges.

export interface CommandOption {
  name: string;
  kind: string;
  meaning: string;
  range: { min?: number; max?: number };
  unit?: string;
  choices?: string;
}

export interface Command {
  word: string;
  sub: string;
  meaning: string;
  options?: CommandOption[];
}

export interface FaultKind {
  part: string;
  kind: string;
  meaning: string;
  built_in: boolean;
  refused: string;
  parameters: { key: string; standard: number; min: number; max: number }[];
}

export interface ExperimentEntry {
  name: string;
  title: string;
  description: string;
  duration_limit_s: number;
  seed: number;
  budgets: number;
  lines: string[];
  trouble?: string;
  own?: boolean; // a file of the working folder, named by its path
  controller?: string; // who follows the reference that it states; BBMC has none
}

export interface Catalogue {
  experiments: ExperimentEntry[];
  faults: FaultKind[];
  places: { name: string; part: string }[];
  commands: Command[];
}

export interface Folder {
  name: string;
  kind: "run" | "campaign" | "diagnosis";
  experiment?: string;
  title?: string;
  status?: string;
  verdict?: string;
  started_utc?: string;
  results?: string[]; // of a campaign: the files of its cases
  kept?: boolean; // of a campaign: whether it kept runs
  headline?: boolean; // of a diagnosis: whether headline.txt is there
  report?: boolean; // of a diagnosis: whether report.html is there
}

async function get(path: string): Promise<Response> {
  const response = await fetch(path, { credentials: "same-origin" });
  if (!response.ok) throw new Error(`${path}: ${response.status} ${await response.text()}`);
  return response;
}

export const loadCatalogue = async (): Promise<Catalogue> => (await get("/api/catalogue")).json();
export const loadFolders = async (): Promise<Folder[]> => (await get("/api/folders")).json();
export const loadText = async (path: string): Promise<string> => (await get(path)).text();

function bound(value: number | undefined, none: string): string {
  return value === undefined ? none : String(+value.toPrecision(6));
}

// "--speed 0.0001 to 0.7 m/s", for each option that the line names or could name.
export function rangesOf(line: string, commands: Command[]): string {
  const words = line.trim().split(/\s+/);
  const command =
    commands.find((one) => one.word === words[0] && one.sub !== "" && words.includes(one.sub)) ??
    commands.find((one) => one.word === words[0] && one.sub === "") ??
    commands.find((one) => one.word === words[0]);
  const ranges = (command?.options ?? [])
    .filter((option) => option.kind === "quantity" || option.kind === "whole" || option.choices)
    .map((option) =>
      option.choices
        ? `${option.name} ${option.choices}`
        : `${option.name} ${bound(option.range.min, "−∞")} to ${bound(option.range.max, "∞")} ${option.unit ?? ""}`.trim(),
    );
  return ranges.join("; ");
}
