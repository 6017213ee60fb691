// The bar above a run's time plots: what is shown, zoom buttons, and the windows that were judged.
import type { TimeWindow } from "./data";
import { element } from "./dom";
import type { TimeGroup } from "./time_group";

function button(label: string, meaning: string, act: () => void): HTMLButtonElement {
  const made = element("button", "", label);
  made.type = "button";
  made.title = meaning;
  made.setAttribute("aria-label", meaning);
  made.addEventListener("click", act);
  return made;
}

export function addToolbar(host: HTMLElement, group: TimeGroup, windows: TimeWindow[]): void {
  const bar = element("div", "toolbar");
  bar.setAttribute("role", "toolbar");
  bar.setAttribute("aria-label", "Time range of all plots of this run");
  const range = element("span", "range");
  const cursor = element("output", "cursor");
  const reset = button("Reset zoom", "Show the whole run", () => group.reset());
  bar.append(
    range,
    cursor,
    button("−", "Zoom out", () => group.zoom(2)),
    button("+", "Zoom in", () => group.zoom(0.5)),
    reset,
  );
  for (const window of windows.filter((w) => w.name !== "whole")) {
    const show = () => group.show({ from: window.from_s, to: window.to_s });
    bar.append(button(window.name.replace(/_/g, " "), `Show the window “${window.name}”`, show));
  }
  const update = () => {
    const { from, to } = group.visible;
    range.textContent = `${from.toFixed(3)} – ${to.toFixed(3)} s`;
    reset.disabled = from === group.full.from && to === group.full.to;
  };
  update();
  group.onRange(update);
  group.onCursor((row) => {
    cursor.textContent = row === null ? "" : `at ${group.time[row]!.toFixed(4)} s`;
  });
  host.append(bar);
}
