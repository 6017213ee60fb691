#!/usr/bin/env python3
"""Every mutant of the controller is searched for a broken rule by one command, which is not told which
mutant it has; beside it the same with uniform samples alone.

usage: falsify.py BUILD_DIR [--seeds 20] [--runs 1000] [--jobs N] [MUTANT ...]     from the root of the repository

Writes BUILD_DIR/falsified.md: the table of docs/measurements/falsify.md. Exit code 1 when no seed of the
search found one of them.
"""
import argparse
import concurrent.futures
import glob
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

UNCHANGED = "unchanged"
# With it the unchanged controller trips as well (docs/theory/safety.md).
KNOWN = "drive.x dropped_load"
# A motion of 132 s comes last, with few runs.
LONG = ["fixtures/motions/long-y.toml"]
LONG_RUNS = 5
NOTHING_TRIED = 4  # exit code: no fault took effect, as may be with few runs
SHORT = sorted(set(glob.glob("fixtures/motions/*.toml")) - set(LONG))
OPTIMISER = "sbplx"


def program_of(build, name):
    return build / ("bin/towbench-bench" if name == UNCHANGED else f"tests/mutants/mutant_{name}")


def search_in(build, name, motions, optimiser, seed, runs):
    """Runs until a rule was broken that the unchanged controller keeps in the same case; None when none was. A
    case that the unchanged controller breaks too is entered among the trials as one that says nothing, and the
    search goes on. A controller that ends its process is found as well."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder)
        kept = out / "worst.toml"
        trials = out / "trials.jsonl"
        words = [program_of(build, name), "falsify", *motions, "--except", KNOWN, "--requirement", "rules"]
        words += ["--until-broken", "--quiet", "--budget", f"{runs} runs", "--optimiser", optimiser]
        words += ["--seed", str(seed), "--out", str(out), "--keep", str(kept)]
        while True:
            code, said = run(words)
            if code not in (0, 1, NOTHING_TRIED) and code >= 0:
                sys.exit(f"{name}, {optimiser}, seed {seed}: exit code {code}\n{said}")
            if code in (0, NOTHING_TRIED):
                return None
            lines = trials.read_text().splitlines() if trials.exists() else []
            unchanged = [program_of(build, UNCHANGED), "run", kept, "--quiet", "--no-report", "--out", out / "beside"]
            if code < 0 or run(unchanged)[0] == 0:
                return len(lines)
            known = json.loads(lines[-1])
            known.update(broken=False, margin=None, rules={}, reason="the unchanged controller breaks it too")
            trials.write_text("\n".join([*lines[:-1], json.dumps(known)]) + "\n")


def run(words):
    done = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def search(build, name, optimiser, seed, runs):
    found = search_in(build, name, SHORT, optimiser, seed, runs)
    if found is None:
        found = search_in(build, name, LONG, optimiser, seed, LONG_RUNS)
        found = None if found is None else runs + found
    return found


def search_both(build, name, seed, runs):
    """By the search and by uniform samples."""
    return tuple(search(build, name, optimiser, seed, runs) for optimiser in (OPTIMISER, "uniform"))


def cells(found, runs):
    """How many seeds found it, and the median of their runs; one that found nothing counts as longest."""
    count = sum(one is not None for one in found)
    median = statistics.median(runs + 1 if one is None else one for one in found)
    return f"{count} of {len(found)} | {f'> {runs}' if median > runs else f'{median:g}'}"


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("build", type=pathlib.Path)
    options.add_argument("mutants", nargs="*")
    options.add_argument("--seeds", type=int, default=20)
    options.add_argument("--runs", type=int, default=1000)
    options.add_argument("--jobs", type=int, default=os.cpu_count())
    given = options.parse_intermixed_args()
    build = given.build.resolve()
    built = (build / "tests/mutants").glob("mutant_*")
    names = given.mutants or sorted(one.name[7:] for one in built if one.is_file())
    seeds = range(1, given.seeds + 1)
    page = "| controller | search: found | runs, median | uniform: found | runs, median |\n"
    page += "| --- | ---: | ---: | ---: | ---: |\n"
    every = True
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        for name in names:
            found = list(zip(*pool.map(lambda seed, of=name: search_both(build, of, seed, given.runs), seeds)))
            row = f"| `{name}` | {cells(found[0], given.runs)} | {cells(found[1], given.runs)} |"
            print(row, flush=True)
            page += row + "\n"
            (build / "falsified.md").write_text(page)
            every = every and any(one is not None for one in found[0])
    return 0 if every else 1


if __name__ == "__main__":
    sys.exit(main())
