"""A controller that is good but for one thing: bad_controller.py ROOT KIND ADDRESS"""

import os
import sys
import time

root, kind, address = sys.argv[1:]
sys.path[:0] = [root + "/clients/python", root + "/clients/python/examples"]
import pid  # noqa: E402
import towbench  # noqa: E402

if kind == "never_connects":
    sys.exit(0)
bench = towbench.connect(address)
if kind == "other_version":
    bench.greet(version=7)
if kind == "one_axis":
    bench.greet(axes=("y",))
if kind == "other_tick":
    bench.greet(tick_ns=50_000)
bench.greet(reference=True, edges=kind == "takes_edges")
loops = [pid.Pid("y"), pid.Pid("x")]
bench.enable("y", "x")
stopped = False
history = []


def count_as_seen(axis: str) -> int:
    count = bench.axes[axis].count
    return (count + 32768) % 65536 - 32768 if kind == "wraps_at_16_bits" else count


while True:
    now_s = bench.now_ns * 1e-9
    lines = bench.lines
    if kind == "deaf_to_kill":
        lines &= ~towbench.KILL_SWITCH
    if kind == "deaf_to_end_stops":
        lines &= ~towbench.HALLS
    if kind == "forgets_the_kill" and not lines & towbench.KILL_SWITCH:
        stopped = False
    far = any(abs(loop.error(bench)) > pid.LARGEST_ERROR_M for loop in loops)
    if kind in ("forgets_the_kill", "deaf_to_kill", "deaf_to_end_stops", "trusts_the_encoder", "sign_reversed", "wraps_at_16_bits"):
        far = False
    stopped = stopped or bool(lines & (towbench.KILL_SWITCH | towbench.HALLS)) or far
    duties = {}
    for loop in loops:
        true_count = bench.axes[loop.axis].count
        bench.axes[loop.axis].count = count_as_seen(loop.axis)
        duties[loop.axis] = 0.0 if stopped else loop.duty(bench)
        bench.axes[loop.axis].count = true_count
    if kind == "sign_reversed":
        duties = {axis: -duty for axis, duty in duties.items()}
    if kind == "starts_with_duty" and now_s < 0.05:
        duties["y"] = 0.02
    if kind == "full_duty_only":
        duties = {axis: (duty > 0) - (duty < 0) for axis, duty in duties.items()}
    if kind == "a_tenth_of_a_second_late":
        history.append(duties)
        duties = history[max(0, len(history) - 100)]
    for axis, duty in duties.items():
        bench.drive(axis, duty, enable=True if kind == "deaf_to_kill" else not stopped)
    if now_s > 1.0:
        if kind == "both_channels":
            bench.send(towbench.PWM_DUTY, 0, 1, 100, 100, 1000, bench.axes["y"]._duty_sequence)
        if kind == "time_runs_back":
            bench.send(towbench.ADVANCE, 0)
        if kind == "skips_a_sequence":
            bench.axes["y"]._duty_sequence += 1
        if kind == "illegal_field":
            bench.send(towbench.PWM_DUTY, 0, 1, 2000, 0, 1000, bench.axes["y"]._duty_sequence)
        if kind == "garbage":
            bench._out += os.urandom(64)
        if kind == "dies":
            os._exit(3)
        if kind == "says_bye":
            bench.send(towbench.BYE, bench.now_ns)
        if kind == "goes_silent":
            time.sleep(5)
        if kind == "babbles":
            while True:
                bench.port.send(bench.framing.frame(towbench.encode(towbench.HEARTBEAT, 0, 0)))
    if not bench.turn():
        break
