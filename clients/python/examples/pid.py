"""A PID position controller: python3 pid.py ADDRESS [AXES [NAME=VALUE ...]], AXES of yxzabc, yx if not told"""

import sys

sys.path.insert(1, sys.path[0] + "/..")
import towbench  # noqa: E402

# Of the tow tank, inertia in duty per m/s2. NAME=VALUE: of another machine, AXIS.NAME=VALUE of one axis; rad for m where it turns.
SETTINGS = {
    **{"metres_per_count": 2.24545e-6, "inertia": 0.13, "x.metres_per_count": 1.34727e-6, "x.inertia": 0.06},
    **{"proportional": 4600.0, "integral": 20000.0, "derivative": 120.0},  # m/s2 per m, per m s, per m/s
    **{"brake": 20.0, "filter": 0.5, "largest_error": 0.01},  # m/s2 per m/s, share of the newest slope, m
    **{"stall_duty": 0.06, "stall_counts": 2.0, "stall_s": 0.04, "absolute": 0.0, "holding_brake": 0.0},  # 1: the axis has it
}


class Pid:
    def __init__(self, axis: str) -> None:
        vars(self).update({name: SETTINGS.get(f"{axis}.{name}", value) for name, value in SETTINGS.items()})
        self.axis, self.still_count, self.count_before, self.stalled_s = axis, 0, 0, 0.0
        self.summed = self.slope = self.error_before = 0.0

    def braking_duty(self, bench: towbench.Bench) -> float:
        moved_m = self.metres_per_count * (bench.axes[self.axis].way - self.count_before)
        return -self.inertia * self.brake * moved_m / (bench.exchange_ns * 1e-9)

    def error(self, bench: towbench.Bench) -> float:
        return bench.axes[self.axis].reference.position_m - self.metres_per_count * bench.axes[self.axis].way

    def duty(self, bench: towbench.Bench) -> float:
        period_s = bench.exchange_ns * 1e-9
        error = self.error(bench)
        self.slope += self.filter * ((error - self.error_before) / period_s - self.slope)
        self.error_before = error
        feedback = self.proportional * error + self.integral * self.summed + self.derivative * self.slope
        wanted = self.inertia * (bench.axes[self.axis].reference.acceleration_m_per_s2 + feedback)
        self.summed += error * period_s if abs(wanted) < 1.0 else 0.0  # no wind-up while the duty is at its limit
        stays = abs(bench.axes[self.axis].way - self.still_count) <= self.stall_counts
        self.still_count = self.still_count if stays else bench.axes[self.axis].way
        stalls = (stays and abs(wanted) > self.stall_duty) or abs(wanted) >= 1.0
        self.stalled_s = self.stalled_s + period_s if stalls else 0.0
        return max(-1.0, min(1.0, wanted))


def main() -> None:
    axes = tuple(sys.argv[2]) if len(sys.argv) > 2 else ("y", "x")
    for name, _, value in (word.partition("=") for word in sys.argv[3:]):
        known = (name[2:] if name[:1] in towbench.AXES and name[1:2] == "." else name) in SETTINGS
        SETTINGS.pop(f"x.{name}", None)
        SETTINGS[name] = float(value) if known else sys.exit(f"{name}: given an unknown setting; allowed: {', '.join(SETTINGS)}")
    bench = towbench.connect(sys.argv[1])
    loops, stopped, killed = [Pid(axis) for axis in axes], "", False
    bench.greet(reference=True, resets=True, axes=axes, absolute=tuple(loop.axis for loop in loops if loop.absolute))
    while True:
        if bench.reset and not bench.lines & towbench.KILL_SWITCH:  # the operator asks to go on
            loops, stopped, killed = [Pid(axis) for axis in axes], "", False
        if not stopped and (stopped := reason_to_stop(bench, loops)):
            print(f"{bench.now_ns * 1e-9:.3f} s: {stopped}", flush=True)
        killed = killed or bool(bench.lines & towbench.KILL_SWITCH)
        brakes = stopped == "end-stop" and not killed  # otherwise the count is not to be believed
        bench.enable(*axes, released=tuple(p.axis for p in loops if p.holding_brake and (brakes or not stopped)))
        for loop in loops:
            duty = loop.braking_duty(bench) if brakes else 0.0 if stopped else loop.duty(bench)
            bench.drive(loop.axis, duty, enable=not killed)
            loop.count_before = bench.axes[loop.axis].way
        if not bench.turn():
            return


def reason_to_stop(bench: towbench.Bench, loops: list) -> str:
    if bench.lines & (towbench.KILL_SWITCH | towbench.HALLS):
        return "kill switch" if bench.lines & towbench.KILL_SWITCH else "end-stop"
    if bench.counts.sequence_gaps:
        return "a message was lost"
    lost = [p.axis for p in loops if abs(p.error(bench)) > p.largest_error or p.stalled_s > p.stall_s]
    return f"{lost[0]} does not follow" if lost else ""


if __name__ == "__main__":
    towbench.run(main)
