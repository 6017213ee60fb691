#!/usr/bin/env bash
# What has passed is kept while its inputs are the same, and run again when any of them differs.
# usage: kept_passes_test.sh ROOT
set -euo pipefail
source_root=${1:?usage: kept_passes_test.sh ROOT}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
root=$scratch/clone build=$scratch/build everything=false again=false
mkdir -p "$root/docs" "$root/core"
cd "$root"
git init -q . && git config user.email a@b && git config user.name a
echo one >core/a.cc && echo page >docs/a.md && echo '*.log' >.gitignore && git add . && git commit -qm one
root=$source_root
# shellcheck source=tools/launcher/test.sh
source "$source_root/tools/launcher/test.sh"
root=$scratch/clone

wrong() { echo "kept_passes: $1"; exit 1; }
kept() { may_be_kept "$1" && has_passed "$1" "$(inputs)" >/dev/null; }
pass() { keep_pass "$1" "$(inputs)" ''; }

! kept tests || wrong 'kept without a pass'
pass tests && pass board
kept tests || wrong 'not kept though nothing changed'
kept board || wrong 'another stage was not kept'
! kept sanitize_thread || wrong 'the pass of another stage was taken'
git commit -q --allow-empty -m two
kept tests || wrong 'a commit without a change was taken for one'
touch core/a.cc && echo x >x.log
kept tests || wrong 'a time or an ignored file was taken for a change'

echo two >core/a.cc
! kept tests || wrong 'a changed file was not seen'
git add core/a.cc
! kept board || wrong 'a staged file was not seen'
echo one >core/a.cc && git add core/a.cc
kept tests || wrong 'the same content is not the same input'
echo new >core/b.cc
! kept board || wrong 'a new file was not seen'
rm core/b.cc && rm core/a.cc
! kept tests || wrong 'a removed file was not seen'
git checkout -q core/a.cc && chmod +x core/a.cc
! kept tests || wrong 'a changed mode was not seen'
chmod -x core/a.cc && echo other >docs/a.md
! kept board || wrong 'a changed page was not seen'
git checkout -q docs/a.md
! TOWBENCH_FUZZ_SECONDS=3 kept tests || wrong 'a variable was not seen'

before=$(inputs)
echo three >core/a.cc
keep_pass sanitize_address "$before" ''
git checkout -q core/a.cc
! kept sanitize_address || wrong 'a pass was kept though a file changed while it ran'
pass fuzz
! kept fuzz || wrong 'what draws new inputs was kept'
again=true
! kept tests || wrong '--again was not heard'
again=false everything=true
! kept tests || wrong '--all was not heard'

# The runner of stages.
everything=false
rm -r "$build/passed"
stage_tests() { passed=$((passed + 1)); }
stage_board() { failed=$((failed + 1)); }
ran() { (run_stages "$@") 2>&1 || echo "exit code $?"; }
ran tests board | grep -q 'exit code 1' || wrong 'a failed stage did not fail the run'
second=$(ran tests board)
grep -q '^tests .*kept: passed' <<<"$second" || wrong 'the runner did not keep a pass'
grep -q '^board .*FAILED' <<<"$second" || wrong 'the runner kept a failure'
! ran tests | grep -q 'exit code' || wrong 'a run of kept stages alone did not pass'
echo 'kept while the inputs are the same, and run again when one differs'
