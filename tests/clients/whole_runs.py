"""What the tests of whole runs share: experiments, controllers, and what a run must say."""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

group, root, program, c_pid, bbmc_process = sys.argv[1], Path(sys.argv[2]), *sys.argv[3:6]
work = Path(tempfile.mkdtemp(prefix="towbench-external-"))
PYTHON_PID = f"process:python3 '{root}/clients/python/examples/pid.py' {{address}}"
C_PID = f"process:'{c_pid}' {{address}}"
TRAPEZOID = str(root / "fixtures/any-controller/trapezoid-y.toml")
CIRCLE = str(root / "fixtures/any-controller/circle.toml")
RESET = str(root / "fixtures/any-controller/kill-and-reset.toml")
failures = []


def bad(kind: str) -> str:
    return f"process:python3 '{root}/tests/clients/bad_controller.py' '{root}' {kind} {{address}}"


def rig_beside(rig: str = "macs-nominal") -> None:
    """Copies of the rig and the plant that an experiment of this folder needs."""
    for fixture in (f"rigs/{rig}.toml", f"plants/{rig}.toml"):
        (work / fixture).parent.mkdir(exist_ok=True)
        (work / fixture).write_text((root / "fixtures" / fixture).read_text())


def experiment(name: str, *parts: str, rig: str = "macs-nominal") -> str:
    rig_beside(rig)
    path = work / f"{name}.toml"
    head = f'schema = 1\nname = "{name}"\nrig = "rigs/{rig}.toml"\nduration_limit_s = 12.0\n'
    path.write_text(head + "".join(parts))
    return str(path)


def trapezoid(distance_m: float) -> str:
    return (
        f'[[reference]]\nmove = "trapezoid"\naxis = "y"\nat_s = 0.5\ndistance_m = {distance_m}\n'
        "speed_m_per_s = 0.4\nacceleration_m_per_s2 = 1.0\n"
    )


TRAVELS = '[[budget]]\nmetric = "y_carriage_travel_m"\nmin = 0.05\n'


def run(experiment_file: str, controller: str, *options: str) -> tuple:
    done = subprocess.run(
        [program, "run", experiment_file, "--controller", controller, "--no-report", "--json", "--out", str(work / "runs"), *options],
        capture_output=True,
        text=True,
        timeout=120,
    )
    try:
        return done.returncode, json.loads(done.stdout), done.stderr
    except json.JSONDecodeError:
        return done.returncode, {}, done.stderr


def expect(what: str, holds: bool, detail: object = "") -> None:
    print(("ok    " if holds else "WRONG ") + what, "" if holds else detail, flush=True)
    if not holds:
        failures.append(what)


def expect_pass(what: str, *arguments: str) -> Path:
    code, result, error = run(*arguments)
    wrong = [(c["name"], c["reason"]) for c in result.get("checks", []) if c["verdict"] != "PASS"]
    expect(f"{what} passes", code == 0, (code, error, result.get("reason"), wrong))
    return Path(result.get("folder", ""))


def expect_caught(what: str, by: str, *arguments: str) -> None:
    code, result, error = run(*arguments)
    failed = [c["name"] for c in result.get("checks", []) if c["verdict"] == "FAIL"]
    expect(f"{what} is caught by {by}", code in (1, 4) and by in failed, (code, failed, error, result.get("reason")))


def refused(what: str, file: str, controller: str, words: str, *options: str) -> None:
    arguments = [program, "run", file, "--no-report", "--out", str(work / "bad"), *(["--controller", controller] if controller else []), *options]
    done = subprocess.run(arguments, capture_output=True, text=True, timeout=60)
    lines = done.stderr.strip().splitlines()
    expect(f"{what} is refused in one line", done.returncode == 2 and len(lines) == 1 and words in lines[0], (done.returncode, done.stderr))
    expect(f"{what} leaves nothing", not list((work / "bad").glob("*")))
