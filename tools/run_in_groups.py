#!/usr/bin/env python3
"""Runs the tests that ctest lists, many tests of one GoogleTest program in one process.

usage: run_in_groups.py JOBS FOLDER SLOW [ctest arguments that select...]

A program takes longer to start than most of its tests to run, above all under a sanitizer. Tests whose names SLOW (a
regular expression) matches start first, few in a process. Prints what ctest prints of each test. A test that its
process does not report as passed or skipped has failed: a crash fails what comes behind it.
Exit: 0 all passed, 8 some failed, 1 no tests.
"""

import contextlib
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor, as_completed

IN_A_GROUP = 24
SLOW_IN_A_GROUP = 3
SECONDS = 900
RUNNING: set[int] = set()  # sessions of the tests under way
REPORTED = re.compile(r"^\[ +(OK|FAILED|SKIPPED) +\] (\S+?)(?:, where .*)? \((\d+) ms\)$", re.MULTILINE)


def listed(folder: str, selection: list[str]) -> list[dict]:
    said = subprocess.run(["ctest", "--test-dir", folder, "--show-only=json-v1", *selection], stdout=subprocess.PIPE, check=True)
    return json.loads(said.stdout)["tests"]


def properties(test: dict) -> dict:
    return {entry["name"]: entry["value"] for entry in test.get("properties", [])}


def filter_of(test: dict) -> str | None:
    """The full name within its GoogleTest program, or none for another command."""
    for argument in test["command"][1:]:
        if argument.startswith("--gtest_filter="):
            return argument.removeprefix("--gtest_filter=")
    return None


def parted(tests: list[dict], most: int) -> list[list[dict]]:
    """Groups of one program each."""
    by_program: dict[str, list[dict]] = {}
    for test in tests:
        by_program.setdefault(test["command"][0], []).append(test)
    return [group[i : i + most] for group in by_program.values() for i in range(0, len(group), most)]


def groups_of(tests: list[dict], slow: str) -> list[list[dict]]:
    """Commands first, the longest before all; then slow tests; then the others."""
    alone = [test for test in tests if filter_of(test) is None or properties(test).get("PROCESSORS")]
    alone.sort(key=lambda test: -float(properties(test).get("COST", 0)))
    shared = [test for test in tests if test not in alone]
    late = [test for test in shared if not re.search(slow, test["name"])]
    early = [test for test in shared if re.search(slow, test["name"])]
    return [[test] for test in alone] + parted(early, SLOW_IN_A_GROUP) + parted(late, IN_A_GROUP)


class Slots:
    """As many as jobs run at a time; a test takes as many as it has processors."""

    def __init__(self, jobs: int) -> None:
        self.jobs = self.free = jobs
        self.changed = threading.Condition()

    def take(self, wanted: int) -> int:
        wanted = min(wanted, self.jobs)
        with self.changed:
            self.changed.wait_for(lambda: self.free >= wanted)
            self.free -= wanted
        return wanted

    def give(self, taken: int) -> None:
        with self.changed:
            self.free += taken
            self.changed.notify_all()


def ended(command: list[str], how: dict) -> tuple[int, str]:
    """Status and output. What a test leaves running cannot hold up the others: its output is a file, not a pipe."""
    environment = os.environ | dict(entry.split("=", 1) for entry in how.get("ENVIRONMENT", []))
    seconds = float(how.get("TIMEOUT", SECONDS))
    with tempfile.TemporaryFile() as output:
        process = subprocess.Popen(
            command, cwd=how.get("WORKING_DIRECTORY"), env=environment, stdin=subprocess.DEVNULL,
            stdout=output, stderr=subprocess.STDOUT, start_new_session=True,
        )  # fmt: skip
        RUNNING.add(process.pid)
        late = ""
        try:
            status = process.wait(seconds)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            status, late = -1, f"\ntook more than {seconds:.0f} s\n"
        RUNNING.discard(process.pid)
        output.seek(0)
        return status, output.read().decode(errors="replace") + late


def end_all(*_: object) -> None:
    """Each test has a session of its own, which Ctrl-C at the terminal does not reach."""
    for session in list(RUNNING):
        with contextlib.suppress(ProcessLookupError):
            os.killpg(session, signal.SIGKILL)
    os._exit(130)


def run(group: list[dict], slots: Slots) -> tuple[list[tuple[str, str, float]], str]:
    """Name, result and seconds of each test, and what the process said."""
    how = properties(group[0])
    names = [filter_of(test) for test in group]
    command = group[0]["command"] if names[0] is None else [group[0]["command"][0], "--gtest_filter=" + ":".join(map(str, names))]
    taken = slots.take(int(how.get("PROCESSORS", 1)))
    began = time.monotonic()
    try:
        status, said = ended(command, how)
    finally:
        slots.give(taken)
    if names[0] is None:
        result = "Passed" if status == 0 else "***Skipped" if status == how.get("SKIP_RETURN_CODE") else "***Failed"
        return [(group[0]["name"], result, time.monotonic() - began)], said
    reported = {name: (result, int(ms) / 1000) for result, name, ms in REPORTED.findall(said)}
    results = []
    for test, name in zip(group, names, strict=True):
        result, seconds = reported.get(str(name), ("not reported", 0.0))
        results.append((test["name"], {"OK": "Passed", "SKIPPED": "***Skipped"}.get(result, "***Failed"), seconds))
    if status != 0 and all(result != "***Failed" for _, result, _ in results):
        # A leak is told when all tests have passed: the last one stands for the process.
        results[-1] = (results[-1][0], "***Failed", results[-1][2])
    return results, said


class Report:
    def __init__(self, tests: int) -> None:
        self.tests, self.done, self.failed = tests, 0, 0

    def show(self, results: list[tuple[str, str, float]], said: str) -> None:
        bad = sum(result == "***Failed" for _, result, _ in results)
        for name, result, seconds in results:
            self.done += 1
            print(f"{self.done:4}/{self.tests} Test #{self.done:4}: {name} ...   {result} {seconds:7.2f} sec", flush=True)
        if bad:
            self.failed += bad
            print(said, flush=True)


def main() -> int:
    jobs, folder, slow, *selection = sys.argv[1:]
    signal.signal(signal.SIGTERM, end_all)
    signal.signal(signal.SIGINT, end_all)
    tests = listed(folder, selection)
    if not tests:
        print("No tests were found!!!")
        return 1
    active = [test for test in tests if not properties(test).get("DISABLED")]
    # What others need (FIXTURES_SETUP) comes before everything.
    first = [test for test in active if properties(test).get("FIXTURES_SETUP")]
    report, slots = Report(len(active)), Slots(int(jobs))
    for test in first:
        report.show(*run([test], slots))
    groups = groups_of([test for test in active if test not in first], slow)
    with ThreadPoolExecutor(int(jobs)) as pool:
        for future in as_completed([pool.submit(run, group, slots) for group in groups]):
            report.show(*future.result())
    print(f"{100 * (report.done - report.failed) // max(1, report.done)}% tests passed, {report.failed} tests failed out of {report.done}")
    return 8 if report.failed else 0


sys.exit(main())
