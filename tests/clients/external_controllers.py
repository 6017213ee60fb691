"""Whole runs of controllers that the bench did not write: external_controllers.py GROUP ROOT PROGRAM C_PID BBMC

Each line of the tables is an experiment, a controller, and what the run must say: the verdict, and for a bad
controller the check that must fail. The good ones pass what the bad ones fail.
"""

import csv
import filecmp
import json
import math
import os
import pty
import subprocess
import sys
import threading
import tomllib
import tty
from pathlib import Path

from whole_runs import (
    C_PID, CIRCLE, PYTHON_PID, RESET, TRAPEZOID, TRAVELS, bad, bbmc_process, c_pid, expect, expect_caught, expect_pass,
    experiment, failures, group, program, refused, rig_beside, root, run, trapezoid, work,
)  # fmt: skip


def good() -> None:
    lines = len((root / "clients/python/examples/pid.py").read_text().splitlines())
    expect("the example in Python has at most 80 lines", lines <= 80, lines)
    for name, file in (("trapezoid", TRAPEZOID), ("circle", CIRCLE)):
        one = expect_pass(f"Python, {name}", file, PYTHON_PID)
        two = expect_pass(f"Python, {name}, again", file, PYTHON_PID)
        three = expect_pass(f"C, {name}", file, C_PID)
        said = (one / "controller.txt").read_text() + (three / "controller.txt").read_text()
        expect(f"{name}: neither has found a reason to stop", said == "", said)
        for record in ("log.csv", "truth.csv", "events.jsonl"):
            expect(f"{name}: the same {record} twice", filecmp.cmp(one / record, two / record, shallow=False))
    alone = experiment("y-alone", trapezoid(0.2), TRAVELS, rig="table-7.4")
    expect_pass("Python, Y alone,", alone, f"{PYTHON_PID} y")
    expect_pass("C, Y alone,", alone, f"{C_PID} y")
    code, result, error = run(alone, C_PID)
    expect("a controller of an axis that is not there ends with 3", code == 3 and "axes" in result.get("reason", ""), (code, result.get("reason"), error))
    expect_pass("edges instead of the digest", TRAPEZOID, bad("takes_edges"))
    for fault in ("kill_switch pressed at=1.2s", "encoder.y frozen phase=cruise after=0.1s", "encoder.y dead_a at=1.3s", "kill_switch welded at=1s", "endstop.y_max stuck_closed at=1s", "link.to_controller loss at=1s", "link.to_plant corrupt_byte at=1s"):
        expect_pass(f"with {fault}", TRAPEZOID, C_PID, "--fault", fault)
    kill, frozen = ("--fault", "kill_switch pressed at=1.2s"), ("--fault", "encoder.y frozen at=0.9s")
    expect_pass("with two faults", TRAPEZOID, C_PID, *frozen, *kill)
    code, result, error = run(TRAPEZOID, C_PID, *kill, "--fault", "encoder.y frozen at=30s")
    fired = {c["name"]: c["verdict"] for c in result.get("checks", []) if c["name"].endswith("_fired")}
    expect("one of two faults that never fires", code == 4 and fired.get("fault_1_fired") == "PASS" and fired.get("fault_2_fired") == "INVALID", (code, fired, error))
    broken = expect_pass("to be replayed", TRAPEZOID, C_PID, *kill)
    for what, folder in (("a run of a process", one), ("a run with a fault", broken)):
        replay = subprocess.run([program, "replay", str(folder)], capture_output=True, text=True)
        expect(f"{what} replays", replay.returncode == 0, replay.stdout + replay.stderr)
    comes_by_itself()
    comes_over_a_serial_line()


def told_and_counted(folder: Path) -> tuple:
    """How far Y has gone, in counts: by what its encoder tells, by its edges, and in truth."""
    ends = []
    for file, name in (("absolute_y.csv", "y_absolute_count"), ("log.csv", "y_count"), ("truth.csv", "y_count")):
        counts = [count for (count,) in columns(folder / file, name)]
        ends.append(counts[-1] - counts[0])
    return tuple(ends)


def absolute() -> None:
    """Y of the tank with an absolute encoder, whose place does not depend on its edges."""
    rig_beside()
    plant = (root / "fixtures/plants/macs-nominal.toml").read_text()
    (work / "plants/absolute.toml").write_text(plant.replace("[axis.y.encoder]\n", "[axis.y.encoder]\nabsolute = true\n"))
    rig = (root / "fixtures/rigs/macs-nominal.toml").read_text()
    (work / "rigs/absolute.toml").write_text(rig.replace("plants/macs-nominal.toml", "plants/absolute.toml"))
    file = experiment("absolute", trapezoid(0.2), TRAVELS)
    Path(file).write_text(Path(file).read_text().replace("rigs/macs-nominal", "rigs/absolute"))
    follows = "yx y.absolute=1"
    by_edges = expect_pass("by its edges", file, PYTHON_PID)
    for name, controller in (("Python", PYTHON_PID), ("C", C_PID)):
        folder = expect_pass(f"{name} by what is told", file, f"{controller} {follows}")
        told, counted, true = told_and_counted(folder)
        expect(f"{name}: edges, what is told and the truth agree", told == counted == true and told > 80_000, (told, counted, true))
        if name == "Python":
            same = all(filecmp.cmp(folder / record, by_edges / record, shallow=False) for record in ("log.csv", "truth.csv", "absolute_y.csv"))
            expect("of a sound encoder it is the same run", same)
        replay = subprocess.run([program, "replay", str(folder)], capture_output=True, text=True)
        expect(f"{name}: it replays", replay.returncode == 0 and "absolute_y.csv identical" in replay.stdout, replay.stdout + replay.stderr)
        folder = expect_pass(f"{name} with a dead channel", file, f"{controller} {follows}", "--fault", "encoder.y dead_a at=1s")
        told, counted, true = told_and_counted(folder)
        said = (folder / "controller.txt").read_text()
        expect(f"{name}: it arrives where the edges do not count", abs(true - told) < 2 and abs(true - 0.2 / 2.24545e-6) < 200 and counted < 60_000 and not said, (told, counted, true, said))
        folder = expect_pass(f"{name} with a frozen encoder", file, f"{controller} {follows}", "--fault", "encoder.y frozen at=1s")
        said = (folder / "controller.txt").read_text()
        expect(f"{name}: it stops by itself", "follow" in said or "tracking error" in said, said)
        folder = expect_pass(f"{name} with messages lost", file, f"{controller} {follows}", "--fault", "link.to_controller loss at=1s")
        expect(f"{name}: it says so", "a message was lost" in (folder / "controller.txt").read_text())
        code, result, error = run(TRAPEZOID, f"{controller} {follows}")
        said = (Path(result["folder"]) / "controller.txt").read_text().strip().splitlines()
        expect(f"{name}: refused in one line where nothing is told", code != 0 and len(said) == 1 and "encoder of y is not absolute" in said[0], (code, said, error))
        code, result, error = run(file, f"{controller} yx x.absolute=1")
        said = (Path(result["folder"]) / "controller.txt").read_text().strip().splitlines()
        expect(f"{name}: and of the axis that tells nothing", code != 0 and len(said) == 1 and "encoder of x is not absolute" in said[0], (code, said, error))
    with_rig = ("--rig", str(work / "rigs/absolute.toml"))
    for name, controller in (("C", C_PID), ("Python", PYTHON_PID)):
        for settings in ("", f" {follows}"):
            code, found = findings(controller + settings, *with_rig)
            wrong = {duty: said for duty, said in found.items() if said[0] != "PASS"}
            expect(f"{name}{settings} keeps {len(found)} duties", code == 0 and len(found) == 14, wrong)
    for kind, keeps in (("follows_absolute", True), ("trusts_an_old_count", False)):
        code, found = findings(bad(kind), "--only", "misses_absolute", *with_rig)
        said = found.get("misses_absolute", ("", ""))
        expect(f"{kind} {'keeps' if keeps else 'breaks'} misses_absolute", said[0] == ("PASS" if keeps else "FAIL"), (code, found))
    done = subprocess.run([program, "conform", "--controller", C_PID, "--only", "misses_absolute"], capture_output=True, text=True)
    expect("a duty of another machine is refused in one line", done.returncode == 2 and len(done.stderr.strip().splitlines()) == 1, done.stderr)


def copy(from_line: int, to_line: int) -> None:
    try:
        while data := os.read(from_line, 65536):
            while data:
                data = data[os.write(to_line, data) :]
    except OSError:
        pass  # an end was closed


def serial_line() -> tuple:
    """The devices at the ends of a serial line: two ptys, joined."""
    (one, one_end), (other, other_end) = pty.openpty(), pty.openpty()
    for end in (one_end, other_end):
        tty.setraw(end)
    for ways in ((one, other), (other, one)):
        threading.Thread(target=copy, args=ways, daemon=True).start()
    return os.ttyname(one_end), os.ttyname(other_end)


def comes_over_a_serial_line() -> None:
    ours, theirs = serial_line()
    out = work / "serial"
    bench = subprocess.Popen([program, "run", TRAPEZOID, "--controller", f"external:serial:{ours}", "--no-report", "--quiet", "--out", str(out)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    bench.stderr.readline()  # it is there: what is written to a line before somebody opens it is lost
    comes = subprocess.run([sys.executable, str(root / "clients/python/examples/pid.py"), f"serial:{theirs}"], capture_output=True, text=True, timeout=120)
    expect("one that comes over a serial line passes", (bench.wait(120), comes.returncode) == (0, 0), comes.stderr)


def comes_by_itself() -> None:
    address = f"local:{work}/bench"
    bench = subprocess.Popen(
        [program, "run", TRAPEZOID, "--controller", f"external:{address}", "--no-report", "--quiet", "--out", str(work / "runs")],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    says = bench.stderr.readline()
    expect("the bench says where it waits", address in says, says)
    comes = subprocess.run([c_pid, address], capture_output=True, text=True, timeout=120)
    printed, error = bench.communicate(timeout=120)
    expect("one that comes by itself passes", (bench.returncode, comes.returncode) == (0, 0), (printed, error, comes.stderr))
    replay = subprocess.run([program, "replay", printed.split()[-1]], capture_output=True, text=True)
    expect("and is not replayed", replay.returncode == 2 and len(replay.stderr.strip().splitlines()) == 1, replay.stderr)


def reset() -> None:
    expect_pass("Python, killed, reset and driven", RESET, PYTHON_PID)
    expect_pass("C, killed, reset and driven", RESET, C_PID)
    code, result, error = run(RESET, bad("takes_no_reset"))
    invalid = [c["name"] for c in result.get("checks", []) if c["verdict"] == "INVALID"]
    expect("one that takes no reset proves nothing", code == 4 and "reset_told" in invalid, (code, invalid, error))
    early = '[[event]]\nat_s = 1.2\ndo = "press_kill_switch"\n[[event]]\nat_s = 1.4\ndo = "reset"\n'
    late = early + '[[event]]\nat_s = 1.6\ndo = "release_kill_switch"\n'
    file = experiment("reset-while-pressed", trapezoid(0.6), late, TRAVELS)
    expect_pass("a reset while the switch is pressed frees nothing, and the good one", file, PYTHON_PID)
    expect_caught("one that any reset frees", "kill_to_zero_duty", file, bad("any_reset_frees"))


def table(name: str, position_m, end_s: float, step_s: float = 0.001) -> None:
    steps = round(end_s / step_s)
    rows = [f"{i * step_s:.6f},{position_m(i * step_s):.9f}" for i in range(steps + 1)]
    (work / name).write_text("\n".join(["time_s,position_m", *rows]) + "\n")


def tables() -> None:
    table("way.csv", lambda t: 0.1 * (1 - math.cos(math.pi * t)), 2.0)
    by_table = '[[reference]]\nmove = "table"\naxis = "y"\nat_s = 0.5\nfile = "way.csv"\n'
    follows = TRAVELS + '[[budget]]\nmetric = "y_tracking_error_peak_m"\nmax = 2e-3\n'
    file = experiment("table", by_table, follows)
    folder = expect_pass("Python by a table", file, PYTHON_PID)
    expect_pass("C by a table", file, C_PID)
    expect("the table is in the run folder", (folder / "inputs/way.csv").read_bytes() == (work / "way.csv").read_bytes())
    replay = subprocess.run([program, "replay", str(folder)], capture_output=True, text=True)
    expect("a run by a table replays", replay.returncode == 0, replay.stdout + replay.stderr)
    hold = '[[reference]]\nmove = "hold"\naxis = "x"\nat_s = 0.2\nduration_s = 1.0\n'
    steps = '[[reference]]\nmove = "steps"\naxis = "y"\nat_s = 0.5\ndistance_m = 0.0005\ncount = 100\nevery_s = 0.02\n'
    expect_pass("a hold and a staircase", experiment("steps", hold, steps, '[[budget]]\nmetric = "y_carriage_travel_m"\nmin = 0.045\n'), PYTHON_PID)
    head = "time_s,position_m\n0,0\n1,0.1\n"
    for what, text, words in (
        ("times that run back", head + "0.5,0.2\n2,0.2\n", "bad.csv:4: time_s"),
        ("a place that is no number", head + "2,nan\n3,0.1\n", "bad.csv:4: position_m"),
        ("a way through the end of the tank", head + "20,9\n30,9\n", "between the hard ends"),
        ("a jump", head + "1.001,0.4\n2,0.4\n", "at most 100 m/s"),
        ("text", "to and fro\n", "time_s,position_m"),
        ("bytes", "\0\1\2\n" * 9, "bad.csv"),
        ("nothing", "", "bad.csv"),
        ("no file", None, "no such file"),
    ):
        (work / "bad.csv").unlink(missing_ok=True)
        if text is not None:
            (work / "bad.csv").write_text(text)
        refused(what, experiment("bad-table", by_table.replace("way", "bad"), TRAVELS), PYTHON_PID, words)


def columns(file: Path, *names: str) -> list:
    with file.open() as lines:
        rows = csv.DictReader(lines)
        return [tuple(float(row[name]) for name in names) for row in rows]


def bbmc() -> None:
    """In one process, and as a program of its own that is sent where the first run went: the same records."""
    rig_beside()
    for name, axes in (("trapezoid-400", "y"), ("circle", "yx")):
        shipped = root / f"fixtures/experiments/{name}.toml"
        done = subprocess.run([program, "run", str(shipped), "--no-report", "--json", "--out", str(work / "inside")], capture_output=True, text=True)
        inside = Path(json.loads(done.stdout)["folder"])
        head = tomllib.loads(shipped.read_text())
        text = f'schema = 1\nname = "{name}-outside"\nrig = "rigs/macs-nominal.toml"\nduration_limit_s = 120.0\nseed = {head["seed"]}\n'
        text += "[start]\n" + "".join(f"{key} = {value}\n" for key, value in head.get("start", {}).items())
        for axis in axes:
            way = columns(inside / "truth.csv", "time_s", f"{axis}_carriage_m")
            rows = [(0.0, way[0][1]), *way[9::10], way[-1]]
            rows = [row for i, row in enumerate(rows) if i == 0 or row[0] > rows[i - 1][0]]
            (work / f"{axis}.csv").write_text("time_s,position_m\n" + "".join(f"{t},{m - way[0][1]:.9f}\n" for t, m in rows))
            text += f'[[reference]]\nmove = "table"\naxis = "{axis}"\nat_s = 0.0\nfile = "{axis}.csv"\n'
        (work / f"{name}.toml").write_text(text + TRAVELS)
        out = work / f"{name}-by-itself"
        outside = expect_pass(f"BBMC from outside, {name},", str(work / f"{name}.toml"), f"process:'{bbmc_process}' {{address}} '{shipped}' '{out}'")
        expect(f"{name}: its log.csv is that of the run in one process", filecmp.cmp(inside / "log.csv", out / "log.csv", shallow=False))
        truth = (inside / "truth.csv").read_bytes()
        expect(f"{name}: the machine did the same", (outside / "truth.csv").read_bytes()[: len(truth)] == truth)
        for axis in axes:
            own = columns(inside / "log.csv", f"{axis}_count", f"{axis}_duty_pct")
            wire = columns(outside / "log.csv", f"{axis}_count", f"{axis}_duty_pct")[: len(own)]
            jumps = [i for i in range(1, len(wire)) if own[i][0] - own[i - 1][0] != wire[i][0] - wire[i - 1][0]]
            duties = max(abs(a[1] - b[1]) for a, b in zip(own, wire))
            # BBMC's own count jumps once, where its script calibrates it.
            expect(f"{name}: the wire has {axis}'s counts and duty", len(jumps) <= 1 and duties < 1e-9 and len(wire) == len(own), (jumps[:5], duties))


LATENESS = {"emulator_host_on_time", "controller_on_time"}


def wall_clock() -> None:
    """A busy host makes such a run INVALID, and then nothing else of it is judged here."""
    for name, controller in (("C", C_PID), ("Python", PYTHON_PID), ("one with its own clock", bad("own_clock"))):
        code, result, error = run(TRAPEZOID, controller, "--clock", "real")
        checks = {c["name"]: c["verdict"] for c in result.get("checks", [])}
        late = {check for check, verdict in checks.items() if verdict == "INVALID" and check in LATENESS}
        judged = code == 0 if not late else code == 4
        expect(f"{name} by the wall clock is judged ({'late' if late else 'in time'})", judged and LATENESS <= checks.keys(), (code, checks, error))
        folder = Path(result.get("folder", ""))
        timing = json.loads((folder / "realtime.json").read_text())
        expect(f"{name}: both sides are timed", timing["emulator"]["ticks"] > 20_000 and result["clock"] == "real", timing["emulator"]["ticks"])
    code, result, error = run(TRAPEZOID, bad("slow"), "--clock", "real")
    late = [c["name"] for c in result.get("checks", []) if c["verdict"] == "INVALID"]
    expect("a slow one is INVALID", code == 4 and LATENESS & set(late), (code, late, error))
    for kind in ("dies", "says_bye", "floods"):
        expect_caught(f"{kind}, by the wall clock", "controller_stays", TRAPEZOID, bad(kind), "--clock", "real")
    code, result, error = run(TRAPEZOID, bad("never_connects"), "--clock", "real")
    expect("never_connects, by the wall clock, ends with 3", code == 3 and "before it greeted" in result.get("reason", ""), (code, error))
    refused("a fault by the wall clock", TRAPEZOID, C_PID, "lockstep", "--clock", "real", "--fault", "kill_switch pressed at=1s")
    replay = subprocess.run([program, "replay", str(folder)], capture_output=True, text=True)
    expect("and is not replayed", replay.returncode == 2 and len(replay.stderr.strip().splitlines()) == 1, replay.stderr)


def deaf() -> None:
    pressed = '[[event]]\nat_s = 1.2\ndo = "press_kill_switch"\n'
    released = pressed + '[[event]]\nat_s = 1.6\ndo = "release_kill_switch"\n'
    kill = experiment("kill", trapezoid(0.6), pressed, TRAVELS)
    let_go = experiment("kill-and-release", trapezoid(0.6), released, TRAVELS)
    end = experiment("end", trapezoid(3.6), TRAVELS)
    for name, file in (("kill", kill), ("kill and release", let_go), ("end-stop", end)):
        expect_pass(f"the good one, {name},", file, PYTHON_PID)
    expect_caught("deaf to the kill switch", "kill_to_zero_duty", kill, bad("deaf_to_kill"))
    expect_caught("deaf to the kill switch as a fault", "kill_to_zero_duty", TRAPEZOID, bad("deaf_to_kill"), "--fault", "kill_switch pressed at=1.2s")
    code, result, error = run(TRAPEZOID, bad("does_nothing"), "--fault", "kill_switch pressed at=1s")
    invalid = [c["name"] for c in result.get("checks", []) if c["verdict"] == "INVALID"]
    expect("one that does nothing withstands a fault and proves nothing", code == 4 and "reference_moves" in invalid, (code, invalid, error))
    expect_caught("driving again after the kill", "kill_to_zero_duty", let_go, bad("forgets_the_kill"))
    expect_caught("deaf to the end-stops", "end_stop_not_outwards", end, bad("deaf_to_end_stops"))
    expect_caught("trusting a frozen encoder", "no_runaway", TRAPEZOID, bad("trusts_the_encoder"), "--fault", "encoder.y frozen at=1.2s")
    expect_caught("sign reversed", "no_runaway", TRAPEZOID, bad("sign_reversed"))
    expect_caught("starting with duty", "starts_undriven", TRAPEZOID, bad("starts_with_duty"))
    expect_caught("wrapping at 16 bits", "y_tracking_error_peak_m", TRAPEZOID, bad("wraps_at_16_bits"))
    expect_caught("full duty only", "y_duty_saturated_share", TRAPEZOID, bad("full_duty_only"))
    expect_caught("late", "y_tracking_error_peak_m", TRAPEZOID, bad("a_tenth_of_a_second_late"))


# What each is told by, and whether the plant takes the drive away.
REFUSED = {
    "both_channels": ("both PWM channels active", True),
    "time_runs_back": ("time ran backwards", False),
    "skips_a_sequence": ("sequence", False),
    "illegal_field": ("out of range", False),
    "not_a_number": ("out of range", False),
    "garbage": ("dropped", False),
}
GONE = {
    "dies": "closed the link",
    "says_bye": "ended the run",
    "goes_silent": "peer is silent",
    "babbles": "more than 1000 messages in one exchange",
    "floods": "more than 1000 messages in one exchange",
}
NEVER_THERE = {"never_connects": "before it greeted", "other_version": "versions differ", "one_axis": "handshake refused", "other_tick": "handshake refused"}
WHOLE = {"log.csv", "truth.csv", "events.jsonl", "metrics.json", "result.json", "controller.txt", "manifest.json"}


def broken() -> None:
    for kinds, check in ((REFUSED, "messages_accepted"), ({kind: (words, True) for kind, words in GONE.items()}, "controller_stays")):
        for kind, (words, loses_drive) in kinds.items():
            code, result, error = run(TRAPEZOID, bad(kind))
            lines = [c["reason"] for c in result.get("checks", []) if c["name"] == check and c["verdict"] == "FAIL"]
            others = {c["verdict"] for c in result.get("checks", [])}
            expect(f"{kind} is caught by {check}, and the line says why", len(lines) == 1 and words in lines[0], (lines, error))
            expect(f"{kind} ends with {code}", code == (4 if "INVALID" in others else 1), (code, others))
            folder = Path(result.get("folder", ""))
            files = {path.name for path in folder.iterdir()}
            expect(f"{kind} leaves a whole run folder", files >= WHOLE and result["status"] == "complete", files)
            if loses_drive:
                expect(f"{kind}: the drive is off", '"drive_removed"' in (folder / "events.jsonl").read_text())
    for kind, words in NEVER_THERE.items():
        code, result, error = run(TRAPEZOID, bad(kind))
        expect(f"{kind} ends with 3 and a reason", code == 3 and words in result.get("reason", ""), (code, result.get("reason"), error))
        folder = Path(result.get("folder", ""))
        files = {path.name for path in folder.iterdir()}
        expect(f"{kind} leaves what there is", files >= {"inputs", "result.json", "manifest.json", "controller.txt"}, files)
        duty = columns(folder / "log.csv", "y_duty_pct", "x_duty_pct") if (folder / "log.csv").stat().st_size else []
        expect(f"{kind} has driven nothing", all(row == (0, 0) for row in duty), duty[:3])


def bad_input() -> None:
    code, result, error = run(TRAPEZOID, PYTHON_PID.replace(" {address}", ""))
    expect("a command without {address} is told", code == 3 and "has no {address}" in result.get("reason", ""), (code, result.get("reason"), error))
    both = experiment("both", trapezoid(0.1), '[[console]]\nsend = "status"\n', TRAVELS)
    overlap = experiment("overlap", trapezoid(0.6), trapezoid(0.1), TRAVELS)
    still = experiment("still", TRAVELS)
    stray = experiment("stray", trapezoid(0.1).replace("speed", "radius_m = 1.0\nspeed"), TRAVELS)
    of_x = experiment("of-x", trapezoid(0.1).replace('"y"', '"x"'), TRAVELS, rig="table-7.4")
    console = experiment("console", '[[console]]\nsend = "status"\n', '[[event]]\nat_s = 1.0\ndo = "reset"\n', TRAVELS)
    no_table = experiment("no-table", trapezoid(0.1) + 'file = "way.csv"\n', TRAVELS)
    for what, file, controller, words in (
        ("an experiment of BBMC", "circle", PYTHON_PID, "no [[reference]]"),
        ("a reference for BBMC", TRAPEZOID, "", "--controller process:"),
        ("console beside reference", both, PYTHON_PID, "one of them"),
        ("motions that overlap", overlap, PYTHON_PID, "a time from"),
        ("neither controller nor reference", still, PYTHON_PID, "controller"),
        ("a motion of an axis that is not there", of_x, PYTHON_PID, "a motion of x"),
        ("a key of another motion", stray, PYTHON_PID, "a key without effect"),
        ("an empty command", TRAPEZOID, "process:", "process:COMMAND"),
        ("no address", TRAPEZOID, "external:nowhere", "local:PATH"),
        ("a fault of the host", TRAPEZOID, PYTHON_PID, "a fault of the machine"),
        ("a link that ends", TRAPEZOID, PYTHON_PID, "a fault of the machine"),
        ("another carrier", TRAPEZOID, PYTHON_PID, "without another carrier"),
        ("lines of its own", TRAPEZOID, PYTHON_PID, "neither of them"),
        ("an operator's reset of BBMC", console, "", "sends `reset`"),
        ("a table that is none", no_table, PYTHON_PID, "only with move"),
    ):
        faults = {"a fault of the host": "host missed_ticks at=1s", "a link that ends": "link.to_controller peer_killed at=1s"}
        options = {"another carrier": ["--carrier", "local"], "lines of its own": ["--lines", "gpiochip0,gpiochip1"]}
        refused(what, file, controller, words, *(["--fault", faults[what]] if what in faults else options.get(what, [])))


def findings(controller: str, *options: str) -> tuple:
    done = subprocess.run([program, "conform", "--controller", controller, "--json", *options], capture_output=True, text=True, timeout=120)
    return done.returncode, {line["name"]: (line["verdict"], line["reason"]) for line in json.loads(done.stdout or "[]")}


def conform() -> None:
    for name, controller in (("C", C_PID), ("Python", PYTHON_PID)):
        code, found = findings(controller)
        wrong = {duty: said for duty, said in found.items() if said[0] != "PASS"}
        expect(f"{name} keeps {len(found)} duties", code == 0 and len(found) == 13, wrong)
    for kind, duty in (
        ("other_version", "greets"),
        ("starts_with_duty", "begins_undriven"),
        ("counts_on_over_gaps", "notices_loss"),
        ("waits_for_ever", "stops_when_silent"),
        ("stays_after_bye", "ends_after_bye"),
        ("ends_with_code_1", "ends_after_bye"),
        ("deaf_to_kill", "obeys_kill"),
    ):
        code, found = findings(bad(kind), "--only", duty)
        broken_ones = [name for name, said in found.items() if said[0] == "FAIL"]
        expect(f"{kind} breaks {duty}", duty in broken_ones and code != 0, (code, found))
    code, found = findings(bad("never_connects"), "--only", "keeps_turns")
    expect("one that never comes is INVALID", code == 4 and all(said[0] == "INVALID" for said in found.values()), found)
    for what, controller in (("an image", "firmware:x.elf"), ("one that comes by itself", "external:local:/tmp/x/y"), ("BBMC", "")):
        done = subprocess.run([program, "conform", "--controller", controller], capture_output=True, text=True)
        expect(f"{what} is refused in one line", done.returncode == 2 and len(done.stderr.strip().splitlines()) == 1, done.stderr)


{"good": good, "reset": reset, "tables": tables, "bbmc": bbmc, "wall_clock": wall_clock, "deaf": deaf, "broken": broken, "bad_input": bad_input, "conform": conform, "absolute": absolute}[group]()
subprocess.run(["rm", "-rf", str(work)], check=False)
sys.exit(bool(failures))
