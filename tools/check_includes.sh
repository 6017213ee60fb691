#!/bin/sh
# Fails, naming file and line, when an include breaks tools/include_rules.txt.
# usage: check_includes.sh ROOT
# awk and find only: the check runs in every build, also on a machine with nothing but a compiler.
set -eu
root=${1:?usage: check_includes.sh ROOT}
cd "$root"

# "bare" folders compile for a microcontroller; these headers drag in threads, files, locales or heap.
bare_forbidden='iostream fstream sstream ostream istream iomanip locale regex filesystem thread mutex
  condition_variable future semaphore string vector map unordered_map set list deque functional
  memory_resource iosfwd format random chrono'

# shellcheck disable=SC2016  # the awk program is not for the shell
find core protocol emulator board bbmc harness study tests benchmarks \
  \( -name '*.h' -o -name '*.cc' \) -type f 2>/dev/null | sort | xargs awk -v forbidden="$bare_forbidden" '
  BEGIN {
    rules = "tools/include_rules.txt"
    while ((getline line < rules) > 0) {
      if (line ~ /^ *#/ || line !~ /:/) continue
      split(line, halves, "|")
      folder = halves[1]; sub(/ *:.*/, "", folder)
      allowed = halves[1]; sub(/^[^:]*:/, "", allowed)
      may[folder] = " " folder " " allowed " "
      bare[folder] = (halves[2] ~ /bare/)
      known++
    }
    if (!known) { print rules ": no rules found"; exit 1 }
    count = split(forbidden, words, /[ \n]+/)
    for (i = 1; i <= count; i++) heavy[words[i]] = 1
  }
  function place(path,   folder) {
    folder = path
    while (sub(/\/[^\/]*$/, "", folder)) if (folder in may) return folder
    return ""
  }
  function allowed_in(from, to,   upper) {
    if (index(may[from], " " to " ")) return 1
    upper = to
    do if (index(may[from], " " upper "/* ")) return 1; while (sub(/\/[^\/]*$/, "", upper))
    return 0
  }
  /^[ \t]*#[ \t]*include[ \t]*"/ {
    split($0, quoted, "\""); target = quoted[2]
    from = place(FILENAME); to = place(target)
    if (to == "" || from == "" || !allowed_in(from, to)) {
      printf "%s:%d: %s may not include \"%s\" (allowed:%s)\n", FILENAME, FNR, (from == "" ? "an unknown folder" : from), target, may[from]
      bad = 1
    }
  }
  /^[ \t]*#[ \t]*include[ \t]*</ {
    from = place(FILENAME)
    header = $0; sub(/^[^<]*</, "", header); sub(/>.*/, "", header)
    if (bare[from] && (header in heavy || header ~ /^(boost|fmt|nlohmann|toml\+\+|CLI|sys|linux)\//)) {
      printf "%s:%d: %s compiles for bare metal and may not include <%s>\n", FILENAME, FNR, from, header
      bad = 1
    }
  }
  END { exit bad }
'
