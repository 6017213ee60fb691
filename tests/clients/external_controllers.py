"""Whole runs of controllers that the bench did not write: external_controllers.py GROUP ROOT PROGRAM C_PID

Each line of the tables is an experiment, a controller, and what the run must say: the verdict, and for a bad
controller the check that must fail. The good ones pass what the bad ones fail.
"""

import filecmp
import json
import subprocess
import sys
import tempfile
from pathlib import Path

group, root, program, c_pid = sys.argv[1], Path(sys.argv[2]), sys.argv[3], sys.argv[4]
work = Path(tempfile.mkdtemp(prefix="towbench-external-"))
PYTHON_PID = f"process:python3 '{root}/clients/python/examples/pid.py' {{address}}"
C_PID = f"process:'{c_pid}' {{address}}"
TRAPEZOID = str(root / "fixtures/any-controller/trapezoid-y.toml")
CIRCLE = str(root / "fixtures/any-controller/circle.toml")
failures = []


def bad(kind: str) -> str:
    return f"process:python3 '{root}/tests/clients/bad_controller.py' '{root}' {kind} {{address}}"


def experiment(name: str, *parts: str) -> str:
    """An experiment file beside copies of the rig and the plant that it needs."""
    for fixture in ("rigs/macs-nominal.toml", "plants/macs-nominal.toml"):
        (work / fixture).parent.mkdir(exist_ok=True)
        (work / fixture).write_text((root / "fixtures" / fixture).read_text())
    path = work / f"{name}.toml"
    head = f'schema = 1\nname = "{name}"\nrig = "rigs/macs-nominal.toml"\nduration_limit_s = 12.0\n'
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


def good() -> None:
    for name, file in (("trapezoid", TRAPEZOID), ("circle", CIRCLE)):
        one = expect_pass(f"Python, {name}", file, PYTHON_PID)
        two = expect_pass(f"Python, {name}, again", file, PYTHON_PID)
        expect_pass(f"C, {name}", file, C_PID)
        for record in ("log.csv", "truth.csv", "events.jsonl"):
            expect(f"{name}: the same {record} twice", filecmp.cmp(one / record, two / record, shallow=False))
    expect_pass("edges instead of the digest", TRAPEZOID, bad("takes_edges"))
    for fault in ("kill_switch pressed at=1.2s", "encoder.y frozen phase=cruise after=0.1s", "encoder.y dead_a at=1.3s", "kill_switch welded at=1s", "endstop.y_max stuck_closed at=1s", "link.to_controller loss at=1s", "link.to_plant corrupt_byte at=1s"):
        expect_pass(f"with {fault}", TRAPEZOID, C_PID, "--fault", fault)
    replay = subprocess.run([program, "replay", str(one)], capture_output=True, text=True)
    expect("a run of a process replays", replay.returncode == 0, replay.stdout + replay.stderr)


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
    expect_caught("driving again after the kill", "kill_to_zero_duty", let_go, bad("forgets_the_kill"))
    expect_caught("deaf to the end-stops", "end_stop_not_outwards", end, bad("deaf_to_end_stops"))
    expect_caught("trusting a frozen encoder", "no_runaway", TRAPEZOID, bad("trusts_the_encoder"), "--fault", "encoder.y frozen at=1.2s")
    expect_caught("sign reversed", "no_runaway", TRAPEZOID, bad("sign_reversed"))
    expect_caught("starting with duty", "starts_undriven", TRAPEZOID, bad("starts_with_duty"))
    expect_caught("wrapping at 16 bits", "y_tracking_error_peak_m", TRAPEZOID, bad("wraps_at_16_bits"))
    expect_caught("full duty only", "y_duty_saturated_share", TRAPEZOID, bad("full_duty_only"))
    expect_caught("late", "y_tracking_error_peak_m", TRAPEZOID, bad("a_tenth_of_a_second_late"))


def broken() -> None:
    for kind in ("both_channels", "time_runs_back", "skips_a_sequence", "illegal_field", "garbage"):
        expect_caught(kind, "messages_accepted", TRAPEZOID, bad(kind))
    for kind in ("dies", "says_bye", "goes_silent", "babbles"):
        expect_caught(kind, "controller_stays", TRAPEZOID, bad(kind))
    for kind, words in (("never_connects", "before it greeted"), ("other_version", "handshake refused"), ("one_axis", "handshake refused"), ("other_tick", "handshake refused")):
        code, result, error = run(TRAPEZOID, bad(kind))
        expect(f"{kind} ends with 3 and a reason", code == 3 and words in result.get("reason", ""), (code, result.get("reason"), error))


def bad_input() -> None:
    both = experiment("both", trapezoid(0.1), '[[console]]\nsend = "status"\n', TRAVELS)
    overlap = experiment("overlap", trapezoid(0.6), trapezoid(0.1), TRAVELS)
    still = experiment("still", TRAVELS)
    stray = experiment("stray", trapezoid(0.1).replace("speed", "radius_m = 1.0\nspeed"), TRAVELS)
    for what, file, controller, words in (
        ("an experiment of BBMC", "circle", PYTHON_PID, "no [[reference]]"),
        ("a reference for BBMC", TRAPEZOID, "", "--controller process:"),
        ("console beside reference", both, PYTHON_PID, "one of them"),
        ("motions that overlap", overlap, PYTHON_PID, "a time from"),
        ("neither controller nor reference", still, PYTHON_PID, "controller"),
        ("a key of another motion", stray, PYTHON_PID, "a key without effect"),
        ("an empty command", TRAPEZOID, "process:", "process:COMMAND"),
        ("no address", TRAPEZOID, "external:nowhere", "local:PATH"),
        ("a fault of the host", TRAPEZOID, PYTHON_PID, "a fault of the machine"),
        ("a link that ends", TRAPEZOID, PYTHON_PID, "a fault of the machine"),
    ):
        faults = {"a fault of the host": "host missed_ticks at=1s", "a link that ends": "link.to_controller peer_killed at=1s"}
        options = ["--fault", faults[what]] if what in faults else []
        arguments = [program, "run", file, "--no-report", "--out", str(work / "bad"), *(["--controller", controller] if controller else []), *options]
        done = subprocess.run(arguments, capture_output=True, text=True, timeout=60)
        lines = done.stderr.strip().splitlines()
        expect(f"{what} is refused in one line", done.returncode == 2 and len(lines) == 1 and words in lines[0], (done.returncode, done.stderr))
    expect("nothing is left of what was refused", not list((work / "bad").glob("*")))


def conform() -> None:
    def findings(controller: str, *only: str) -> tuple:
        done = subprocess.run([program, "conform", "--controller", controller, "--json", *only], capture_output=True, text=True, timeout=120)
        return done.returncode, {line["name"]: (line["verdict"], line["reason"]) for line in json.loads(done.stdout or "[]")}

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


{"good": good, "deaf": deaf, "broken": broken, "bad_input": bad_input, "conform": conform}[group]()
subprocess.run(["rm", "-rf", str(work)], check=False)
sys.exit(bool(failures))
