#!/usr/bin/env python3
"""A person at the far end of a serial console: types one line after another, each when the prompt is back.

usage: typing_operator.py DEVICE LINE...      the last line ends the session and is not waited for
exit code: 0 each line was answered with ok; else 1
"""
import os
import select
import sys
import time
import tty

PROMPT = "bbmc> "
PATIENCE_s = 120.0


def hear(terminal, patience_s):
    """What was printed up to the next prompt, or in that time."""
    heard, deadline = "", time.monotonic() + patience_s
    while time.monotonic() < deadline and not heard.endswith(PROMPT):
        if select.select([terminal], [], [], 0.1)[0]:
            heard += os.read(terminal, 4096).decode(errors="replace")
    return heard


def wake(terminal):
    """Whether somebody is there: who opens a port throws away what came before."""
    deadline = time.monotonic() + PATIENCE_s
    while time.monotonic() < deadline:
        os.write(terminal, b"\r")
        if hear(terminal, 1.0).endswith(PROMPT):
            while hear(terminal, 1.0):
                pass
            return True
    return False


def main():
    terminal = os.open(sys.argv[1], os.O_RDWR | os.O_NOCTTY)
    tty.setraw(terminal)
    good = wake(terminal)
    for line in sys.argv[2:-1] if good else []:
        os.write(terminal, (line + "\r").encode())
        answer = hear(terminal, PATIENCE_s)
        print(answer)
        good = good and answer.endswith(PROMPT) and "\nok" in answer
    os.write(terminal, (sys.argv[-1] + "\r").encode())
    return 0 if good else 1


sys.exit(main())
