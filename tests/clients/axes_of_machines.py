"""Machines of one, two, three and six axes under the external PIDs: axes_of_machines.py ROOT BENCH C_PID [STUDY]

The machines are made here from the joint of fixtures/machines, so that each axis of six is as the one of one.
"""

import csv
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

root, bench, c_pid = Path(sys.argv[1]), sys.argv[2], sys.argv[3]
study = sys.argv[4] if len(sys.argv) > 4 else ""
work = Path(tempfile.mkdtemp(prefix="towbench-axes-"))
joint = root / "fixtures/machines/joint"
SETTINGS = "metres_per_count=1.5707963e-5 inertia=0.02 stall_duty=0.5 largest_error=0.02 holding_brake=1"
PYTHON, C = f"python3 '{root}/clients/python/examples/pid.py'", f"'{c_pid}'"
failures = []


def expect(what: str, holds: bool, detail: object = "") -> None:
    print(("ok    " if holds else "WRONG ") + what, "" if holds else detail, flush=True)
    if not holds:
        failures.append(what)


def pid(axes: str, program: str = C, settings: str = SETTINGS) -> str:
    return f"process:{program} {{address}} {axes} {settings}"


def call(*words: object) -> tuple:
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, cwd=root, timeout=300)
    return done.returncode, done.stdout + done.stderr


def run(experiment: Path, controller: str, *options: str) -> tuple:
    out = Path(tempfile.mkdtemp(dir=work))
    code, said = call(bench, "run", experiment, "--controller", controller, "--out", out, "--no-report", *options)
    return code, next(out.iterdir(), out), said


def of_axes(text: str, axes: str) -> str:
    """The tables of the joint's axis y, once for each of `axes`."""
    start = text.index("[axis.y]")
    end = text.find("[supply]")
    end = end if end >= 0 else len(text)
    return text[:start] + "".join(text[start:end].replace("axis.y", f"axis.{name}") for name in axes) + text[end:]


def motion(axis: str, at_s: float, distance_rad: float = 0.6) -> str:
    return (
        f'\n[[reference]]\nmove = "trapezoid"\naxis = "{axis}"\nat_s = {at_s:.1f}\ndistance_rad = {distance_rad}\n'
        "speed_rad_per_s = 1.0\nacceleration_rad_per_s2 = 4.0\n"
    )


def budget(metric: str, most: float, least: float = 0) -> str:
    return f'\n[[budget]]\nmetric = "{metric}"\nmin = {least}\nmax = {most}\nsource = "as the joint\'s"\n'


def machine(name: str, axes: str, more_rig: str = "") -> Path:
    folder = work / name
    folder.mkdir()
    plant = of_axes((joint / "plant.toml").read_text(), axes).replace("over_current_A = { value = 10.0", "over_current_A = { value = 60.0")
    (folder / "plant.toml").write_text(plant)
    (folder / "rig.toml").write_text(of_axes((joint / "rig.toml").read_text(), axes) + more_rig)
    head = f'schema = 1\nname = "{name}"\nrig = "rig.toml"\nduration_limit_s = 10.0\n'
    moves = "".join(motion(axis, 0.5 + 0.1 * nth) for nth, axis in enumerate(axes))
    ends = "".join(budget(f"{axis}_tracking_error_peak_m", 3.7e-3, 1.6e-5) + budget(f"{axis}_carriage_travel_m", 0.61, 0.59) for axis in axes)
    wanted = "".join(f'\n[[requirement]]\nid = "FOLLOWS-{axis.upper()}"\nformula = "always: |{axis}_error| < 4 mm"\n' for axis in axes)
    (folder / "experiment.toml").write_text(head + moves + ends + wanted)
    return folder


def truth(folder: Path, column: str) -> list:
    with (folder / "truth.csv").open() as rows:
        return [row[column] for row in csv.DictReader(rows)]


def every_number_of_axes() -> None:
    alone = {}
    for axes in ("z", "yx", "yxc", "yxzabc"):
        folder = machine(f"axes-{axes}", axes)
        for name, program in (("C", C), ("Python", PYTHON)):
            code, ran, said = run(folder / "experiment.toml", pid(axes, program))
            judged = [name for name in axes if f"{name}_tracking_error_peak_m" in said and f"FOLLOWS-{name.upper()}" in said]
            expect(f"{axes}: the PID in {name} moves each axis", code == 0 and judged == list(axes), (code, said))
        code, said = call(bench, "replay", ran)
        expect(f"{axes}: its replay is identical", code == 0 and said.count("identical") == 4, said)
        code, said = call(bench, "report", ran)
        page = (ran / "report.html").read_text()
        expect(f"{axes}: has a report that names each axis", code == 0 and all(f"{name}_position_m" in page for name in axes), said)
        limits = json.loads((ran / "result.json").read_text())["limits"]
        exist = [name for name, ends in limits.items() if ends["exists"]]
        expect(f"{axes}: the record knows its axes", sorted(exist) == sorted(axes), limits)
        alone[axes] = truth(ran, f"{axes[0]}_carriage_m")
    same = all(alone["z"][:1000] == other[:1000] for other in alone.values())
    expect("an axis moves as it does alone, whatever its letter and its company", same)


def faults_strike_their_axis() -> None:
    experiment = work / "axes-yxzabc/experiment.toml"
    for fault, reason in {
        "encoder.a frozen phase=cruise": "does not follow|tracking error",
        "amplifier.c disabled at=1s": "does not follow|tracking error",
        "drive.b brake_stuck at=0.5s": "does not follow|tracking error",
        "endstop.z_max stuck_closed at=1s": "end-stop",
        "kill_switch pressed at=1s": "kill switch",
    }.items():
        code, ran, said = run(experiment, pid("yxzabc"), "--fault", fault)
        heard = (ran / "controller.txt").read_text()
        expect(f"six axes: {fault} is noticed and handled", code == 0 and re.search(reason, heard) is not None, (code, said, heard))
    code, _, said = run(experiment, pid("yxzabc", settings=SETTINGS + " b.inertia=0.005"))
    broken = [name for name in "yxzabc" if f"FAIL     {name}_tracking_error_peak_m" in said]
    expect("six axes: a loop too weak for b fails for b", code == 1 and broken == ["b"], (code, said))


def left_out() -> None:
    folder = machine("bare", "za", "[kill_switch]\nfitted = false\n")
    text = (folder / "rig.toml").read_text()
    for end in ("min", "max"):
        text = text.replace(f"[axis.a.hall_{end}]\n", f"[axis.a.hall_{end}]\nfitted = false\n")
    (folder / "rig.toml").write_text(text.replace("[axis.z]\n", "[axis.z]\nencoder = { index_count = -1 }\n"))
    code, _, said = run(folder / "experiment.toml", pid("za"))
    expect("without an index, without halls, without a kill switch it moves", code == 0, said)
    code, _, said = run(folder / "experiment.toml", pid("za"), "--fault", "kill_switch pressed at=1s")
    expect("a kill switch that is not there proves nothing", code == 4 and "took no effect" in said, (code, said))


def campaign() -> None:
    folder = machine("two-arms", "yz")
    head = '\nschema = 1\nname = "two-arms-{0}"\nrig = "rig.toml"\nduration_limit_s = 10.0\nseed = 1\n'
    for axis in "yz":
        (folder / f"trapezoid-{axis}.toml").write_text(head.format(axis) + motion(axis, 0.5) + budget(f"{axis}_final_error_m", 1e-3))
    own = "".join(f'any-trapezoid-{axis} = "trapezoid-{axis}.toml"\n' for axis in "yz")
    (folder / "fixtures").symlink_to(root / "fixtures")
    base = 'schema = 1\nbase = "fixtures/campaigns/any-controller.toml"\nname = "two-arms"\n[instead]\n'
    (folder / "campaign.toml").write_text(base + own)
    out = folder / "results"
    words = [bench, "campaign", folder / "campaign.toml", "--controller", pid("yz"), "--out", out, "-q"]
    call(*words, "--only", "encoder.")
    results = [json.loads(line) for line in (out / "results.jsonl").read_text().splitlines()] if (out / "results.jsonl").exists() else []
    of = {axis: sorted(one["case"].replace(f"-{axis}/", "/").replace(f"encoder.{axis}", "encoder") for one in results if f"encoder.{axis}" in one["case"]) for axis in "yz"}
    expect("a campaign does to z what it does to y", len(of["y"]) > 5 and of["y"] == of["z"], of)
    broken = [one["case"] for one in results if "/cruise/" in one["case"] and one["verdict"] != "PASS"]
    expect("and nothing of it is broken", broken == [], broken)
    (folder / "campaign.toml").write_text(base + 'any-trapezoid-y = "trapezoid-y.toml"\n')
    code, said = call(*words)
    expect("an axis that no motion of a campaign is for is refused", code == 2 and "no motion of axis z" in said, (code, said))


def refusals() -> None:
    folder = work / "axes-yxc"
    text = (folder / "experiment.toml").read_text()
    script = '[[console]]\nsend = "status"\n'
    (folder / "controller.toml").write_text((root / "fixtures/controllers/bbmc-0.5.toml").read_text())
    cases = {
        "BBMC on three axes": (re.sub(r"\[\[(reference|budget|requirement)\]\](.|\n)*", script, text).replace("rig =", 'controller = "controller.toml"\nrig ='), "BBMC, which serves y and x"),
        "a motion of an axis that is not there": (text.replace('axis = "c"', 'axis = "b"'), "a motion of b"),
        "a motion of an axis that no machine has": (text.replace('axis = "c"', 'axis = "w"'), "y, x, z, a, b"),
        "a start of an axis that is not there": (text.replace("\n[[reference]]", "\n[start]\na_rad = 0.0\n\n[[reference]]", 1), "an axis that the rig lacks"),
    }
    for what, (made, words) in cases.items():
        (folder / "refused.toml").write_text(made)
        code, said = call(bench, "run", folder / "refused.toml", *([] if "BBMC" in what else ["--controller", pid("yxc")]), "--out", work / "none")
        expect(f"refused in one line: {what}", code == 2 and words in said and said.count("\n") == 1, (code, said))
    code, said = call(bench, "emulate", "--rig", folder / "rig.toml", "--carrier", "local:/tmp/none", "--lines", "gpio:/dev/gpiochip0:0")
    expect("refused in one line: a third axis on lines", code == 2 and "axis c" in said and said.count("\n") == 1, (code, said))
    for wrong, words in ((("[axis.c]", "[axis.w]"), "axis.w"), (("[axis.c]", "[axis.y]"), "axis")):
        plant = (folder / "plant.toml").read_text().replace(*wrong).replace(wrong[0][:-1] + ".", wrong[1][:-1] + ".")
        (folder / "wrong.toml").write_text(plant)
        code, said = call(bench, "validate", folder / "wrong.toml")
        expect(f"refused in one line: {wrong[1]} for {wrong[0]}", code == 2 and words in said and said.count("\n") == 1, (code, said))
    code, ran, said = run(folder / "experiment.toml", pid("yx"))
    expect("a controller of two axes is refused by a machine of three", code in (3, 4) and "axes" in said, (code, said))


def turned_body() -> None:
    settings = "c.metres_per_count=4.4908e-5 c.inertia=0.0071"
    code, ran, said = run(root / "fixtures/any-controller/turned-body.toml", pid("yxc", PYTHON, settings))
    expect("the tow tank with its third axis turns a body on the way", code == 0, said)
    with (ran / "force.csv").open() as rows:
        force = [(float(row["time_s"]), float(row["force_y_N"])) for row in csv.DictReader(rows)]

    def mean(from_s: float, to_s: float) -> float:
        shown = [newton for time_s, newton in force if from_s < time_s < to_s]
        return sum(shown) / len(shown)

    # 2 N s2/m2 along, 12 across, at 0.3 m/s; the sensor's bias goes out of the difference.
    more_N = mean(1.4, 2.4) - mean(4.2, 5.2)
    expect("turned by 90 degrees it takes (12 - 2) 0.3^2 N more", abs(more_N - 0.9) < 0.03, more_N)
    if study:
        code, said = call(study, "diagnose", "--data", ran, "--model", root / "fixtures/plants/macs-theta.toml", "--axis", "c", "--out", work / "diagnosed")
        expect("its log is diagnosed by the letter of the axis", code == 0 and said.startswith("What is wrong"), (code, said))


for check in (every_number_of_axes, faults_strike_their_axis, left_out, campaign, refusals, turned_body):
    check()
print(f"{len(failures)} wrong")
sys.exit(1 if failures else 0)
