#!/bin/sh
# Fails, naming one include a step, when folders of the product include each other in a ring.
# usage: check_folder_cycles.sh ROOT
# From the includes themselves, folder by folder; tools/include_rules.txt is not asked.
set -eu
root=${1:?usage: check_folder_cycles.sh ROOT}
cd "$root"

# shellcheck disable=SC2016  # the awk program is not for the shell
find core protocol emulator board bbmc harness study \
  \( -name '*.h' -o -name '*.cc' \) -type f 2>/dev/null | sort | xargs awk '
  function folder_of(path) { sub(/\/[^\/]*$/, "", path); return path }
  /^[ \t]*#[ \t]*include[ \t]*"[^"]*\// {
    split($0, quoted, "\"")
    from = folder_of(FILENAME); to = folder_of(quoted[2])
    known[from]; known[to]
    if (from != to && !((from, to) in witness)) {
      witness[from, to] = FILENAME ":" FNR ": includes \"" quoted[2] "\""
    }
  }
  END {
    # What includes nothing that is left is in no ring.
    do {
      removed = 0
      for (one in known) {
        stuck = 0
        for (other in known) if ((one, other) in witness) stuck = 1
        if (!stuck) { delete known[one]; removed = 1 }
      }
    } while (removed)
    start = ""
    for (one in known) if (start == "" || one < start) start = one
    if (start == "") exit 0
    # Everything left leads on to something left: sooner or later a folder comes again.
    for (at = start; !(at in step); at = next_folder) {
      step[at] = ++steps; path[steps] = at
      next_folder = ""
      for (other in known) if ((at, other) in witness && (next_folder == "" || other < next_folder)) next_folder = other
    }
    printf "folders include each other in a ring:\n"
    path[steps + 1] = at
    for (i = step[at]; i <= steps; i++) printf "%s\n", witness[path[i], path[i + 1]]
    exit 1
  }
'
