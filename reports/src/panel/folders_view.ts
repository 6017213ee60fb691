// Runs, campaigns and diagnoses on disk: a list, the report of one, two over each other.
import { element, missingNote } from "../dom";
import { showCampaign } from "./campaign";
import { type Folder, loadFolders } from "./catalogue";
import { compare } from "./compare";
import { showDiagnosis } from "./diagnosis_view";
import { button } from "./form";

export class FoldersView {
  private readonly list = element("section", "folder-list");
  private readonly shown = element("section");
  private readonly compareButton: HTMLButtonElement;
  private readonly chosen: string[] = [];
  private folders: Folder[] = [];

  constructor(private readonly host: HTMLElement) {
    const row = element("div", "bar-row");
    this.compareButton = button("Compare the two chosen", () => void compare(this.freshSheet(), this.chosen as [string, string]));
    this.compareButton.id = "compare";
    row.append(button("Look again", () => void this.refresh()), this.compareButton);
    this.host.append(row, this.shown, this.list);
  }

  // "" for the list, else a folder's name.
  async open(name: string): Promise<void> {
    const sheet = this.freshSheet();
    await this.refresh();
    if (name === "") return;
    const folder = this.folders.find((one) => one.name === name);
    if (folder === undefined) sheet.append(missingNote(`There is no folder ${name}.`));
    else await this.show(folder, sheet);
  }

  // What is asked for is written on a sheet of its own: an answer that comes after the next
  // question lands on one that is put away already.
  private freshSheet(): HTMLElement {
    const sheet = element("div");
    this.shown.replaceChildren(sheet);
    return sheet;
  }

  private async refresh(): Promise<void> {
    try {
      this.folders = await loadFolders();
    } catch (error) {
      this.list.replaceChildren(missingNote(String(error)));
      return;
    }
    const table = element("table");
    const head = element("tr");
    for (const text of ["", "Folder", "What", "Verdict", "Started"]) head.append(element("th", "", text));
    table.append(head, ...this.folders.map((folder) => this.entry(folder)));
    this.list.replaceChildren(this.folders.length === 0 ? missingNote("No run yet. Start an experiment on the page Run; its folder is then listed here, with its report.") : table);
    this.showChoice();
  }

  private entry(folder: Folder): HTMLTableRowElement {
    const row = element("tr");
    const mark = element("input");
    mark.type = "checkbox";
    mark.checked = this.chosen.includes(folder.name);
    mark.disabled = folder.kind !== "run";
    mark.setAttribute("aria-label", `choose ${folder.name}`);
    mark.addEventListener("change", () => this.choose(folder.name, mark.checked));
    const link = element("a", "", folder.name);
    link.href = `#folders/${folder.name}`;
    const cells = [mark, link, folder.title || folder.kind, folder.verdict || folder.status || "", folder.started_utc ?? ""];
    for (const content of cells) {
      const cell = element("td");
      cell.append(content);
      row.append(cell);
    }
    return row;
  }

  private choose(name: string, on: boolean): void {
    const at = this.chosen.indexOf(name);
    if (on && at < 0) this.chosen.push(name);
    if (!on && at >= 0) this.chosen.splice(at, 1);
    this.showChoice();
  }

  private showChoice(): void {
    this.compareButton.disabled = this.chosen.length !== 2;
  }

  private async show(folder: Folder, sheet: HTMLElement): Promise<void> {
    if (folder.kind === "campaign") return showCampaign(sheet, folder);
    if (folder.kind === "diagnosis") return showDiagnosis(sheet, folder);
    const viewer = element("iframe", "viewer");
    viewer.title = `Report of ${folder.name}`;
    viewer.src = `/runs/${folder.name}/report.html`;
    sheet.append(viewer);
  }
}
