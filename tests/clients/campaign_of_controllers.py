"""The standard campaign, of controllers that the bench did not write: campaign_of_controllers.py GROUP ROOT PROGRAM C_PID [NAME...]

`guard` takes a few cases of it, `whole` all: the good ones keep everything, and each bad one is caught in some case.
`each` gives each bad one the cases alone that are meant for it. Names (C, Python, a bad one's kind) are those that are
tried of `whole` and `each`; all without any.
"""

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

group, root, program, c_pid = sys.argv[1], Path(sys.argv[2]), sys.argv[3], sys.argv[4]
work = tempfile.TemporaryDirectory(prefix="towbench-campaign-")
C_PID = f"process:'{c_pid}' {{address}}"
PYTHON_PID = f"process:python3 '{root}/clients/python/examples/pid.py' {{address}}"
GOOD = {"C": C_PID, "Python": PYTHON_PID}
# What each is caught by. X comes to its lower end at 30 mm/s, too slowly for end_stop_not_outwards.
BAD = {
    "deaf_to_kill": "kill_to_zero_duty",
    "forgets_the_kill": "kill_to_zero_duty",
    "deaf_to_y_max": "end_stop_not_outwards",
    "deaf_to_y_min": "end_stop_not_outwards",
    "deaf_to_x_max": "end_stop_not_outwards",
    "deaf_to_x_min": "no_hard_end",
    "trusts_the_encoder": "no_runaway",
    "starts_with_duty": "starts_undriven",
    "wraps_at_16_bits": "y_tracking_error_peak_m",
    "sign_reversed": "no_runaway",
    "one_tick_late": "obeys_kill",
    "waits_for_ever": "stops_when_silent",
    "full_duty_only": "y_duty_saturated_share",
}
# The cases that are meant for it.
MEANT = {
    "deaf_to_kill": "any-trapezoid-y/kill_switch.pressed/cruise",
    "forgets_the_kill": "any-trapezoid-y/kill_switch.released_without_reset/cruise",
    "deaf_to_y_max": "any-end-y-max/no.fault",
    "deaf_to_y_min": "any-there-and-back-y/endstop.y_min.stuck_closed",
    "deaf_to_x_max": "any-end-x-max/no.fault",
    "deaf_to_x_min": "any-end-x-min/no.fault",
    "trusts_the_encoder": "any-trapezoid-y/encoder.y.frozen",
    "starts_with_duty": "any-trapezoid-y/no.fault",
    "wraps_at_16_bits": "any-trapezoid-y/no.fault",
    "sign_reversed": "any-trapezoid-y/no.fault",
    "one_tick_late": "protocol/obeys_kill",
    "waits_for_ever": "protocol/stops_when_silent",
    "full_duty_only": "any-trapezoid-y/no.fault",
}
failures = []


def expect(what: str, holds: bool, detail: object = "") -> None:
    print(("ok    " if holds else "WRONG ") + what, "" if holds else detail, flush=True)
    if not holds:
        failures.append(what)


def campaign(controller: str, only: str = "") -> tuple:
    """Exit code, results, what was printed, seconds."""
    out = tempfile.mkdtemp(dir=work.name)
    began = time.monotonic()
    done = subprocess.run(
        [program, "campaign", "standard", "--controller", controller, "--out", out, "--quiet", *(["--only", only] if only else [])],
        capture_output=True,
        text=True,
    )
    took_s = time.monotonic() - began
    file = Path(out) / "results.jsonl"
    results = [json.loads(line) for line in file.read_text().splitlines()] if file.exists() else []
    return done.returncode, results, done.stdout + done.stderr, took_s


def verdicts(results: list) -> dict:
    names = [line["verdict"] for line in results]
    return {name: names.count(name) for name in ("PASS", "FAIL", "INVALID")}


def good(name: str, controller: str, at_least: int, only: str = "") -> None:
    code, results, said, took_s = campaign(controller, only)
    counted = verdicts(results)
    wrong = [(line["case"], line.get("broken")) for line in results if line["verdict"] != "PASS"]
    enough = len(results) >= at_least
    expect(f"{name}: {len(results)} cases in {took_s:.0f} s, none broken", code == 0 and enough, (code, counted, wrong[:3], said[-400:]))


def bad(kind: str, only: str = "") -> None:
    by = BAD[kind]
    controller = f"process:python3 '{root}/tests/clients/bad_controller.py' '{root}' {kind} {{address}}"
    code, results, said, took_s = campaign(controller, only)
    caught = [line for line in results if by in [broken["rule"] for broken in line.get("broken", [])]]
    what = f"{kind}: caught by {by} in {len(caught)} of {len(results)} cases, {verdicts(results)}, {took_s:.0f} s"
    expect(what, code in (1, 4) and bool(caught), (code, said[-400:]))


if group == "guard":
    good("C", C_PID, 8, "any-trapezoid-y/kill_switch")
    good("C, the protocol's duties", C_PID, 13, "protocol/")
    bad("waits_for_ever", "protocol/stops_when_silent")
    bad("deaf_to_kill", "any-trapezoid-y/kill_switch.pressed/cruise")
    code, results, said, took_s = campaign("process:/nonexistent {address}", "any-end-y-max")
    invalid = [line["verdict"] for line in results] == ["INVALID"] * len(results)
    expect(f"one that never comes: {len(results)} cases, all INVALID", code == 4 and results and invalid, (code, said[-400:]))
elif group == "each":
    for kind in sys.argv[5:] or BAD:
        bad(kind, MEANT[kind])
else:
    names = sys.argv[5:] or ["C", "Python", *BAD]
    for name in names:
        if name in GOOD:
            good(name, GOOD[name], 460)
        else:
            bad(name)
work.cleanup()
sys.exit(bool(failures))
