#!/usr/bin/env python3
"""One line of the table of docs/measurements/carriers.md. usage: table_row.py NAME RUNS_FOLDER BENCHMARK_OUTPUT"""
import json
import pathlib
import re
import sys

name, runs, benchmark = sys.argv[1:]
folder = next(path.parent for path in pathlib.Path(runs).glob("*/result.json"))
result = json.loads((folder / "result.json").read_text())
checks = {(c["name"], c.get("window") or ""): c["value"] for c in result["checks"]}
peak = next(v for (n, _), v in checks.items() if n == "y_tracking_error_peak_m")
rms = next(v for (n, _), v in checks.items() if n == "y_tracking_error_rms_m")

used = "none"
if (folder / "wire.json").exists():
    wire = json.loads((folder / "wire.json").read_text())
    seconds = result["simulated_time_s"]
    used = " + ".join(f"{wire[way] / seconds / 1e3:.0f}" for way in ("bits_to_plant", "bits_to_controller")) + " kbit/s"

turn = re.search(r"bare ([\d.]+) us, ours ([\d.]+) us, ratio of medians ([\d.]+) over (\d+)", benchmark)
trip = f"{turn[1]} us, {turn[2]} us, **{turn[3]}**" if turn else "none"
worst = re.search(r"worst case at 1 kHz, digest: (\d+) kbit/s to the plant, (\d+) to the controller, (\d+) % of (\d+)", benchmark)
load = f"{worst[3]} % of {int(worst[4]) / 1e6:g} Mbit/s" if worst else "no rate to fill"
print(f"@@ row | {name} | {result['fidelity']} | {result['verdict']} | {used} | {load} | {trip} "
      f"| {peak * 1e3:.5f} mm | {rms * 1e6:.2f} um |")
