"""Each machine of fixtures/machines with the external PID of its folder: foreign_machines.py GROUP ROOT BENCH C_PID [STUDY]

GROUP is `guard`, or `campaign` for all cases of every campaign and the diagnosis of every machine. Nothing here knows a machine but by its folder, save what its
exercise hides from its plant file.
"""

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

group, root, bench, c_pid = sys.argv[1], Path(sys.argv[2]), sys.argv[3], sys.argv[4]
study = sys.argv[5] if len(sys.argv) > 5 else ""
work = tempfile.TemporaryDirectory(prefix="towbench-machines-")
# What `diagnose` is to say that the model lacks. No motion of the cart tells a spring from a force that depends on place.
HIDDEN = {"ball-screw": "torque_ripple", "belt-cart": "cable_spring or position_force", "joint": "gravity"}
failures = []


def expect(what: str, holds: bool, detail: object = "") -> None:
    print(("ok    " if holds else "WRONG ") + what, "" if holds else detail, flush=True)
    if not holds:
        failures.append(what)


def call(*words: object) -> tuple:
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, cwd=root)
    return done.returncode, done.stdout + done.stderr


def run(experiment: Path, controller: str) -> tuple:
    out = tempfile.mkdtemp(dir=work.name)
    code, said = call(bench, "run", experiment, "--controller", controller, "--out", out, "-q", "--no-report")
    folders = list(Path(out).iterdir())
    return code, folders[0] if folders else Path(out), said


def as_it_is(machine: Path, pid: str) -> None:
    code, folder, said = run(machine / "experiment.toml", pid)
    expect(f"{machine.name}: the experiment passes", code == 0, said)
    code, said = call(bench, "replay", folder)
    records = 4 + len(list(folder.glob("absolute_*.csv")))  # the verdict, log, truth and events
    expect(f"{machine.name}: its replay is identical", code == 0 and said.count("identical") == records, said)
    settings = re.findall(r"\w+=[\d.e-]+", (machine / "pid.sh").read_text().split("exec")[1])
    code, _, said = run(machine / "experiment.toml", f"process:'{c_pid}' {{address}} y {' '.join(settings)}")
    expect(f"{machine.name}: the PID in C passes", code == 0, said)
    inertia = float(next(word for word in settings if word.startswith("inertia=")).partition("=")[2])
    code, _, said = run(machine / "experiment.toml", f"process:'{c_pid}' {{address}} y {' '.join(settings)} inertia={inertia / 4}")
    broken = code in (1, 4) and "FAIL     y_tracking_error_peak_m" in said
    expect(f"{machine.name}: a loop too weak for it fails", broken, (code, said))
    code, said = call(bench, "report", folder)
    expect(f"{machine.name}: has a report", code == 0 and (folder / "report.html").stat().st_size > 10_000, said)


def diagnosed(machine: Path, pid: str) -> None:
    code, folder, said = run(machine / "exercise.toml", pid)
    expect(f"{machine.name}: the exercise passes", code == 0, said)
    out = Path(tempfile.mkdtemp(dir=work.name))
    logger = folder / "logger.csv"
    code, said = call(study, "diagnose", "--data", logger if logger.exists() else folder, "--model", machine / "plant.toml", "--out", out)
    named = said.splitlines()[0] if said else ""
    expect(f"{machine.name}: {HIDDEN[machine.name]} is named, alone", named.endswith(f"the model lacks {HIDDEN[machine.name]}."), said)
    code, said = call(bench, "validate", out / "extended_plant.toml")
    expect(f"{machine.name}: the extended plant is one", code == 0, said)


def campaign(machine: Path, pid: str, *only: str) -> None:
    out = Path(tempfile.mkdtemp(dir=work.name))
    code, said = call(bench, "campaign", machine.name, "--controller", pid, "--out", out, "-q", *only)
    results = [json.loads(line) for line in (out / "results.jsonl").read_text().splitlines()]
    wrong = [(one["case"], one["verdict"], one.get("broken")) for one in results if one["verdict"] != "PASS"]
    enough = len(results) >= (6 if only else 200)
    expect(f"{machine.name}: {len(results)} cases of its campaign", code == 0 and enough and not wrong, (code, said, wrong[:5]))


machines = sorted(path.parent for path in (root / "fixtures/machines").glob("*/experiment.toml"))
expect("every machine hides something, and nothing is hidden elsewhere", {m.name for m in machines} == set(HIDDEN), machines)
for machine in machines:
    pid = f"process:'{machine}/pid.sh' {{address}}"
    if group == "guard":
        files = sum(len((machine / name).read_text().splitlines()) for name in ("plant.toml", "rig.toml"))
        expect(f"{machine.name}: plant and rig have at most 60 lines", files <= 60, files)
        code, said = call(bench, "validate", *machine.glob("*.toml"))
        expect(f"{machine.name}: its files are read", code == 0, said)
        as_it_is(machine, pid)
        campaign(machine, pid, "--only", f"{machine.name}/kill_switch.pressed")
    else:
        campaign(machine, pid)
    if study and (group != "guard" or machine.name == "ball-screw"):
        diagnosed(machine, pid)
print(f"{len(failures)} wrong")
sys.exit(1 if failures else 0)
