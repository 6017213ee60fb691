"""LinuxCNC on the bench beside BBMC: measure.py ROOT PROGRAM MODULE PAGE [--only PART]

Homes and runs circles in lockstep and by the wall clock, faces single faults and the campaign, and writes PAGE. What must hold
(see `expect`) decides the exit code; the rest of the page is what was found. Runs by the wall clock are tried until one is valid.
"""

import json
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import figures

root, program, module, page = Path(sys.argv[1]), sys.argv[2], sys.argv[3], Path(sys.argv[4])
only = sys.argv[6] if len(sys.argv) > 6 else ""
work = tempfile.TemporaryDirectory(prefix="towbench-linuxcnc-")
(Path(work.name) / "fixtures").symlink_to(root / "fixtures")
MOTIONS = root / "fixtures/any-controller"
AT_S = 15.8  # of LinuxCNC's runs: 2.8 s into the circle
ATTEMPTS = 6
AT_ONCE = 3  # of LinuxCNC, which sleeps most of the time
FAULTS = [
    "kill_switch pressed",
    "endstop.y_min stuck_closed",
    "encoder.y frozen",
    "encoder.y dead_a",
    "encoder.y inverted",
    "encoder.x frozen",
    "amplifier.y disabled",
    "supply over_current",
    "drive.y jam",
    "link.to_controller loss",
]
failures = []


def expect(what: str, holds: bool, detail: object = "") -> None:
    print(("ok    " if holds else "WRONG ") + what, "" if holds else detail, flush=True)
    if not holds:
        failures.append(what)


def linuxcnc(name: str) -> list:
    return ["--controller", f"process:'{root}/clients/linuxcnc/start.sh' '{module}' {name} {{address}}"]


def run(experiment: Path, *options: str) -> tuple:
    """Exit code, result, folder."""
    out = tempfile.mkdtemp(dir=work.name)
    command = [program, "run", str(experiment), "--no-report", "--json", "--out", out, *options]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    try:
        result = json.loads(done.stdout)
        return done.returncode, result, Path(result["folder"])
    except (json.JSONDecodeError, KeyError):
        return done.returncode, {"verdict": "INVALID", "reason": done.stderr.strip() or done.stdout.strip(), "checks": []}, None


def complaints(result: dict) -> str:
    wrong = [f"{check['name']}: {check['reason']}" for check in result["checks"] if check["verdict"] != "PASS"]
    return "; ".join([result.get("reason") or "", *wrong]).strip("; ")


def bbmc_circle(radius_m: float, period_s: float, turns: int) -> Path:
    """BBMC's own command for the same circle."""
    path = Path(work.name) / f"bbmc-{radius_m}.toml"
    text = (root / "fixtures/motions/circle-short.toml").read_text()
    text = text[: text.index("# Nothing may move again")].replace('"../', '"fixtures/')
    command = f"--radius {radius_m}m --period {period_s}s --turns {turns}"
    path.write_text(text.replace("--radius 0.1m --period 4s --turns 1", command).replace("20.0", "40.0", 1))
    return path


# ---- the parts of the page ----


def circles() -> list:
    lines = [
        "| circle, steady part | side | LinuxCNC: radius off by, um | lag, ms | ripple of the duty Y, % | BBMC: radius off by, um | lag, ms | ripple, % |",
        "| --- | --- | --- | ---: | ---: | --- | ---: | ---: |",
    ]
    for name, motion, radius_m, period_s, turns in (("circle", "homed-circle", 0.2, 7, 2), ("circle-short", "homed-circle-short", 0.1, 4, 1)):
        code, result, folder = run(MOTIONS / f"{motion}.toml", *linuxcnc(name))
        expect(f"LinuxCNC homes on the switches and passes {motion}", code == 0, complaints(result))
        _, _, other = run(bbmc_circle(radius_m, period_s, turns))
        if folder is None or other is None:
            continue
        found = [figures.circle(one, radius_m, period_s, turns) for one in (folder, other)]
        for side in ("motor", "carriage"):
            cells = [f"{one[side][0]:+.0f} to {one[side][1]:+.0f} | {one['lag_ms']:.1f} | {one['ripple_pct']:.2f}" for one in found]
            lines.append(f"| {radius_m} m in {period_s} s | {side} | {cells[0]} | {cells[1]} |")
    return lines


def reaction(words: str) -> str:
    _, result, folder = run(MOTIONS / "homed-circle-short.toml", *linuxcnc("circle-short"), "--fault", f"{words} at={AT_S}s")
    cells = [f"`{words}`"]
    for verdict, place, at_s in ((result["verdict"], folder, AT_S), bbmc_reaction(words)):
        seen = figures.reaction(place, at_s) if place else None
        cells.append(f"{verdict} | {seen[0]} | {seen[1]}" if seen else f"{verdict} | | ")
    print("      " + words + ": " + complaints(result), flush=True)
    return "| " + " | ".join(cells) + " |"


def bbmc_reaction(words: str) -> tuple:
    experiment = bbmc_circle(0.1, 4, 1)
    at_s = bbmc_start_s + AT_S - 13.0
    _, result, folder = run(experiment, "--fault", f"{words} at={at_s:.4f}s")
    return result["verdict"], folder, at_s


def reactions() -> list:
    global bbmc_start_s
    _, _, folder = run(bbmc_circle(0.1, 4, 1))
    bbmc_start_s = figures.start_s(folder)
    with ThreadPoolExecutor(max_workers=AT_ONCE) as pool:
        rows = list(pool.map(reaction, FAULTS))
    expect("LinuxCNC takes the duty away within 2 ms of the kill switch", "| PASS | 1 |" in rows[0] or "| PASS | 2 |" in rows[0], rows[0])
    head = "| fault, 2.8 s into the circle | LinuxCNC | drive off after, ms | way, mm | BBMC | drive off after, ms | way, mm |"
    return [head, "| --- | --- | ---: | ---: | --- | ---: | ---: |", *rows]


def results_of(name: str, *options: str) -> dict:
    """By part and kind: cases, how many were withstood, INVALID ones, what was broken."""
    out = tempfile.mkdtemp(dir=work.name)
    subprocess.run([program, "campaign", name, "--out", out, "--quiet", *options], capture_output=True, check=False)
    found = {}
    file = Path(out) / "results.jsonl"
    for line in file.read_text().splitlines() if file.exists() else []:
        case = json.loads(line)
        kind = case["case"].split("/")[1]
        row = found.setdefault(kind, {"cases": 0, "kept": 0, "invalid": 0, "broken": set()})
        row["cases"] += 1
        row["kept"] += case["verdict"] == "PASS"
        row["invalid"] += case["verdict"] == "INVALID"
        row["broken"] |= {broken["rule"] for broken in case.get("broken") or []}
    return found


def campaign() -> list:
    ours = results_of("homed-circle", "--workers", str(AT_ONCE), *linuxcnc("circle-short"))
    theirs = results_of("standard", "--only", "circle-short/")
    cases = sum(row["cases"] for row in ours.values())
    invalid = sum(row["invalid"] for row in ours.values())
    expect(f"the campaign has tried LinuxCNC in {cases} cases, {invalid} of them INVALID", cases >= 50 and invalid < cases / 4)
    kills = [kind for kind, row in ours.items() if kind.startswith("kill_switch") and "kill_to_zero_duty" in row["broken"]]
    expect("LinuxCNC obeys the kill switch in every case", not kills, kills)
    expect("LinuxCNC passes the motion without a fault", ours.get("no.fault", {"kept": 0})["kept"] == 1)
    lines = ["| fault | LinuxCNC: withstood, of, INVALID | broken | BBMC: withstood, of |", "| --- | --- | --- | --- |"]
    for kind, row in ours.items():
        other = theirs.get(kind)
        beside = f"{other['kept']} of {other['cases']}" if other else "not in its campaign"
        lines.append(f"| {kind} | {row['kept']} of {row['cases']}, {row['invalid']} | {', '.join(sorted(row['broken']))} | {beside} |")
    kept = sum(row["kept"] for row in ours.values())
    lines.append(f"| **all** | {kept} of {cases}, {invalid} | | |")
    return lines


def wall_clock() -> list:
    lines = ["| by the wall clock | attempt | verdict | why |", "| --- | ---: | --- | --- |"]
    for motion in ("homed-circle-short", "homed-circle-kill"):
        verdict = "INVALID"
        for attempt in range(1, ATTEMPTS + 1):
            _, result, _ = run(MOTIONS / f"{motion}.toml", *linuxcnc("circle-short"), "--clock", "real")
            verdict = result["verdict"]
            lines.append(f"| {motion} | {attempt} | {verdict} | {complaints(result)[:300]} |")
            if verdict != "INVALID":
                break
        expect(f"{motion} by the wall clock: {verdict}", verdict != "FAIL", lines[-1])
        if verdict == "INVALID":
            print(f"@@ real time unproven: the host was late in each of {ATTEMPTS} attempts of {motion}", flush=True)
    return lines


PARTS = {"circles": circles, "reactions": reactions, "campaign": campaign, "wall clock": wall_clock}
bbmc_start_s = 0.0
text = (Path(__file__).parent / "page.txt").read_text()
for part, measure in PARTS.items():
    if only in ("", part):
        text = text.replace(f"<!-- {part} -->", "\n".join(measure()))
page.write_text(text)
work.cleanup()
sys.exit(bool(failures))
