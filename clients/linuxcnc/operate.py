#!/usr/bin/python3
"""The operator of LinuxCNC: homes, goes back to where the run began, and starts the program with the bench's reference.

What it does it says; LinuxCNC does the rest. Started by LinuxCNC as its display.
"""

import subprocess
import sys
import time

import hal
import linuxcnc

command, status, errors = linuxcnc.command(), linuxcnc.stat(), linuxcnc.error_channel()
began = time.monotonic()
said = open(sys.path[0] + "/said", "w", encoding="ascii", errors="replace")
component = hal.component("operator")
component.ready()


def say(text: str) -> None:
    print(f"{time.monotonic() - began:7.3f} s: {text}", file=said, flush=True)


def ended() -> bool:
    return hal.get_value("towbench.ended")


def wait_for(what: str, holds, patience_s: float = 60.0) -> None:
    """Ends the operator when it does not come."""
    deadline = time.monotonic() + patience_s
    while True:
        status.poll()
        if holds():
            return say(what)
        message = errors.poll()
        if message:
            say(f"LinuxCNC: {message[1]}")
        if ended() or time.monotonic() > deadline:
            say(f"gives up: no {what}")
            return finish()
        time.sleep(0.005)


def give_priority() -> None:
    """LinuxCNC asks the kernel for more than some have (iopl), and without it takes no real-time priority for its thread."""
    process = subprocess.run(["pidof", "rtapi_app"], capture_output=True, text=True, check=False).stdout.split()
    change = ["chrt", "--all-tasks", "--fifo", "--pid", "40", *process]
    done = subprocess.run(change, capture_output=True, text=True, check=False).returncode == 0
    say("real-time priority" if done else "no real-time priority: not root's to give")


def finish() -> None:
    while not ended():
        message = errors.poll()
        if message:
            say(f"LinuxCNC: {message[1]}")
        time.sleep(0.005)
    say("the bench has ended the run")
    sys.exit(0)


def place_of_start(joint: int, channel: int) -> float:
    """In the machine's coordinates, of an axis that stands."""
    moved = hal.get_value(f"towbench.count-{channel}") * hal.get_value(f"towbench.scale-{channel}")
    return status.joint_actual_position[joint] - moved


def home() -> None:
    command.mode(linuxcnc.MODE_MANUAL)
    command.wait_complete()
    command.teleop_enable(0)
    command.wait_complete()
    command.home(-1)
    wait_for("homed", lambda: all(status.homed[:2]) and status.inpos)


def go_to_start() -> None:
    x, y = place_of_start(0, 1), place_of_start(1, 0)
    command.mode(linuxcnc.MODE_MDI)
    command.wait_complete()
    command.mdi(f"G21 G90 G53 G0 X{x:.4f} Y{y:.4f}")
    near = lambda joint, place: abs(status.joint_actual_position[joint] - place) < 0.02
    wait_for(f"place of the start, X {x:.3f} Y {y:.3f} mm", lambda: near(0, x) and near(1, y) and status.inpos)


def setting(program: str, name: str) -> str:
    """Of the words in the first line, a comment."""
    with open(program, encoding="ascii") as file:
        words = file.readline().strip("()\n").split()
    return words[words.index(name) + 1]


def run_program() -> None:
    command.mode(linuxcnc.MODE_AUTO)
    command.wait_complete()
    program = sys.path[0] + "/program.ngc"
    command.program_open(program)
    command.wait_complete()
    hal.set_p("towbench.delay", setting(program, "delay"))
    hal.set_p("towbench.await-reference", "1")
    command.auto(linuxcnc.AUTO_RUN, 0)
    wait_for("program waits", lambda: status.interp_state != linuxcnc.INTERP_IDLE)
    wait_for("reference", lambda: not hal.get_value("towbench.hold"))
    wait_for("program at its end", lambda: status.interp_state == linuxcnc.INTERP_IDLE)


give_priority()
wait_for("bench", lambda: hal.get_value("towbench.ok"))
command.state(linuxcnc.STATE_ESTOP_RESET)
wait_for("no emergency stop", lambda: status.task_state != linuxcnc.STATE_ESTOP)
command.state(linuxcnc.STATE_ON)
wait_for("machine on", lambda: status.enabled)
home()
go_to_start()
run_program()
finish()
