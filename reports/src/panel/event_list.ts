// What happened, the latest at the end.
import { element } from "../dom";
import type { BenchEvent } from "./wire";

const most = 400;
const grave = new Set(["fault", "fault_latched", "hard_end_contact", "peer_lost"]);

export class EventList {
  readonly box = element("section", "card");
  private readonly list = element("ul", "happened");

  constructor() {
    this.list.tabIndex = 0;
    this.box.append(element("h2", "", "Events"), this.list);
  }

  clear(): void {
    this.list.replaceChildren();
  }

  add(events: BenchEvent[]): void {
    if (events.length === 0) return;
    this.list.append(...events.slice(-most).map((event) => this.entry(event)));
    while (this.list.childElementCount > most) this.list.firstElementChild!.remove();
    this.list.scrollTop = this.list.scrollHeight;
  }

  private entry(event: BenchEvent): HTMLLIElement {
    const entry = element("li");
    const words = [event.kind.replace(/_/g, " ")];
    if (event.axis !== undefined && event.side !== "wire") words.push(event.axis);
    if (event.code !== undefined) words.push(String(event.code));
    if (event.text !== undefined && event.text !== "") words.push(event.text);
    const what = element("span", grave.has(event.kind) ? "grave" : "", words.join(" "));
    entry.append(element("span", "when", `${event.time_s.toFixed(4)} s`), element("span", "side", event.side), what);
    return entry;
  }
}
