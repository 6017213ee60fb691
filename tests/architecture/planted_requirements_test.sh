#!/bin/sh
# A requirement whose check does not exist, that cites a row that is not there, or that nothing judges without a reason must be found.
# shellcheck disable=SC2016  # the backticks are Markdown
set -u
root=${1:?usage: planted_requirements_test.sh ROOT}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0
fail() {
  echo "$1"
  failures=$((failures + 1))
}

cd "$scratch" || exit 1
mkdir -p tools/launcher fixtures/experiments docs/reference bbmc emulator harness protocol study tests
printf 'TEST(Suite,\n     Defect10Name) {\nTYPED_TEST(Typed, Name) {\n' >tests/some_test.cc
printf 'check("obeys_kill");\n' >harness/rules.cc
printf 'add_test(NAME whole.rings_are_found\n' >tests/CMakeLists.txt
printf 'stage_carriers() {\n' >tools/launcher/stages_guard.sh
printf '## tow\n' >docs/reference/verbs.md
: >fixtures/experiments/circle-best.toml

judge() { # judge CELL ...: requirements A-1, A-2, ... judged by them
  printf '| id | text | judged by |\n| --- | --- | --- |\n' >docs/requirements.md
  rows=0
  for cell in "$@"; do
    rows=$((rows + 1))
    printf '| A-%d | `free` text | %s |\n' "$rows" "$cell" >>docs/requirements.md
  done
  sh "$root/tools/check_requirements.sh" . >said 2>&1
}

judge '`Suite.Defect10Name`' '`Suite.Def*`' '`Defect10*`' '`Typed/*`' '`obeys_kill`' '`some_test`' '`circle-best`' '`circle-*.toml`' \
  'stage `carriers`' '`./towbench tow --only load`' '`whole.rings_are_found`' 'A-1' 'not judged: no model' ||
  fail "checks that are there: $(cat said)"

judge '`Suite.Gone`' '`Defect1*`' '`Suite.Defect1`' '`Other.*`' '`obeys`' '`gone_test`' '`circle`' '`gone-*.toml`' 'stage `gone`' \
  '`towbench gone --only load`' '`obeys_kill`, `gone`' 'B-2' 'not judged' 'the panel' '' && fail "nothing of what is planted was found"
for row in $(seq "$rows"); do
  grep -q ": A-$row " said || fail "not found: $(grep "A-$row " docs/requirements.md)"
done

judge && fail "a page without a requirement passes"
printf '| id | judged by |\n| --- | --- |\n| A-1 | `obeys_kill` |\n| A-1 | `obeys_kill` |\n' >docs/requirements.md
sh "$root/tools/check_requirements.sh" . >said 2>&1 && fail "two rows of one id pass"

[ "$failures" -eq 0 ] && echo "every planted mistake was found"
exit "$failures"
