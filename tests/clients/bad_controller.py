"""A controller that is good but for one thing: bad_controller.py ROOT KIND ADDRESS"""

import os
import sys
import time

root, kind, address = sys.argv[1:]
sys.path[:0] = [root + "/clients/python", root + "/clients/python/examples"]
import pid  # noqa: E402
import towbench  # noqa: E402

DEAF_TO = {
    "deaf_to_kill": towbench.KILL_SWITCH,
    "deaf_to_end_stops": towbench.HALLS,
    "deaf_to_y_min": towbench.HALL_Y_MIN,
    "deaf_to_y_max": towbench.HALL_Y_MAX,
    "deaf_to_x_min": towbench.HALL_X_MIN,
    "deaf_to_x_max": towbench.HALL_X_MAX,
}
# They go on whatever the count says, or their own fault would stop them.
CREDULOUS = {*DEAF_TO, "forgets_the_kill", "any_reset_frees", "trusts_the_encoder", "sign_reversed", "wraps_at_16_bits", "trusts_an_old_count"}
LATE_BY = {"one_tick_late": 1, "a_tenth_of_a_second_late": 100}  # exchanges

if kind == "never_connects":
    sys.exit(0)
bench = towbench.connect(address)
if kind == "other_version":
    bench.greet(version=7)
if kind == "one_axis":
    bench.greet(axes=("y",))
if kind == "other_tick":
    bench.greet(tick_ns=50_000)
absolute = ("y",) if kind in ("follows_absolute", "trusts_an_old_count") else ()
bench.greet(reference=True, resets=kind != "takes_no_reset", edges=kind == "takes_edges", absolute=absolute)
pid.SETTINGS.update({f"{axis}.absolute": 1.0 for axis in absolute})
if kind == "waits_for_ever":
    bench.silence_s = 60.0
loops = [pid.Pid("y"), pid.Pid("x")]
bench.enable("y", "x")
stopped = ""
history = []


def count_as_seen(axis: str) -> int:
    count = bench.axes[axis].count
    return (count + 32768) % 65536 - 32768 if kind == "wraps_at_16_bits" else count


def duties_of_good_one() -> dict:
    duties = {}
    for loop in loops:
        true_count = bench.axes[loop.axis].count
        bench.axes[loop.axis].count = count_as_seen(loop.axis)
        brakes = stopped == "end-stop"
        duties[loop.axis] = loop.braking_duty(bench) if brakes else 0.0 if stopped else loop.duty(bench)
        loop.count_before = bench.axes[loop.axis].count
        bench.axes[loop.axis].count = true_count
    return duties


def turn_by_its_own_clock() -> bool:
    """Sends, and takes what has come in a millisecond, whether anything has or not."""
    bench.send(towbench.HEARTBEAT, bench.now_ns, 0)
    bench.port.send(bytes(bench._out))
    bench._out.clear()
    end_s = time.monotonic() + 0.001
    while (left_s := end_s - time.monotonic()) > 0:
        for payload in bench.framing.feed(bench.port.receive(left_s)):
            if bench._take(payload) == towbench.BYE:
                return False
    return True


while True:
    now_s = bench.now_ns * 1e-9
    bench.lines &= ~DEAF_TO.get(kind, 0)
    if kind == "forgets_the_kill" and not bench.lines & towbench.KILL_SWITCH:
        stopped = ""
    if kind == "any_reset_frees" and bench.reset:
        stopped = ""
        bench.lines &= ~towbench.KILL_SWITCH
    if kind in ("counts_on_over_gaps", "trusts_an_old_count"):
        bench.counts.sequence_gaps = 0
    reason = pid.reason_to_stop(bench, loops)
    if reason in ("kill switch", "end-stop") or kind not in CREDULOUS:
        stopped = "kill switch" if reason == "kill switch" else stopped or reason
    duties = duties_of_good_one()
    if kind == "sign_reversed":
        duties = {axis: -duty for axis, duty in duties.items()}
    if kind == "starts_with_duty" and now_s < 0.05:
        duties["y"] = 0.02
    if kind == "full_duty_only":
        duties = {axis: (duty > 0) - (duty < 0) for axis, duty in duties.items()}
    if kind in LATE_BY:
        history.append(duties)
        duties = history[max(0, len(history) - 1 - LATE_BY[kind])]
    if kind == "does_nothing":
        duties = dict.fromkeys(duties, 0.0)
    for axis, duty in duties.items():
        bench.drive(axis, duty, enable=kind in LATE_BY or stopped != "kill switch")
    if now_s > 1.0:
        if kind == "both_channels":
            bench.send(towbench.PWM_DUTY, 0, 1, 100, 100, 1000, bench.axes["y"]._duty_sequence)
        if kind == "time_runs_back":
            bench.send(towbench.ADVANCE, 0)
        if kind == "skips_a_sequence":
            bench.axes["y"]._duty_sequence += 1
        if kind == "illegal_field":
            bench.send(towbench.PWM_DUTY, 0, 1, 2000, 0, 1000, bench.axes["y"]._duty_sequence)
        if kind == "not_a_number":
            bench.send(towbench.CURRENT_SAMPLE, 0, bench.now_ns, float("nan"))
        if kind == "floods":
            for _ in range(2000):
                bench.drive("y", 0.0)
        if kind == "slow" and now_s > 1.2:
            time.sleep(0.05)
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
    if not (turn_by_its_own_clock() if kind == "own_clock" else bench.turn()):
        break
if kind == "stays_after_bye":
    time.sleep(5)
if kind == "ends_with_code_1":
    sys.exit(1)
