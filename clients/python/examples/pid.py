"""A PID position controller for two axes: python3 pid.py ADDRESS"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import towbench  # noqa: E402

METRES_PER_COUNT = {"y": 2.24545e-6, "x": 1.34727e-6}
INERTIA = {"y": 0.13, "x": 0.06}  # duty per m/s2: the amplifier sets the current
PROPORTIONAL, INTEGRAL, DERIVATIVE = 4600.0, 20000.0, 120.0  # m/s2 per m, per m s, per m/s
BRAKE = 20.0  # m/s2 per m/s
LARGEST_ERROR_M = 0.01
FILTER = 0.5  # share of the newest slope


class Pid:
    def __init__(self, axis: str) -> None:
        self.axis = axis
        self.integral = 0.0
        self.slope = 0.0
        self.error_before = 0.0
        self.count_before = 0

    def braking_duty(self, bench: towbench.Bench) -> float:
        moved_m = METRES_PER_COUNT[self.axis] * (bench.axes[self.axis].count - self.count_before)
        return -INERTIA[self.axis] * BRAKE * moved_m / (bench.exchange_ns * 1e-9)

    def error(self, bench: towbench.Bench) -> float:
        state = bench.axes[self.axis]
        return state.reference.position_m - METRES_PER_COUNT[self.axis] * state.count

    def duty(self, bench: towbench.Bench) -> float:
        period_s = bench.exchange_ns * 1e-9
        error = self.error(bench)
        self.slope += FILTER * ((error - self.error_before) / period_s - self.slope)
        self.error_before = error
        feedback = PROPORTIONAL * error + INTEGRAL * self.integral + DERIVATIVE * self.slope
        acceleration = bench.axes[self.axis].reference.acceleration_m_per_s2
        wanted = INERTIA[self.axis] * (acceleration + feedback)
        if abs(wanted) < 1.0:  # no wind-up while the duty is at its limit
            self.integral += error * period_s
        return max(-1.0, min(1.0, wanted))


def main() -> None:
    bench = towbench.connect(sys.argv[1])
    bench.greet(reference=True)
    loops = [Pid("y"), Pid("x")]
    bench.enable("y", "x")
    stopped, killed = "", False
    while True:
        if not stopped:
            stopped = reason_to_stop(bench, loops)
            if stopped:
                print(f"{bench.now_ns * 1e-9:.3f} s: {stopped}", flush=True)
        for loop in loops:
            killed = killed or bool(bench.lines & towbench.KILL_SWITCH)
            duty = 0.0 if killed else loop.braking_duty(bench) if stopped else loop.duty(bench)
            bench.drive(loop.axis, duty, enable=not killed)
            loop.count_before = bench.axes[loop.axis].count
        if not bench.turn():
            return


def reason_to_stop(bench: towbench.Bench, loops: list) -> str:
    if bench.lines & towbench.KILL_SWITCH:
        return "kill switch"
    if bench.lines & towbench.HALLS:
        return "end-stop"
    if bench.counts.sequence_gaps:
        return "a message was lost"
    far = [loop.axis for loop in loops if abs(loop.error(bench)) > LARGEST_ERROR_M]
    return f"tracking error of {far[0]}" if far else ""


if __name__ == "__main__":
    main()
