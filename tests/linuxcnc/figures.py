"""What the records of a run say of a circle and of a reaction, the same for every controller."""

import csv
import math
from pathlib import Path


def rows_of(file: Path) -> list:
    with open(file, encoding="ascii") as lines:
        return list(csv.DictReader(lines))


def start_s(folder: Path) -> float:
    """When the reference begins to move for the last time after a rest."""
    begun = 0.0
    rests = True
    for row in rows_of(folder / "log.csv"):
        moves = any(float(row[f"{axis}_reference_velocity_m_per_s"]) != 0 for axis in "yx")
        if moves and rests:
            begun = float(row["time_s"])
        rests = not moves
    return begun


def middle(places) -> float:
    places = list(places)
    return (min(places) + max(places)) / 2


def circle(folder: Path, radius_m: float, period_s: float, turns: int) -> dict:
    """Of the part at full speed: how far the radius is off (least, largest; um), the lag behind the reference, the duty's ripple."""
    begun = start_s(folder)
    ramp_s = math.pi / 2 * period_s / 4
    from_s, to_s = begun + ramp_s, begun + period_s * turns
    log = rows_of(folder / "log.csv")
    centre = {axis: middle(float(row[f"{axis}_reference_m"]) for row in log if float(row["time_s"]) >= begun) for axis in "yx"}
    truth = {row["time_s"]: row for row in rows_of(folder / "truth.csv")}
    off = {"motor": [], "carriage": []}
    lags, changes, before = [], [], None
    for row in log:
        if not from_s <= float(row["time_s"]) <= to_s:
            continue
        place = {axis: float(row[f"{axis}_position_m"]) - centre[axis] for axis in "yx"}
        wanted = {axis: float(row[f"{axis}_reference_m"]) - centre[axis] for axis in "yx"}
        off["motor"].append(1e6 * (math.hypot(place["y"], place["x"]) - radius_m))
        behind = math.atan2(wanted["x"], wanted["y"]) - math.atan2(place["x"], place["y"])
        turns_on = wanted["y"] * float(row["x_reference_velocity_m_per_s"]) - wanted["x"] * float(row["y_reference_velocity_m_per_s"])
        lags.append(math.copysign(1e3 * period_s / (2 * math.pi), turns_on) * math.remainder(behind, 2 * math.pi))
        true = truth.get(row["time_s"])
        if true:
            off["carriage"].append(1e6 * (math.hypot(*(float(true[f"{axis}_carriage_m"]) - centre[axis] for axis in "yx")) - radius_m))
        duty = float(row["y_duty_pct"])
        changes += [] if before is None else [(duty - before) ** 2]
        before = duty
    return {
        "motor": (min(off["motor"]), max(off["motor"])),
        "carriage": (min(off["carriage"]), max(off["carriage"])),
        "lag_ms": sum(lags) / len(lags),
        "ripple_pct": math.sqrt(sum(changes) / len(changes)),
    }


def reaction(folder: Path, at_s: float) -> tuple:
    """How long after the fault an axis is driven last, in ms, or "to the end"; how far an axis moves from then on, in mm."""
    log = rows_of(folder / "log.csv")
    driven = [float(row["time_s"]) for row in log if any(float(row[f"{axis}_duty_pct"]) != 0 for axis in "yx")]
    end_s = float(log[-1]["time_s"])
    last_s = driven[-1] if driven else 0.0
    step_s = float(log[1]["time_s"]) - float(log[0]["time_s"])
    off = "to the end" if last_s >= end_s - step_s else f"{max(0.0, 1e3 * (last_s + step_s - at_s)):.0f}"
    way_m = 0.0
    truth = [row for row in rows_of(folder / "truth.csv") if float(row["time_s"]) >= at_s]
    for axis in "yx":
        places = [float(row[f"{axis}_carriage_m"]) for row in truth]
        way_m = max(way_m, max(abs(place - places[0]) for place in places)) if places else way_m
    return off, f"{1e3 * way_m:.1f}"
