#!/bin/sh
# Every check that docs/requirements.md names must exist: in the columns "judged by" and "check" each name in code style is a test, a
# file, an experiment, a check of a run, a verb or a stage, and each id a row. A row without any of them says "not judged" and why.
# usage: check_requirements.sh ROOT
set -eu
cd "${1:?usage: check_requirements.sh ROOT}"
page=docs/requirements.md
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# What there is, one "kind name" a line. test: Suite.Name of every gtest, and Prefix/Suite.
{
  find tests -name '*.cc' -exec cat {} + | tr '\n' ' ' |
    grep -oE '(TEST|TEST_F|TEST_P|TYPED_TEST|INSTANTIATE_TEST_SUITE_P)\( *[A-Za-z0-9_]+, *[A-Za-z0-9_]+' |
    sed -E 's/^INSTANTIATE_TEST_SUITE_P\( *([^,]+), */test \1\//; s/^[A-Z_]+\( *([^,]+), */test \1./'
  find tests -name '*_test.cc' | sed -E 's/.*\/(.*)\.cc/name \1/'
  # Checks and metrics of a run and keys of fixtures are quoted in the sources.
  grep -rhoE '"[a-z][a-z0-9_{}]+"' --include='*.cc' --include='*.h' bbmc emulator harness protocol study |
    sed -E 's/"(.*)"/name \1/'
  grep -rhoE '(NAME|add_executable\() *[A-Za-z_.]+' --include=CMakeLists.txt --include='*.cmake' tests study |
    sed -E 's/.*[ (]/name /'
  sed -n 's/^stage_\([a-z_]*\)().*/name \1/p' tools/launcher/stages_*.sh
  find fixtures -name '*.toml' | sed -E 's/.*\/(.*)\.toml/toml \1/'
  find docs study -name '*.md' -o -name '*.cc' | sed 's/^/file /'
  sed -n 's/^## /verb /p' docs/reference/verbs.md
} | sort -u >"$scratch/there"

awk -v page="$page" '
  function trim(text) { gsub(/^ +| +$/, "", text); return text }
  function complain(text) { print page ": " text > "/dev/stderr"; bad = 1 }
  # * is anything, but no digit behind a digit: Defect1* is not Defect10.
  function matching(pattern, list,   each, ending) {
    gsub(/[.]/, "[.]", pattern)
    ending = ""
    if (sub(/\/[*]$/, "", pattern)) ending = "[./].*"
    else if (pattern ~ /[0-9][*]$/) { sub(/[*]$/, "", pattern); ending = "([^0-9].*)?" }
    gsub(/[*]/, ".*", pattern)
    for (each in list) if (each ~ ("^(.*[.])?" pattern ending "$")) return 1
    return 0
  }
  function exists(name,   word, count) {
    sub(/^[.]\//, "", name)
    count = split(name, word, " ")
    if (word[1] == "towbench") return word[2] in verbs
    if (count > 1) return word[1] in names # a program with its arguments
    if (name == "fault_N_fired") name = "fault_{}_fired"
    if (name ~ /[.]toml$/) { sub(/[.]toml$/, "", name); return matching(name, tomls) }
    return name in files || name in tomls || name in names || (name ~ /[*]/ && matching(name, names)) || matching(name, tests)
  }
  FNR == NR { if ($1 == "test") tests[$2]; else if ($1 == "name") names[$2]; else if ($1 == "toml") tomls[$2]
              else if ($1 == "file") files[$2]; else verbs[$2]
              next }
  !/^\|/ { head = 0; next }
  !head { head = 1; split("", judging); columns = split($0, title, "|")
          for (i = 2; i < columns; ++i) if (trim(title[i]) ~ /^(judged by|check)$/) judging[i]
          next }
  /^\| *---/ { next }
  { split($0, cell, "|"); id = trim(cell[2]); text = ""; any = 0
    if (id in row) complain(id " has two rows")
    row[id] = ++rows; order[rows] = id
    for (i in judging) { text = text " " cell[i]; any = 1 }
    judged[rows] = any; cells[rows] = text }
  END {
    if (!rows) complain("no requirement at all")
    for (r = 1; r <= rows; ++r) {
      if (!judged[r]) continue # the section says who judges
      id = order[r]; text = cells[r]; named = 0
      while (match(text, /`[^`]+`/)) {
        name = substr(text, RSTART + 1, RLENGTH - 2)
        text = substr(text, 1, RSTART - 1) substr(text, RSTART + RLENGTH)
        ++named
        if (!exists(name)) complain(id " names " name ", which is no test, file, experiment, check, verb or stage")
      }
      while (match(text, /[A-Z]+(-[A-Z]+)?-[0-9]+[a-g]?/)) {
        other = substr(text, RSTART, RLENGTH)
        text = substr(text, RSTART + RLENGTH)
        ++named
        if (!(other in row)) complain(id " cites " other ", which has no row")
      }
      if (!named && text !~ /not judged: ./) complain(id " names no check and does not say \"not judged\" with a reason")
    }
    print "requirements: " rows
    exit bad
  }' "$scratch/there" "$page"
