// The panel: a run under way, and what is on disk.
import "../licence";
import plotStyle from "uplot/dist/uPlot.min.css";

import { element } from "../dom";
import { FoldersView } from "./folders_view";
import { RunView } from "./run_view";
import { Wire } from "./wire";

document.head.append(element("style", "", plotStyle));
const runHost = document.getElementById("view-run")!;
const foldersHost = document.getElementById("view-folders")!;
const connection = document.getElementById("connection")!;

let wire: Wire | null = null;
const run: RunView = new RunView(
  runHost,
  (message) => wire?.send(message),
  (why) => run.tell(why),
);
const folders = new FoldersView(foldersHost);

wire = new Wire({
  onFrame: (frame) => run.take(frame),
  onRefused: (why) => run.tell(why),
  onMissed: (frames) => run.addMissed(frames),
  onConnection: (state) => {
    connection.textContent = state === "open" ? "connected" : "connection lost; trying again";
    connection.classList.toggle("lost", state === "lost");
  },
});

function showView(): void {
  const [view, name] = (location.hash.slice(1) || "run").split("/");
  runHost.hidden = view === "folders";
  foldersHost.hidden = view !== "folders";
  for (const link of document.querySelectorAll<HTMLAnchorElement>("header nav a")) {
    const current = link.hash === (view === "folders" ? "#folders" : "#run");
    if (current) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
  }
  if (view === "folders") void folders.open(decodeURIComponent(name ?? ""));
}

addEventListener("hashchange", showView);
showView();
