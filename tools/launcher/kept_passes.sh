# shellcheck shell=bash disable=SC2154
# A stage that passed in this build folder with the same inputs is not run again. Sourced by test.sh.
#
# Inputs: every file of the clone that is not ignored, measured data beside it, this host's packages, kernel and
# processors, and the variables of the compiler and of TOWBENCH_*. A stage that draws new inputs at each run is never kept; nor is one that is asked for by name, by --all
# or by --again. docs/decisions/0022-stages-are-kept.md

never_kept=(lint fuzz fresh_start)

# What a stage does not look at. The others look at everything.
unseen_by() {
  case $1 in
    board | carriers | sanitize_thread) printf '%s\n' ':!docs' ':!study' ':!tests/study' ':!tests/browser' ':!*.md' ;;
  esac
}

# inputs_of STAGE: a digest.
inputs_of() {
  local unseen
  mapfile -t unseen < <(unseen_by "$1")
  (
    cd "$root" || exit
    git ls-files -s -- . "${unseen[@]}"
    git diff --binary --no-ext-diff -- . "${unseen[@]}"
    git ls-files -oz --exclude-standard -- . "${unseen[@]}" | sort -z | xargs -0r sha256sum --
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
  [[ $(inputs_of "$1") == "$2" ]] || return 0
  mkdir -p "$build/passed"
  printf '%s\npassed %s with the same inputs%s\n' "$2" "$(date -u '+%Y-%m-%d %H:%M UTC')" "$3" >"$build/passed/$1.new"
  mv "$build/passed/$1.new" "$build/passed/$1"
}
