"""figures.py against motions in closed form."""

import math
import sys
import tempfile
from pathlib import Path

import figures

RADIUS_M, PERIOD_S, TURNS, BEGINS_S = 0.1, 2.0, 3, 0.5
RAMP_S = math.pi / 2 * PERIOD_S / 4
STEP_S = 1e-3
failures = []


def expect(what: str, found: float, wanted: float, within: float) -> None:
    if not abs(found - wanted) <= within:
        failures.append(what)
        print(f"WRONG {what}: {found}, not {wanted}")


def write(folder: Path, angle_of, off_m: float, lag_s: float, duty_until_s: float, turns: int = 1) -> None:
    """A circle that is too large by off_m, late by lag_s, and whose duty is 10 %, with 1 % of ripple, to a time."""
    logs, truths = [], []
    for i in range(int((BEGINS_S + RAMP_S + PERIOD_S * TURNS + 0.5) / STEP_S)):
        time_s = i * STEP_S
        wanted, real = turns * angle_of(time_s), turns * angle_of(time_s - lag_s)
        rate = turns * (angle_of(time_s + STEP_S) - angle_of(time_s - STEP_S)) / (2 * STEP_S)
        large = RADIUS_M + off_m
        reference = [0.3 + RADIUS_M * (math.cos(wanted) - 1), 0.2 + RADIUS_M * math.sin(wanted)]
        speed = [-RADIUS_M * rate * math.sin(wanted), RADIUS_M * rate * math.cos(wanted)]
        place = [0.3 - RADIUS_M + large * math.cos(real), 0.2 + large * math.sin(real)]
        duty = 10 + i % 2 if time_s < duty_until_s else 0
        axes = ",".join(f"{r},{v},{p},{duty}" for r, v, p in zip(reference, speed, place))
        logs.append(f"{time_s:.4f},{axes}")
        truths.append(f"{time_s:.4f},{place[0]},{place[1]}")
    columns = ("reference_m", "reference_velocity_m_per_s", "position_m", "duty_pct")
    head = ",".join(["time_s", *(f"{axis}_{column}" for axis in "yx" for column in columns)])
    (folder / "log.csv").write_text("\n".join([head, *logs]) + "\n", encoding="ascii")
    (folder / "truth.csv").write_text("\n".join(["time_s,y_carriage_m,x_carriage_m", *truths]) + "\n", encoding="ascii")


def angle(time_s: float) -> float:
    """At once at full speed, which lasts until all turns are done; before and after it rests."""
    return 2 * math.pi * min(max(time_s - BEGINS_S, 0.0) / PERIOD_S, TURNS)


for turns in (1, -1):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write(folder, angle, 150e-6, 4e-3, duty_until_s=3.0, turns=turns)
        expect("the last motion's begin", figures.start_s(folder), BEGINS_S, 1.5 * STEP_S)
        found = figures.circle(folder, RADIUS_M, PERIOD_S, TURNS)
        for side in ("motor", "carriage"):
            expect(f"least of the {side}", found[side][0], 150, 1)
            expect(f"largest of the {side}", found[side][1], 150, 1)
        expect("lag", found["lag_ms"], 4.0, 0.01)
        off, way = figures.reaction(folder, 2.5)
        expect("drive off", float(off), 500, 1)
        expect("way", float(way), 2e3 * (RADIUS_M + 150e-6), 0.5)
        write(folder, angle, 0.0, 0.0, duty_until_s=1e9, turns=turns)
        if figures.reaction(folder, 2.5)[0] != "to the end":
            failures.append("driven to the end")
sys.exit(bool(failures))
