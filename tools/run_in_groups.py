#!/usr/bin/env python3
"""Runs the tests that ctest lists, many tests of one GoogleTest program in one process.

usage: run_in_groups.py JOBS FOLDER [ctest arguments that select...]

Under a sanitizer a program takes longer to start than most of its tests to run. Prints what ctest prints of each
test. A test that its process does not report as passed or skipped has failed: a crash fails what comes behind it.
Exit: 0 all passed, 8 some failed, 1 no tests.
"""

import json
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor, as_completed

IN_A_GROUP = 24
SECONDS = 900
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


def groups_of(tests: list[dict]) -> list[list[dict]]:
    by_program: dict[str, list[dict]] = {}
    groups = []
    for test in tests:
        if filter_of(test) is None:
            groups.append([test])
        else:
            by_program.setdefault(test["command"][0], []).append(test)
    for of_program in by_program.values():
        groups += [of_program[i : i + IN_A_GROUP] for i in range(0, len(of_program), IN_A_GROUP)]
    return groups


def run(group: list[dict]) -> tuple[list[tuple[str, str, float]], str]:
    """Name, result and seconds of each test, and what the process said."""
    how = properties(group[0])
    names = [filter_of(test) for test in group]
    command = group[0]["command"] if names[0] is None else [group[0]["command"][0], "--gtest_filter=" + ":".join(map(str, names))]
    environment = os.environ | dict(entry.split("=", 1) for entry in how.get("ENVIRONMENT", []))
    try:
        ended = subprocess.run(
            command, cwd=how.get("WORKING_DIRECTORY"), env=environment, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=float(how.get("TIMEOUT", SECONDS)),
        )  # fmt: skip
        status, said = ended.returncode, ended.stdout.decode(errors="replace")
    except subprocess.TimeoutExpired as late:
        status, said = -1, (late.stdout or b"").decode(errors="replace") + f"\ntook more than {late.timeout} s\n"
    if names[0] is None:
        result = "Passed" if status == 0 else "***Skipped" if status == how.get("SKIP_RETURN_CODE") else "***Failed"
        return [(group[0]["name"], result, 0.0)], said
    reported = {name: (result, int(ms) / 1000) for result, name, ms in REPORTED.findall(said)}
    results = []
    for test, name in zip(group, names, strict=True):
        result, seconds = reported.get(str(name), ("not reported", 0.0))
        results.append((test["name"], {"OK": "Passed", "SKIPPED": "***Skipped"}.get(result, "***Failed"), seconds))
    if status != 0 and all(result != "***Failed" for _, result, _ in results):
        # A leak is told when all tests have passed: the last one stands for the process.
        results[-1] = (results[-1][0], "***Failed", results[-1][2])
    return results, said


def main() -> int:
    jobs, folder, *selection = sys.argv[1:]
    tests = listed(folder, selection)
    if not tests:
        print("No tests were found!!!")
        return 1
    active = [test for test in tests if not properties(test).get("DISABLED")]
    done = failed = 0
    with ThreadPoolExecutor(int(jobs)) as pool:
        for future in as_completed([pool.submit(run, group) for group in groups_of(active)]):
            results, said = future.result()
            bad = [result for result in results if result[1] == "***Failed"]
            for name, result, seconds in results:
                done += 1
                print(f"{done:4}/{len(active)} Test #{done:4}: {name} ...   {result} {seconds:7.2f} sec", flush=True)
            if bad:
                failed += len(bad)
                print(said, flush=True)
    print(f"{100 * (done - failed) // max(1, done)}% tests passed, {failed} tests failed out of {done}")
    return 8 if failed else 0


sys.exit(main())
