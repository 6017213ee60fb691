// BBMC's console: what it printed, and a line to type into.
import { element } from "../dom";
import { button, textField } from "./form";

const mostText = 60_000;

export class ConsoleBox {
  readonly box = element("section", "card");
  private readonly screen = element("pre", "terminal");
  private readonly line = textField();
  private readonly past: string[] = [];
  private at = 0;

  constructor(type: (text: string) => void) {
    this.line.id = "console-line";
    this.line.setAttribute("aria-label", "A line for the controller's console");
    this.line.placeholder = "help";
    this.screen.tabIndex = 0;
    const send = () => {
      type(`${this.line.value}\r`);
      if (this.line.value !== "") this.past.push(this.line.value);
      this.at = this.past.length;
      this.line.value = "";
    };
    this.line.addEventListener("keydown", (event) => {
      if (event.key === "Enter") send();
      else if (event.key === "ArrowUp") this.recall(-1);
      else if (event.key === "ArrowDown") this.recall(1);
      else return;
      event.preventDefault();
    });
    const row = element("div", "typed");
    row.append(this.line, button("Type", send));
    this.box.append(element("h2", "", "Controller's console"), this.screen, row);
  }

  clear(): void {
    this.screen.textContent = "";
  }

  add(text: string): void {
    if (text === "") return;
    const atEnd = this.screen.scrollTop + this.screen.clientHeight >= this.screen.scrollHeight - 8;
    this.screen.textContent = (this.screen.textContent + text.replace(/\r/g, "")).slice(-mostText);
    if (atEnd) this.screen.scrollTop = this.screen.scrollHeight;
  }

  private recall(step: number): void {
    this.at = Math.min(this.past.length, Math.max(0, this.at + step));
    this.line.value = this.past[this.at] ?? "";
  }
}
