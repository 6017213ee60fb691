#!/usr/bin/env python3
"""falsify.py against programs that answer as they are told: what counts as found, and after how many runs.

usage: falsify_test.py ROOT
"""
import pathlib
import subprocess
import sys
import tempfile

# A bench whose search finds, one after the other, the words of its file `finds`: "own" is a case that the
# unchanged controller keeps, "known" one that it breaks too, "crash" ends the process, "nothing" is none.
BENCH = '''#!/usr/bin/env python3
import json, os, pathlib, signal, sys
words = sys.argv[1:]
after = lambda name: pathlib.Path(words[words.index(name) + 1])
if words[0] == "run":
    sys.exit(1 if pathlib.Path(words[1]).read_text() == "known" else 0)
finds = (pathlib.Path(__file__).with_suffix(".finds")).read_text().split()
trials = after("--out") / "trials.jsonl"
lines = trials.read_text().splitlines() if trials.exists() else []
if any(json.loads(line)["margin"] is not None for line in lines):
    sys.exit(3)  # a known case still counts as broken
found = finds[min(len(lines), len(finds) - 1)]
if found == "nothing":
    sys.exit(0)
if found == "refused":
    sys.exit(2)
lines.append(json.dumps({"broken": True, "margin": -1, "rules": {"SAF-1": -1}}))
trials.write_text("\\n".join(lines) + "\\n")
if found == "crash":
    os.kill(os.getpid(), signal.SIGSEGV)
after("--keep").write_text(found)
sys.exit(1)
'''


def table_of(root, mutants):
    """Rows by mutant, the exit code, and what was printed."""
    with tempfile.TemporaryDirectory() as folder:
        build = pathlib.Path(folder)
        programs = {"bin/towbench-bench": "nothing"}
        programs |= {f"tests/mutants/mutant_{name}": finds for name, finds in mutants.items()}
        for name, finds in programs.items():
            program = build / name
            program.parent.mkdir(parents=True, exist_ok=True)
            program.write_text(BENCH)
            program.chmod(0o755)
            program.with_suffix(".finds").write_text(finds)
        script = root / "tests/mutants/falsify.py"
        words = [sys.executable, script, build, *mutants, "--seeds", "3", "--runs", "50"]
        done = subprocess.run(words, cwd=root, capture_output=True, text=True, check=False, timeout=120)
        page = build / "falsified.md"
        lines = page.read_text().splitlines()[2:] if page.exists() else []
        cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
        return {row[0].strip("`"): row[1:] for row in cells}, done.returncode, done.stdout + done.stderr


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    found = {"first": "own", "third": "known known own", "ends": "known crash"}
    rows, code, said = table_of(root, found)
    assert code == 0, said
    assert rows["first"] == ["3 of 3", "1", "3 of 3", "1"], rows
    assert rows["third"] == ["3 of 3", "3", "3 of 3", "3"], f"known cases are runs: {rows}"
    assert rows["ends"] == ["3 of 3", "2", "3 of 3", "2"], f"a crash is found: {rows}"
    # Not found is longer than all runs, and an exit code.
    rows, code, said = table_of(root, {"never": "nothing", "first": "own"})
    assert code == 1, said
    assert rows["never"] == ["0 of 3", "> 50", "0 of 3", "> 50"], rows
    rows, code, said = table_of(root, {"bad": "refused"})
    assert "exit code 2" in said, f"a refused command was taken for a result: {said}"
    assert code != 0 and not rows, rows
    print("what is found, and after how many runs")


main()
