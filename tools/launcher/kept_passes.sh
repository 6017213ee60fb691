# shellcheck shell=bash disable=SC2154
# A stage that passed in this build folder with the same inputs is not run again. Sourced by test.sh.
#
# Inputs: every file of the clone that is not ignored, measured data beside it, this host's packages, kernel and
# processors, and the variables of the compiler and of TOWBENCH_*. A stage that draws new inputs at each run is never
# kept; nor is one that is asked for by name, by --all or by --again. docs/decisions/0022-stages-are-kept.md

never_kept=(lint fuzz fresh_start)

# A digest. No stage leaves out a folder: tests of the controller read pages, and such a list would be wrong one day.
inputs() {
  (
    cd "$root" || exit
    git ls-files -s
    git diff --binary --no-ext-diff
    git ls-files -oz --exclude-standard | sort -z | xargs -0r sha256sum --
    dpkg-query -W
    uname -rm
    nproc
    find ../shared/data -type f -printf '%P %s %T@\n' 2>/dev/null | sort || true
    env | grep -E '^(TOWBENCH_|(CC|CXX|CFLAGS|CXXFLAGS|LDFLAGS)=)' | sort || true
  ) | sha256sum | cut -d' ' -f1
}

may_be_kept() {
  [[ $everything == false && $again == false && " ${never_kept[*]} " != *" $1 "* ]] && git -C "$root" rev-parse -q --verify HEAD >/dev/null
}

# has_passed STAGE INPUTS: when, and what its note was.
has_passed() { [[ $(sed -n 1p "$build/passed/$1" 2>/dev/null) == "$2" ]] && sed -n 2p "$build/passed/$1"; }

# keep_pass STAGE INPUTS NOTE: unless a file has changed while it ran.
keep_pass() {
  [[ $(inputs) == "$2" ]] || return 0
  mkdir -p "$build/passed"
  printf '%s\npassed %s with the same inputs%s\n' "$2" "$(date -u '+%Y-%m-%d %H:%M UTC')" "$3" >"$build/passed/$1.new"
  mv "$build/passed/$1.new" "$build/passed/$1"
}
